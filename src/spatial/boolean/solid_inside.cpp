#include "spatial/boolean/solid_inside.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "base/poll.h"
#include "exact/orient.h"
#include "spatial/boolean/cell_windings.h"
#include "spatial/boundary/cell_links.h"
#include "spatial/mesh/equal_positions.h"
#include "spatial/mesh/mesh_validate.h"
#include "spatial/sum/common_grid.h"
#include "spatial/sum/grid_error.h"
#include "spatial/sum/solid_boundary.h"
#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

namespace {

/// The surface's triangles with an area. Vertices keep their indices; those that no triangle has lie where another one
/// does, so that they need no digits of their own.
SolidOperand surface_operand(const MeshData& surface) {
  SolidOperand operand;
  operand.vertices = surface.vertices;
  const std::vector<std::uint32_t> first = first_at_position(surface.vertices);
  std::vector<bool> used(surface.vertices.size());
  const auto add = [&](const Triangle& t, std::uint32_t face) {
    const Triangle at{first[t[0]], first[t[1]], first[t[2]]};
    if (exact::collinear(operand.vertices[at[0]], operand.vertices[at[1]], operand.vertices[at[2]])) return;
    for (const std::uint32_t v : at) used[v] = true;
    operand.triangles.push_back(at);
    operand.face.push_back(face);
  };
  for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
    const Face& face = surface.faces[f];
    if (face.size() == 3) add({face[0], face[1], face[2]}, f);
    if (face.size() <= 3) continue;
    for (const Triangle& t : triangulated(surface.vertices, face, average_view(surface.vertices, face))) add(t, f);
  }
  operand.first_plate = static_cast<std::uint32_t>(operand.triangles.size());
  const auto some = static_cast<std::size_t>(std::find(used.begin(), used.end(), true) - used.begin());
  for (std::size_t v = 0; v < used.size(); ++v)
    if (!used[v] && some < used.size()) operand.vertices[v] = operand.vertices[some];
  return operand;
}

/// The same of triangles, at exact positions.
Result<SolidOperand> surface_operand(const CommonGrid& grid, const ExactSet& surface) {
  Result<std::vector<ExactVertex>> exact = vertices_on(grid, surface);
  if (!exact) return exact.error();
  SolidOperand operand;
  operand.vertices = surface.set.vertices;
  for (std::uint32_t f = 0; f < surface.set.faces.size(); ++f) {
    const Face& face = surface.set.faces[f];
    operand.triangles.push_back({face[0], face[1], face[2]});
    operand.face.push_back(f);
  }
  operand.first_plate = static_cast<std::uint32_t>(operand.triangles.size());
  operand.exact = *std::move(exact), operand.exponent = grid.unit();
  return operand;
}

/// The origin, on the grid of a surface.
SolidOperand point_operand(const SolidOperand& surface) {
  SolidOperand operand;
  operand.vertices = {{0, 0, 0}};
  if (!surface.exact.empty()) operand.exact.emplace_back(), operand.exponent = surface.exponent;
  return operand;
}

ReducedConvolution facets_of(const SolidOperand& surface) {
  ReducedConvolution result;
  result.facets.reserve(surface.triangles.size()), result.planes.reserve(surface.triangles.size());
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto [a, b, c] = surface.triangles[t];
    result.facets.push_back({SumFacet::Kind::face_vertex, 3, t, 0, {SumPoint{a, 0}, SumPoint{b, 0}, SumPoint{c, 0}}});
    result.planes.push_back({{a, 0}, {DirectionSource::Of::p, a, b}, {DirectionSource::Of::p, a, c}, false});
  }
  result.counts.face_vertex = result.facets.size();
  return result;
}

/// Thrown where the surface is not closed, with a position on such an edge.
struct OpenAt {
  Point3 at;
};

Point3 midpoint(const SumSpace& space, const SolidArrangement& arrangement, std::uint32_t edge) {
  const auto [a, b] = arrangement.edge_ends[edge];
  const Vec3 at = 0.5 * (arrangement.points.approx(a).at + arrangement.points.approx(b).at);
  const auto along = [&](double value, int axis) {
    const SumSpace::Line line = space.line(axis);
    return std::ldexp(value, line.unit) + line.p_offset + line.q_offset;
  };
  return {along(at.x, 0), along(at.y, 1), along(at.z, 2)};
}

/// The cells that bound what is inside.
SolidBoundary boundary_inside(const SolidOperand& surface, const SolidOperand& point, InsideRule rule,
                              SpatialStats& stats, StageWatch& watch) {
  SolidBoundary result;
  result.either_side = true;
  watch.begin("surface");
  result.space = space_of(surface, point);
  watch.hold(table_bytes(surface.triangles.size()));
  result.table = facet_table(*result.space, facets_of(surface), watch);
  find_cells(result, stats, watch);
  if (const auto edge = open_edge(*result.arrangement))
    throw OpenAt{midpoint(*result.space, *result.arrangement, *edge)};
  watch.begin("winding numbers");
  const WindingNumber winding(*result.space, surface.triangles);
  const CellWindings windings = cell_windings(*result.space, *result.arrangement, winding, watch);
  for (PlaneGroup& group : result.arrangement->groups) {
    for (std::uint32_t c = 0; c < group.cells.cells.size(); ++c) {
      Cell& cell = group.cells.cells[c];
      const std::int32_t above = windings.above[group.first_cell + c];
      const std::int32_t below = above + static_cast<std::int32_t>(cell.front) - static_cast<std::int32_t>(cell.back);
      cell.front = rule.holds(below), cell.back = rule.holds(above);
    }
  }
  watch.begin("links");
  const CellLinks links = link_cells(*result.space, *result.arrangement, watch);
  result.boundary.reserve(links.patch.size());
  for (const std::uint32_t patch : links.patch) result.boundary.push_back(patch != kNoId);
  result.patch = links.patch;
  watch.begin("");
  stats.bits = result.space->bits();
  stats.face_vertex = surface.triangles.size();
  stats.points = result.arrangement->points.size(), stats.cells = result.arrangement->cell_count;
  stats.patches = links.patches;
  stats.collision_tests = windings.components;
  stats.held_bytes = watch.held();
  stats.double_pair_signs = result.space->signs().at(exact::Rung::double_pairs);
  stats.exact_signs = result.space->signs().exact();
  return result;
}

Result<SpatialSum> inside_of(const SolidOperand& surface, InsideRule rule, const SpatialOptions& options) {
  SpatialSum sum;
  if (surface.triangles.empty()) return sum;
  const SolidOperand point = point_operand(surface);
  try {
    StageWatch watch(options, sum.stats);
    SolidBoundary boundary = boundary_inside(surface, point, rule, sum.stats, watch);
    watch.begin("faces");
    assemble(boundary, surface, point, sum, watch);
    watch.begin("");
  } catch (const std::invalid_argument&) {
    if (std::optional<Error> error = grid_error(surface.vertices, point.vertices)) return *std::move(error);
    throw;
  } catch (const Cancelled&) {
    return cancelled();
  } catch (const OverBudget& e) {
    return base::budget_error("the solid takes at least", e.bytes, options.memory);
  } catch (const OpenAt& e) {
    Error error{ErrorCode::not_closed, "the faces do not close around an edge here", {}};
    error.evidence.x = e.at.x, error.evidence.y = e.at.y, error.evidence.z = e.at.z;
    return error;
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::out_of_memory, "the solid needs more memory than there is", {}};
  }
  return sum;
}

}  // namespace

Result<SpatialSum> solid_inside(const MeshData& data, InsideRule rule, const SpatialOptions& options) {
  if (auto error = check_finite(data.vertices)) return *std::move(error);
  if (auto error = check_indices(data)) return *std::move(error);
  return inside_of(surface_operand(data), rule, options);
}

Result<SpatialSum> solid_inside(const ExactSet& data, InsideRule rule, const SpatialOptions& options) {
  const ExactSet* const sets[]{&data};
  const Result<CommonGrid> grid = common_grid(sets);
  if (!grid) return grid.error();
  const Result<SolidOperand> surface = surface_operand(*grid, data);
  if (!surface) return surface.error();
  Result<SpatialSum> inside = inside_of(*surface, rule, options);
  if (!inside) {
    Error error = inside.error();
    const double by = exact::round_to_double(grid->scale, exact::BigInteger(1) << grid->shift());
    for (std::optional<double>* c : {&error.evidence.x, &error.evidence.y, &error.evidence.z})
      if (*c) **c /= by;
    return error;
  }
  SpatialSum made = *std::move(inside);
  unscale(made, grid->scale, grid->shift());
  return made;
}

}  // namespace dymsum::spatial
