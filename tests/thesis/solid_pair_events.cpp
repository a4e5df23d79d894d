#include "thesis/solid_pair_events.h"

#include <mutex>
#include <string>

#include "spatial/motion/beside_origin.h"
#include "spatial/moving/moving_solid_sum.h"
#include "thesis/pair_intervals.h"

namespace dymsum {

using namespace spatial;

namespace {

bool has_parallel_planes(const PairFacets& all, std::uint32_t f, std::uint32_t g) {
  const PlaneRow &a = all.row(f), &b = all.row(g);
  const Vec3 u{a[0], a[1], a[2]}, v{b[0], b[1], b[2]};
  if (length(cross(u, v)) > 0x1p-40) return false;
  const BigVector &n = all.plane(f).n, &m = all.plane(g).n;
  return n[1] * m[2] == n[2] * m[1] && n[2] * m[0] == n[0] * m[2] && n[0] * m[1] == n[1] * m[0];
}

/// Adds the pairs of facet f with those after it.
void count_pairs(const PairFacets& all, std::uint32_t f, SolidPairEventCount& count) {
  for (std::uint32_t g = f + 1; g < all.facets().size(); ++g) {
    if (share_corner(all.facets()[f], all.facets()[g])) continue;
    std::optional<PairInterval> interval = near_interval(all, f, g);
    if (interval && !interval->meets) continue;
    if (!interval) {
      if (has_parallel_planes(all, f, g)) continue;
      ++count.exact_pairs;
      interval = exact_interval(all, f, g);
    }
    count.pairs_that_meet += interval->meets;
    for (const PairInterval::End end : {interval->low, interval->high}) {
      count.vertex_on_facet += end == PairInterval::End::corner;
      count.edge_on_edge += end == PairInterval::End::facet_edges;
    }
  }
}

}  // namespace

Result<SolidPairEventCount> count_solid_pair_events(const Mesh& p, const Mesh& q, const SolidScaleOptions& options,
                                                    const Progress& progress) {
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  if (p.has_thin_parts() || q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "an operand of a scaling sum of solids has parts without volume", {}};
  return guarded([&]() -> SolidPairEventCount {
    SolidPairEventCount all;
    ScalingPair pair(solid_pair(beside_origin(p).value_or(p), beside_origin(q).value_or(q)),
                     options.moving == MovingOperand::p ? 0 : 1);
    if (pair.pair().p.vertices.empty() || pair.pair().q.vertices.empty()) return all;
    SpatialOptions stages;
    stages.threads = options.threads, stages.progress = progress;
    SpatialStats stats;
    StageWatch watch(stages, stats);
    watch.begin("convolution");
    const PairFacets facets(std::move(pair), watch);
    watch.begin("pairs");
    all.facets = facets.facets().size();
    std::mutex adding;
    watch.run_intervals(facets.facets().size(), 16, [&](std::size_t, std::size_t first, std::size_t last) {
      SolidPairEventCount some;
      for (std::size_t f = first; f < last; ++f) count_pairs(facets, static_cast<std::uint32_t>(f), some);
      const std::lock_guard lock(adding);
      all.pairs_that_meet += some.pairs_that_meet, all.exact_pairs += some.exact_pairs;
      all.vertex_on_facet += some.vertex_on_facet, all.edge_on_edge += some.edge_on_edge;
    });
    watch.begin("");
    return all;
  });
}

}  // namespace dymsum
