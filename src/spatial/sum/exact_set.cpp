#include "spatial/sum/exact_set.h"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>

#include "spatial/sum/common_grid.h"
#include "spatial/sum/exact_locator.h"
#include "spatial/sum/solid_boundary.h"
#include "spatial/sum/spatial_sum.h"
#include "spatial/sum/vertex_signs.h"

namespace dymsum::spatial {

namespace {

SolidOperand operand_on(const CommonGrid& grid, const ExactSet& set) {
  return solid_operand(set.set, set.thin, vertices_on(grid, set), grid.unit());
}

/// Faces whose vertices are those of a list, some of which none of them has.
ExactSet with_used_vertices(std::vector<Face> faces, std::vector<bool> thin, std::size_t count,
                            const std::function<ExactPosition(std::uint32_t)>& at,
                            const std::function<Point3(std::uint32_t)>& near) {
  ExactSet result;
  std::vector<bool> used(count);
  for (const Face& face : faces)
    for (const std::uint32_t v : face) used[v] = true;
  std::vector<std::uint32_t> name(count);
  for (std::uint32_t v = 0; v < count; ++v) {
    if (!used[v]) continue;
    name[v] = static_cast<std::uint32_t>(result.at.size());
    result.at.push_back(at(v));
    result.set.vertices.push_back(near(v));
  }
  for (Face& face : faces)
    for (std::uint32_t& v : face) v = name[v];
  result.set.faces = std::move(faces), result.thin = std::move(thin);
  return result;
}

ExactSet set_of(const SpatialSum& sum, std::span<const Face> thin_faces) {
  if (sum.vertices.empty()) return {};
  std::vector<Face> faces;
  for (const Triangle& t : triangulated(sum).triangles) faces.push_back({t[0], t[1], t[2]});
  std::vector<bool> thin;
  if (!thin_faces.empty()) {
    thin.assign(faces.size(), false);
    thin.resize(faces.size() + thin_faces.size(), true);
    faces.insert(faces.end(), thin_faces.begin(), thin_faces.end());
  }
  const SpatialPositions& positions = SpatialSumInternals::positions(sum);
  return with_used_vertices(
      std::move(faces), std::move(thin), sum.vertices.size(), [&](std::uint32_t v) { return positions.at(v); },
      [&](std::uint32_t v) { return positions.rounded(v); });
}

/// Whether the inside of a tight feature lies outside of the regular part. Positions of it are looked at until one is
/// not on the boundary, of which each triangle meets the feature in a segment at most. They lie on a conic, so that a
/// line holds no more than two of them.
bool is_outside(const ExactLocator& locator, const std::vector<ExactPosition>& corners) {
  const auto most = static_cast<std::int64_t>(2 * locator.boundary_triangles() + 1);
  for (std::int64_t k = 1; k <= most; ++k) {
    ExactPosition at{0, 0, 0};
    exact::BigRational all = 0;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const exact::BigRational weight = c == 0 ? 1 : c == 1 ? k : k * k;
      for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += weight * corners[c][axis];
      all += weight;
    }
    for (exact::BigRational& c : at) c /= all;
    const ExactLocator::Where where = locator.of(at);
    if (where != ExactLocator::Where::boundary) return where == ExactLocator::Where::outside;
  }
  return false;  // of a file: it lies in the boundary
}

/// What is tight outside of the regular part, as points, segments and triangles.
std::vector<Face> outer_features(const SpatialSum& sum) {
  std::vector<Face> all, outer;
  for (const auto& t : sum.tight_triangles()) all.push_back({t[0], t[1], t[2]});
  for (const auto& [from, to] : sum.tight_segments) all.push_back({from, to});
  for (const std::uint32_t v : sum.tight_points) all.push_back({v});
  if (all.empty() || sum.faces.empty()) return all;
  const ExactLocator locator(sum);
  const SpatialPositions& positions = SpatialSumInternals::positions(sum);
  for (Face& face : all) {
    std::vector<ExactPosition> corners;
    for (const std::uint32_t v : face) corners.push_back(positions.at(v));
    if (is_outside(locator, corners)) outer.push_back(std::move(face));
  }
  return outer;
}

}  // namespace

bool in_doubles(const ExactSet& set) {
  for (std::size_t v = 0; v < set.at.size(); ++v) {
    const Point3& p = set.set.vertices[v];
    if (exact::exact_value(p.x) != set.at[v][0] || exact::exact_value(p.y) != set.at[v][1] ||
        exact::exact_value(p.z) != set.at[v][2])
      return false;
  }
  return true;
}

ExactSet exact_set(MeshData set, std::vector<bool> thin) {
  ExactSet result{std::move(set), std::move(thin), {}};
  for (const Point3& v : result.set.vertices)
    result.at.push_back({exact::exact_value(v.x), exact::exact_value(v.y), exact::exact_value(v.z)});
  return result;
}

ExactSet exact_set(const SpatialSum& sum) { return set_of(sum, {}); }
ExactSet closed_set(const SpatialSum& sum) { return set_of(sum, outer_features(sum)); }

void append(ExactSet& all, const ExactSet& set, bool inside_out) {
  const auto first = static_cast<std::uint32_t>(all.at.size());
  all.set.vertices.insert(all.set.vertices.end(), set.set.vertices.begin(), set.set.vertices.end());
  all.at.insert(all.at.end(), set.at.begin(), set.at.end());
  for (Face face : set.set.faces) {
    if (inside_out) std::reverse(face.begin(), face.end());
    for (std::uint32_t& v : face) v += first;
    all.set.faces.push_back(std::move(face));
  }
}

ExactSet regular_part(ExactSet set) {
  if (set.thin.empty()) return set;
  std::vector<Face> faces;
  for (std::size_t f = 0; f < set.thin.size(); ++f)
    if (!set.thin[f]) faces.push_back(set.set.faces[f]);
  return with_used_vertices(
      std::move(faces), {}, set.at.size(), [&](std::uint32_t v) { return set.at[v]; },
      [&](std::uint32_t v) { return set.set.vertices[v]; });
}

OperandSet::OperandSet(const SpatialOperand& operand, Semantics semantics) {
  const SpatialSum* sum = spatial::result_of(operand);
  if (sum == nullptr) {
    mesh_ = *std::get<const Mesh*>(operand.set());
    return;
  }
  const bool tight = !sum->tight_faces.empty() || !sum->tight_segments.empty() || !sum->tight_points.empty();
  if (tight && semantics != Semantics::regular) {
    set_ = closed_set(*sum);
    if (!set_.thin.empty()) return;
  }
  if (Result<Mesh> mesh = as_mesh(*sum)) mesh_ = *std::move(mesh);
  else if (set_.at.empty()) set_ = exact_set(*sum);
}

ExactSet regular_triangles(const OperandSet& operand) {
  if (!operand.mesh()) return regular_part(operand.set());
  const Mesh& mesh = *operand.mesh();
  MeshData solid{mesh.vertices(), {}};
  const TriangulatedMesh all = triangulated(mesh);
  for (std::size_t t = 0; t < all.face.size(); ++t)
    if (!mesh.has_thin_parts() || !mesh.thin_faces()[all.face[t]]) solid.faces.push_back(all.mesh.faces()[t]);
  return exact_set(std::move(solid));
}

Result<SpatialSum> sum_of_exact_sets(const ExactSet& p, const ExactSet& q, const SpatialOptions& options,
                                     int most_common_bits) {
  if (in_doubles(p) && in_doubles(q)) return sum_of_sets(p.set, p.thin, q.set, q.thin, options);
  const ExactSet* const sets[]{&p, &q};
  const CommonGrid grid = common_grid(sets, most_common_bits);
  Result<SpatialSum> sum = sum_of_operands(operand_on(grid, p), operand_on(grid, q), options);
  if (!sum) return sum;
  SpatialSum made = *std::move(sum);
  unscale(made, grid.scale, grid.shift());
  return made;
}

}  // namespace dymsum::spatial

namespace dymsum {

Result<std::vector<bool>> contains_each(const SpatialOperand& p, const SpatialOperand& q,
                                        std::span<const RationalPoint3> positions, Semantics semantics,
                                        const Progress& progress) {
  const spatial::OperandSet a(p, semantics), b(q, semantics);
  if (a.mesh() && b.mesh()) return contains_each(*a.mesh(), *b.mesh(), positions, semantics, progress);
  const spatial::ExactSet first = a.set(), second = b.set();
  if (first.at.empty() || second.at.empty()) return std::vector<bool>(positions.size());
  const spatial::ExactSet* const sets[]{&first, &second};
  const spatial::CommonGrid grid = spatial::common_grid(sets);
  const spatial::SolidOperand on_grid[]{spatial::operand_on(grid, first), spatial::operand_on(grid, second)};
  const exact::BigRational scale(grid.scale, exact::BigInteger(1) << grid.shift());
  std::vector<spatial::ExactPosition> at;
  for (const RationalPoint3& z : positions)
    at.push_back({exact::exact_value(z.x) * scale, exact::exact_value(z.y) * scale, exact::exact_value(z.z) * scale});
  return spatial::positions_in_sum(*spatial::space_of(on_grid[0], on_grid[1]), on_grid[0], on_grid[1], at, semantics,
                                   progress);
}

Result<bool> contains(const SpatialOperand& p, const SpatialOperand& q, const RationalPoint3& z, Semantics semantics) {
  const Result<std::vector<bool>> inside = contains_each(p, q, std::span(&z, 1), semantics);
  if (!inside) return inside.error();
  return static_cast<bool>(inside->front());
}

}  // namespace dymsum
