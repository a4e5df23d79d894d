#include "spatial/moving/solid_frames.h"

#include "spatial/convolution/facet_rule.h"
#include "spatial/frames/pose_angles.h"

namespace dymsum::spatial {

namespace {

/// A window reaches as far as points may move within this share of a box: further, and few boxes stay inside.
constexpr double kSweptShare = 0.5;
/// Frames that a window has to serve.
constexpr double kFewestFrames = 2;

}  // namespace

SolidFrames::SolidFrames(const SolidPair& pair, const SpatialOptions& options)
    : pair_(pair),
      options_(options),
      radius_{radius_about_middle(pair.p.vertices), radius_about_middle(pair.q.vertices)},
      convolution_(pair) {}

bool SolidFrames::is_long(const PosePair& from, const PosePair& to) const {
  return convolution_.motion(from, to) > convolution_.longest_step();
}

SpatialSum SolidFrames::frame(const PosePair& poses, const PosePair& before, SolidFrameWork& work) {
  SpaceOnDemand exact(pair_, poses);
  exact();  // throws before anything has moved
  const ConvolutionWork& moved = convolution_.set(poses, exact);
  work.normals_checked = moved.normals_checked, work.pairs_checked = moved.pairs_checked;
  work.facets = convolution_.size(), work.facets_added = moved.added, work.facets_removed = moved.removed;
  inner_.resize(convolution_.slots(), Inner::unknown);
  for (const std::uint32_t slot : convolution_.added()) inner_[slot] = Inner::unknown;
  keep_window(poses, before, work);
  ReducedConvolution outer = outer_facets(work);
  SpatialSum sum = sum_of_facets(pair_, exact.take(), std::move(outer), {window_.has_value()}, options_);
  work.contacts = sum.stats.contacts, work.exact_signs = sum.stats.exact_signs + moved.exact_checks;
  return sum;
}

/// Makes a window where the one at hand has ended. Where few moves lead out of a window none is made: then the boxes of
/// each frame, with nothing taken off them, serve better.
void SolidFrames::keep_window(const PosePair& poses, const PosePair& before, SolidFrameWork& work) {
  if (window_ && window_->moved_to(poses) <= window_->sweep()) return;
  window_.reset();
  const int across = inner_boxes_across(convolution_.size());
  if (across == 0) return;
  InnerWindow window(pair_, poses, across, kSweptShare);
  if (kFewestFrames * window.moved_to(before) > window.sweep()) return;
  SpatialStats stats;
  StageWatch watch(options_, stats);
  watch.begin("window");
  window.fill(pair_, watch);
  window_.emplace(std::move(window));
  std::fill(inner_.begin(), inner_.end(), Inner::unknown);
  work.new_window = true;
}

/// The facets that are not known to lie deep inside, in the order of a fresh convolution.
ReducedConvolution SolidFrames::outer_facets(SolidFrameWork& work) {
  ReducedConvolution outer;
  outer.facets.reserve(convolution_.size()), outer.planes.reserve(convolution_.size());
  for (const std::uint32_t slot : convolution_.in_order()) {
    const SumFacet& facet = convolution_.facet(slot);
    ++(facet.kind == SumFacet::Kind::edge_edge ? outer.counts.edge_edge : outer.counts.face_vertex);
    if (window_) {
      Inner& inner = inner_[slot];
      work.inner_kept += inner == Inner::yes;
      if (inner == Inner::unknown) {
        ++work.inner_tested;
        inner = window_->hold(facet) ? Inner::yes : Inner::no;
      }
      if (inner == Inner::yes) continue;
    }
    outer.facets.push_back(facet);
    outer.planes.push_back(plane_of(facet));
  }
  return outer;
}

}  // namespace dymsum::spatial
