#include "spatial/sum/exact_set.h"

#include <utility>

#include "spatial/sum/common_grid.h"
#include "spatial/sum/spatial_sum.h"
#include "spatial/sum/vertex_signs.h"

namespace dymsum::spatial {

namespace {

SolidOperand operand_on(const CommonGrid& grid, const ExactSet& set) {
  return solid_operand(set.set, set.thin, vertices_on(grid, set), grid.unit());
}

}  // namespace

ExactSet exact_set(MeshData set, std::vector<bool> thin) {
  ExactSet result{std::move(set), std::move(thin), {}};
  for (const Point3& v : result.set.vertices)
    result.at.push_back({exact::exact_value(v.x), exact::exact_value(v.y), exact::exact_value(v.z)});
  return result;
}

ExactSet exact_set(const SpatialSum& sum) {
  ExactSet result;
  if (sum.vertices.empty()) return result;
  std::vector<bool> used(sum.vertices.size());
  std::vector<std::uint32_t> name(sum.vertices.size());
  const Triangles all = triangulated(sum);
  for (const Triangle& t : all.triangles)
    for (const std::uint32_t v : t) used[v] = true;
  const SpatialPositions& positions = SpatialSumInternals::positions(sum);
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    name[v] = static_cast<std::uint32_t>(result.at.size());
    result.at.push_back(positions.at(v));
    result.set.vertices.push_back(positions.rounded(v));
  }
  for (const Triangle& t : all.triangles) result.set.faces.push_back({name[t[0]], name[t[1]], name[t[2]]});
  return result;
}

Result<SpatialSum> sum_of_exact_sets(const ExactSet& p, const ExactSet& q, const SpatialOptions& options,
                                     int most_common_bits) {
  const ExactSet* const sets[]{&p, &q};
  const CommonGrid grid = common_grid(sets, most_common_bits);
  Result<SpatialSum> sum = sum_of_operands(operand_on(grid, p), operand_on(grid, q), options);
  if (!sum) return sum;
  SpatialSum made = *std::move(sum);
  unscale(made, grid.scale, grid.shift());
  return made;
}

}  // namespace dymsum::spatial
