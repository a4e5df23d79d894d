#include "dymsum/planar_sum.h"

#include <array>

#include "planar/operand/prepared_region.h"
#include "planar/region/separate_touching.h"
#include "planar/result/finish_sum.h"
#include "planar/sum/sum_engine.h"

namespace dymsum {
namespace {

using planar::EngineRegion;
using planar::Operand;
using planar::separate_touching;

Result<PlanarSum> sum_of(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q,
                         const SumOptions& options) {
  Result<planar::SumState> state = planar::compute_boundary(std::move(p), std::move(q), options);
  if (!state.ok()) return state.error();
  return planar::finish_sum(std::move(state).value(), options);
}

EngineRegion engine_region(const Region& r) { return separate_touching(r.data(), r.touching_points()); }

std::array<std::uint32_t, 3> group_sizes(const RegionData& r) {
  std::array<std::uint32_t, 3> count{};
  for (const Part& part : r.parts) {
    count[0] += static_cast<std::uint32_t>(part.outer.size());
    for (const Ring& hole : part.holes) count[0] += static_cast<std::uint32_t>(hole.size());
  }
  for (const Polyline& line : r.polylines) count[1] += static_cast<std::uint32_t>(line.size());
  count[2] = static_cast<std::uint32_t>(r.points.size());
  return count;
}

// All regions as one. Region data are numbered parts first, then polylines, then points, so the groups are joined one
// by one.
EngineRegion join(const std::vector<Region>& regions) {
  EngineRegion all;
  for (int group = 0; group < 3; ++group) {
    std::uint32_t first_number = 0;
    for (const Region& region : regions) {
      const EngineRegion r = engine_region(region);
      all.touching |= r.touching;
      const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
      if (group == 0) append(all.own.parts, r.data().parts);
      if (group == 1) append(all.own.polylines, r.data().polylines);
      if (group == 2) append(all.own.points, r.data().points);
      const auto sizes = group_sizes(r.data());
      std::uint32_t at = group == 0 ? 0 : group == 1 ? sizes[0] : sizes[0] + sizes[1];
      for (std::uint32_t k = 0; k < sizes[group]; ++k, ++at) {
        all.vertex_indices.push_back(first_number + r.vertex_index(at));
        all.edge_indices.push_back(first_number + r.edge_index(at));
      }
      first_number += static_cast<std::uint32_t>(region.vertex_count());
    }
  }
  return all;
}

}  // namespace

Result<PlanarSum> minkowski_sum(const Region& p, const Region& q, const SumOptions& options) {
  return sum_of(planar::prepared_operand(p, 0), planar::prepared_operand(q, 1), options);
}

Result<PlanarSum> nfp(const Region& a, const Region& b, const SumOptions& options) {
  return sum_of(planar::prepared_operand(a, 0), planar::prepared_operand(b, 1, true), options);
}

Result<PlanarSum> union_of(const std::vector<Region>& regions, const SumOptions& options) {
  const RegionData origin{{}, {}, {Point{0, 0}}};
  return sum_of(planar::make_operand(join(regions), 0), planar::make_operand(separate_touching(origin, {}), 1),
                options);
}

}  // namespace dymsum
