#include "planar/result/result_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "exact/grid.h"
#include "planar/result/ring_visits.h"
#include "planar/result/sum_skeleton.h"

namespace dymsum::planar {
namespace {

using exact::BigInteger;
using exact::HomogeneousPoint;

/// Rings, segments and points one after the other, by vertices of the skeleton.
class RegionWriter {
 public:
  RegionWriter(const SumSkeleton& skeleton, const std::vector<HomogeneousPoint>& positions)
      : skeleton_(skeleton), positions_(positions) {}

  void add(std::vector<Point>& to, std::uint32_t vertex, std::uint32_t edge) {
    to.push_back(skeleton_.nearest[vertex]);
    out_.vertex_indices.push_back(vertex);
    out_.edge_indices.push_back(edge);
    fractions_.push_back(positions_[vertex]);
    doubles_ &= is_double(positions_[vertex], skeleton_.nearest[vertex]);
  }
  void add_rings() {
    const RingVisits rings(skeleton_);
    const auto& visits = rings.visits();
    out_.touching = true;
    std::vector<std::uint8_t> seen(visits.size(), 0);
    // The interior of a part is connected: one of its rings runs along the outer one, and the part begins with it.
    for (std::uint32_t v = 0; v < visits.size(); ++v) {
      if (seen[v] != 0) continue;
      const bool outer = skeleton_.chains[visits[v].chain].ring == 0;
      if (outer) out_.own.parts.emplace_back();
      Part& part = out_.own.parts.back();
      Ring& ring = outer ? part.outer : part.holes.emplace_back();
      for (std::uint32_t k = v; seen[k] == 0; k = visits[k].next) {
        seen[k] = 1;
        add(ring, visits[k].vertex, visits[k].edge);
      }
    }
  }
  EngineRegion write() {
    add_rings();
    for (const SumSkeleton::Chain& chain : skeleton_.chains) {
      if (chain.closed) continue;
      std::vector<Point>& to = chain.count == 1 ? out_.own.points : out_.own.polylines.emplace_back();
      for (std::uint32_t k = 0; k < chain.count; ++k) add(to, chain.first + k, chain.first + k);
    }
    if (!doubles_) out_.fractions = std::make_shared<const std::vector<HomogeneousPoint>>(std::move(fractions_));
    return std::move(out_);
  }

 private:
  const SumSkeleton& skeleton_;
  const std::vector<HomogeneousPoint>& positions_;
  EngineRegion out_;
  std::vector<HomogeneousPoint> fractions_;
  bool doubles_ = true;
};

}  // namespace

bool is_double(const HomogeneousPoint& position, Point nearest) {
  if (msb(position.w) != lsb(position.w) || !std::isfinite(nearest.x) || !std::isfinite(nearest.y)) return false;
  const HomogeneousPoint own = exact::homogeneous(nearest.x, nearest.y);
  return own.x * position.w == position.x * own.w && own.y * position.w == position.y * own.w;
}

std::vector<HomogeneousPoint> positions_of(const PlanarSum& sum) {
  std::vector<HomogeneousPoint> positions;
  for_each_vertex(
      sum, [&](const SumVertex& v) { positions.push_back(exact::in_lowest_terms(exact_source(sum)->homogeneous(v))); });
  return positions;
}

EngineRegion region_of_result(const PlanarSum& sum) {
  const SumSkeleton skeleton(sum);
  return RegionWriter(skeleton, positions_of(sum)).write();
}

}  // namespace dymsum::planar
