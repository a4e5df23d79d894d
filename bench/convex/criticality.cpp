#include "convex/criticality.h"

#include <cmath>
#include <vector>

#include "versus/rival.h"

namespace dymsum::bench {

CriticalityRow measure_criticality(const solids::NamedMesh& p, const solids::NamedMesh& q,
                                   std::array<std::int32_t, 3> axis) {
  constexpr int kSteps = 500, kSumEvery = 25;
  CriticalityRow row;
  row.p = p.name;
  row.q = q.name;
  row.p_triangles = p.mesh.triangle_count();
  row.q_triangles = q.mesh.triangle_count();

  const double start = cpu_ms();
  const CriticalityMap map = *CriticalityMap::create(p.mesh, q.mesh, axis);
  row.build_ms = cpu_ms() - start;
  row.angles = map.size();
  row.stats = map.stats();
  row.map_bytes = map.bytes();

  std::vector<Rotation> poses;
  // Not at zero and the half turn, where symmetric solids meet and the generic facets are a matter of ties.
  for (int k = 0; k <= kSteps; ++k) poses.push_back(map.near(2 * std::acos(-1.0) * (k + 0.5) / kSteps));
  const auto per_step_us = [&](double since) { return 1e3 * (cpu_ms() - since) / kSteps; };
  ConvexSum moving = *ConvexSum::create(p.mesh, q.mesh);
  moving.set(poses[0]);
  const double updates = cpu_ms();
  for (int k = 1; k <= kSteps; ++k) moving.set(poses[k]);
  row.update_us = per_step_us(updates);
  row.sum_bytes = moving.bytes();

  std::size_t facets = 0;
  const double reads = cpu_ms();
  for (int k = 1; k <= kSteps; ++k) facets += *map.facet_count(poses[k]);
  row.structure_us = per_step_us(reads);

  for (int k = 1; k <= kSteps; ++k) {
    double since = cpu_ms();
    moving.set(poses[k]);
    const bool sums = k % kSumEvery == 0;
    facets -= moving.face_vertex_count() + moving.edge_edge_count();
    if (!sums) continue;
    const SpatialSum theirs = moving.sum();
    row.update_sum_us += 1e3 * (cpu_ms() - since);
    since = cpu_ms();
    const SpatialSum ours = *map.at(poses[k]);
    row.map_sum_us += 1e3 * (cpu_ms() - since);
    ++row.compared;
    row.different += !(ours == theirs);
  }
  row.update_sum_us /= static_cast<double>(row.compared);
  row.map_sum_us /= static_cast<double>(row.compared);
  ++row.compared;
  row.different += facets != 0;  // as many generic facets in both, all steps together
  return row;
}

}  // namespace dymsum::bench
