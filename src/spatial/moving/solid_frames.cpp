#include "spatial/moving/solid_frames.h"

#include "spatial/convolution/facet_rule.h"

namespace dymsum::spatial {

namespace {

/// Exact signs are some twenty times as expensive as what else makes a facet of a fresh convolution. Where an update
/// takes more of them than there are facets, it is given up for this many frames.
constexpr std::uint32_t kFramesFromScratch = 50;
/// The boxes of a fresh sum take about a quarter of it. Where they drop fewer than one in so many of the facets that
/// balls left, they are left out of this many frames.
constexpr std::uint64_t kOneIn = 12;
constexpr std::uint32_t kFramesWithoutBoxes = 8;
constexpr std::uint64_t kFewTests = 100;

}  // namespace

bool SolidFrames::had_better_not(const PosePair& from, const PosePair& to) {
  if (convolution_.motion(from, to) > convolution_.longest_step()) return true;
  if (crowded_ == 0) return false;
  --crowded_;
  return true;
}

SpatialSum SolidFrames::frame(const PosePair& poses, SolidFrameWork& work) {
  SpaceOnDemand exact(pair_, poses);
  exact();  // throws before anything has moved
  const ConvolutionWork& moved = convolution_.set(poses, exact);
  work.normals_checked = moved.normals_checked, work.pairs_checked = moved.pairs_checked;
  work.facets = convolution_.slots().facets(), work.facets_added = moved.added, work.facets_removed = moved.removed;
  if (!moved.rebuilt && moved.exact_checks > convolution_.slots().facets()) crowded_ = kFramesFromScratch;
  for (const std::uint32_t slot : convolution_.slots().added()) inner_.forget(slot);
  PosedSpace space = exact.take();
  inner_.move(space, poses);
  ReducedConvolution outer = outer_facets();
  work.inner_kept = inner_.kept(), work.inner_tested = inner_.tested();
  const std::size_t count = outer.facets.size();
  const bool boxes = without_boxes_ == 0;
  SpatialSum sum = sum_of_facets(pair_, std::move(space), std::move(outer), {!boxes}, options_);
  const bool many_tests = sum.stats.tight_tests + sum.stats.collision_tests > kFewTests;
  if (many_tests) without_boxes_ = 0;
  else if (!boxes) --without_boxes_;
  else if (sum.stats.inner_facets * kOneIn < count) without_boxes_ = kFramesWithoutBoxes;
  work.contacts = sum.stats.contacts, work.exact_signs = sum.stats.exact_signs + moved.exact_checks;
  return sum;
}

/// The facets that are not known to lie deep inside, in the order of a fresh convolution.
ReducedConvolution SolidFrames::outer_facets() {
  ReducedConvolution outer;
  outer.facets.reserve(convolution_.slots().facets()), outer.planes.reserve(convolution_.slots().facets());
  for (const std::uint32_t slot : convolution_.in_order()) {
    const SumFacet& facet = convolution_.slots()[slot];
    ++(facet.kind == SumFacet::Kind::edge_edge ? outer.counts.edge_edge : outer.counts.face_vertex);
    if (inner_.hold(slot, facet)) continue;
    outer.facets.push_back(facet);
    outer.planes.push_back(plane_of(facet));
  }
  return outer;
}

}  // namespace dymsum::spatial
