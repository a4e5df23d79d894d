#include "spatial/boolean/solid_union.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <new>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "base/poll.h"
#include "dymsum/solid_union.h"
#include "exact/orient.h"
#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/boundary/collision.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/mesh_validate.h"
#include "spatial/mesh/triangulate.h"
#include "spatial/mesh/vec3.h"
#include "spatial/sum/common_grid.h"
#include "spatial/sum/solid_boundary.h"
#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {
namespace {

// Winding numbers on both sides of the cells of an arrangement of closed surfaces.

/// How often closed surfaces of triangles go around a position.
class WindingNumber {
 public:
  /// Winding numbers of triangles of the space's P, where its Q is one vertex. Keeps the references.
  WindingNumber(const SumSpace& space, const std::vector<Triangle>& triangles);

  /// The triangles above a position that is on none of them: those seen from below their backs less those seen from
  /// below their fronts. Exact. O(log n + k) for k triangles in line with it along z.
  int at(const Flag& x) const;

 private:
  const SumSpace& space_;
  const std::vector<Triangle>& triangles_;
  BoxTree tree_;
};

struct CellWindings {
  std::vector<std::int32_t> above;  ///< per cell, on the side of its plane's normal
  std::uint64_t components = 0;     ///< of the surfaces: parts that share no point
  std::uint64_t volumes = 0;        ///< pieces of space, each counted once for every component that bounds it
};

std::vector<Box> boxes_around(const SumSpace& space, const std::vector<Triangle>& triangles) {
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    Box box;
    for (const std::uint32_t v : t) box.add(space.approx({v, 0}));
    box.grow(space.sum_radius());
    boxes.push_back(box);
  }
  return boxes;
}

std::int32_t step(const Cell& cell) {
  return static_cast<std::int32_t>(cell.front) - static_cast<std::int32_t>(cell.back);
}

const Cell& cell_of(const SolidArrangement& arrangement, std::uint32_t cell) {
  const PlaneGroup& group = arrangement.groups[arrangement.group_of(cell)];
  return group.cells.cells[cell - group.first_cell];
}

/// The sides of all cells, 2 c below cell c and 2 c + 1 above it, joined where they look into one piece of space: the
/// root of every side.
std::vector<std::uint32_t> joined_sides(const SumSpace& space, const SolidArrangement& arrangement, StageWatch& watch) {
  constexpr std::size_t kPart = 2048;
  const std::size_t edges = arrangement.edge_ends.size();
  std::vector<std::vector<std::array<std::uint32_t, 2>>> joins((edges + kPart - 1) / kPart);
  const auto index = [](CellSide s) { return 2 * s.cell + (s.side > 0 ? 1u : 0u); };
  watch.run(joins.size(), [&](std::size_t part) {
    EdgeWedges wedges(space, arrangement, [](std::uint32_t) { return true; });
    for (std::size_t e = part * kPart; e < std::min(edges, (part + 1) * kPart); ++e)
      wedges.for_each(static_cast<std::uint32_t>(e), [&](CellSide x, CellSide y) {
        joins[part].push_back({index(x), index(y)});
      });
  });
  std::vector<std::uint32_t> parent(2 * std::size_t{arrangement.cell_count});
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t s) {
    while (parent[s] != s) s = parent[s] = parent[parent[s]];
    return s;
  };
  for (const auto& part : joins)
    for (const auto& [x, y] : part) parent[root(x)] = root(y);
  for (std::uint32_t s = 0; s < parent.size(); ++s) parent[s] = root(s);
  return parent;
}

WindingNumber::WindingNumber(const SumSpace& space, const std::vector<Triangle>& triangles)
    : space_(space), triangles_(triangles), tree_(boxes_around(space, triangles)) {}

int WindingNumber::at(const Flag& x) const {
  const FlagQuery query(space_, x);
  Box ray = query.box();
  ray.grow(4 * space_.sum_radius());
  ray.high.z = 1e300;
  int winding = 0;
  tree_.for_each(ray, [&](std::uint32_t t) {
    const Triangle& c = triangles_[t];
    int turn = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = c[k], b = c[(k + 1) % 3];
      const PlaneSource upright{{a, 0}, {DirectionSource::Of::p, a, b}, {DirectionSource::Of::axis, 2, 0}, false};
      int s = query.side(upright, space_.p()[b] - space_.p()[a], {0, 0, 1});
      // The sign is that of the position moved by an infinitesimal along x, and a smaller one along y.
      for (int axis = 0; axis < 2 && s == 0; ++axis) s = space_.exact_normal(upright, axis);
      if (s == 0 || (k > 0 && s != turn)) return;
      turn = s;
    }
    const PlaneSource plane{
        {c[0], 0}, {DirectionSource::Of::p, c[0], c[1]}, {DirectionSource::Of::p, c[0], c[2]}, false};
    const int up = space_.exact_normal(plane, 2);
    const Vec3 &a = space_.p()[c[0]], &b = space_.p()[c[1]], &d = space_.p()[c[2]];
    if (query.side(plane, b - a, d - a) * up < 0) winding += up;
  });
  return winding;
}

/// The first edge of the arrangement around which the cells do not close: the winding number changes on the way around
/// it. None where the triangles together are closed surfaces. O(n).
std::optional<std::uint32_t> open_edge(const SolidArrangement& arrangement) {
  for (std::uint32_t edge = 0; edge < arrangement.edge_ends.size(); ++edge) {
    std::int64_t around = 0;
    for (const EdgeUse use : arrangement.uses(edge)) {
      const PlaneGroup& group = arrangement.groups[use.group];
      const CellEdge& e = group.cells.edges[use.edge];
      const bool up = arrangement.point(group, e.a) < arrangement.point(group, e.b);
      // Counter-clockwise around the edge, the left half is passed from below to above, the right one from above.
      if (e.left != kNoId) around += (up ? -1 : 1) * step(group.cells.cells[e.left]);
      if (e.right != kNoId) around += (up ? 1 : -1) * step(group.cells.cells[e.right]);
    }
    if (around != 0) return edge;
  }
  return std::nullopt;
}

/// Requires closed surfaces. The winding number below a cell is that above it, plus the facets that face the normal's
/// way, less the others; it is the same for all cells that look into one wedge around an edge; and for every component
/// it is counted at one position. Exact.
CellWindings cell_windings(const SumSpace& space, const SolidArrangement& arrangement, const WindingNumber& winding,
                           StageWatch& watch) {
  const std::vector<std::uint32_t> volume = joined_sides(space, arrangement, watch);
  const std::uint32_t cells = arrangement.cell_count;
  std::vector<std::int32_t> steps;
  steps.reserve(cells);
  for (const PlaneGroup& group : arrangement.groups)
    for (const Cell& cell : group.cells.cells) steps.push_back(step(cell));

  // The cells around every piece of space, as runs of a list.
  std::vector<std::uint32_t> first(volume.size() + 1), around(volume.size());
  for (const std::uint32_t v : volume) ++first[v + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t s = 0; s < volume.size(); ++s) around[next[volume[s]]++] = s;

  // Winding numbers relative to that of the first piece of every component.
  CellWindings result;
  std::vector<std::int32_t> relative(volume.size());
  std::vector<std::uint32_t> component(volume.size(), kNoId), starts, queue;
  for (std::uint32_t start = 0; start < volume.size(); ++start) {
    if (volume[start] != start || component[start] != kNoId) continue;
    const auto name = static_cast<std::uint32_t>(starts.size());
    starts.push_back(around[first[start]]);
    component[start] = name;
    queue.assign(1, start);
    for (std::size_t k = 0; k < queue.size(); ++k) {
      const std::uint32_t here = queue[k];
      for (std::uint32_t i = first[here]; i < first[here + 1]; ++i) {
        const std::uint32_t side = around[i], there = volume[side ^ 1];
        const std::int32_t value = relative[here] + ((side & 1) != 0 ? 1 : -1) * steps[side / 2];
        if (component[there] == kNoId) {
          component[there] = name, relative[there] = value;
          queue.push_back(there);
        } else if (relative[there] != value) {
          throw std::logic_error("winding numbers of a surface that is not closed");
        }
      }
    }
    result.volumes += queue.size();
  }
  result.components = starts.size();

  // One position for every component.
  std::vector<std::int32_t> offset(starts.size());
  watch.run(starts.size(), [&](std::size_t k) {
    const PlaneGroup& group = arrangement.groups[arrangement.group_of(starts[k] / 2)];
    const Cell& cell = cell_of(arrangement, starts[k] / 2);
    const int side = (starts[k] & 1) != 0 ? 1 : -1;
    offset[k] = winding.at(flag_at(arrangement, group, cell, side)) - relative[volume[starts[k]]];
  });
  result.above.reserve(cells);
  for (std::uint32_t c = 0; c < cells; ++c) {
    const std::uint32_t v = volume[2 * std::size_t{c} + 1];
    result.above.push_back(relative[v] + offset[component[v]]);
  }
  return result;
}

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
SolidOperand surface_operand(const CommonGrid& grid, const ExactSet& surface) {
  SolidOperand operand;
  operand.vertices = surface.set.vertices;
  for (std::uint32_t f = 0; f < surface.set.faces.size(); ++f) {
    const Face& face = surface.set.faces[f];
    operand.triangles.push_back({face[0], face[1], face[2]});
    operand.face.push_back(f);
  }
  operand.first_plate = static_cast<std::uint32_t>(operand.triangles.size());
  operand.exact = vertices_on(grid, surface), operand.exponent = grid.unit();
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
  const CommonGrid grid = common_grid(sets);
  Result<SpatialSum> inside = inside_of(surface_operand(grid, data), rule, options);
  if (!inside) {
    Error error = inside.error();
    const double by = exact::round_to_double(grid.scale, exact::BigInteger(1) << grid.shift());
    for (std::optional<double>* c : {&error.evidence.x, &error.evidence.y, &error.evidence.z})
      if (*c) **c /= by;
    return error;
  }
  SpatialSum made = *std::move(inside);
  unscale(made, grid.scale, grid.shift());
  return made;
}

}  // namespace dymsum::spatial

namespace dymsum {
namespace {

using spatial::InsideRule;

/// Faces of a solid behind those of others, perhaps turned inside out; thin ones stay as faces that are left out.
void append(MeshData& all, const Mesh& solid, bool inside_out = false) {
  const auto first = static_cast<std::uint32_t>(all.vertices.size());
  all.vertices.insert(all.vertices.end(), solid.vertices().begin(), solid.vertices().end());
  for (std::size_t f = 0; f < solid.faces().size(); ++f) {
    Face face = solid.faces()[f];
    if (solid.has_thin_parts() && solid.thin_faces()[f]) face.resize(1);
    for (std::uint32_t& v : face) v += first;
    if (inside_out) std::reverse(face.begin(), face.end());
    all.faces.push_back(std::move(face));
  }
}

Result<SpatialSum> of_two(const Mesh& a, const Mesh& b, bool b_inside_out, InsideRule rule,
                          const SpatialOptions& options) {
  MeshData all;
  append(all, a);
  append(all, b, b_inside_out);
  return spatial::solid_inside(all, rule, options);
}

InsideRule rule_of(Fill fill) {
  switch (fill) {
    case Fill::positive:
      return {};
    case Fill::nonzero:
      return {1, true, false};
    case Fill::even_odd:
      return {1, true, true};
  }
  throw std::invalid_argument("no fill");
}

}  // namespace

Result<SpatialSum> united(const MeshData& surface, Fill fill, const SpatialOptions& options) {
  return spatial::solid_inside(surface, rule_of(fill), options);
}

Result<SpatialSum> united(std::span<const Mesh> solids, const SpatialOptions& options) {
  MeshData all;
  for (const Mesh& solid : solids) append(all, solid);
  return spatial::solid_inside(all, {}, options);
}

Result<SpatialSum> intersection(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  return of_two(a, b, false, {2, false, false}, options);
}

Result<SpatialSum> intersection(std::span<const Mesh> solids, const SpatialOptions& options) {
  if (solids.empty()) return Error{ErrorCode::out_of_range, "an intersection takes at least one solid, not 0", {}};
  MeshData all;
  for (const Mesh& solid : solids) append(all, solid);
  return spatial::solid_inside(all, {static_cast<int>(solids.size()), false, false}, options);
}

Result<SpatialSum> difference(const Mesh& a, std::span<const Mesh> taken, const SpatialOptions& options) {
  MeshData all;
  append(all, a);
  for (const Mesh& solid : taken) append(all, solid, true);
  return spatial::solid_inside(all, {}, options);
}

Result<SpatialSum> difference(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  return of_two(a, b, true, {}, options);
}

Result<SpatialSum> symmetric_difference(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  return of_two(a, b, false, {1, true, true}, options);
}

namespace {

/// By winding numbers, those from `first_taken` on inside out: of meshes where doubles hold all of them.
Result<SpatialSum> by_winding(std::span<const SpatialOperand> sets, std::size_t first_taken, InsideRule rule,
                              const SpatialOptions& options) {
  std::vector<spatial::OperandSet> operands;
  for (const SpatialOperand& set : sets) operands.emplace_back(set, Semantics::regular);
  const bool in_doubles = std::all_of(operands.begin(), operands.end(), [](const auto& o) { return o.mesh(); });
  MeshData meshes;
  spatial::ExactSet triangles;
  for (std::size_t k = 0; k < operands.size(); ++k) {
    if (in_doubles) append(meshes, *operands[k].mesh(), k >= first_taken);
    else spatial::append(triangles, spatial::regular_triangles(operands[k]), k >= first_taken);
  }
  return in_doubles ? spatial::solid_inside(meshes, rule, options) : spatial::solid_inside(triangles, rule, options);
}

Result<SpatialSum> by_winding(const SpatialOperand& a, const SpatialOperand& b, std::size_t first_taken,
                              InsideRule rule, const SpatialOptions& options) {
  const SpatialOperand both[]{a, b};
  return by_winding(both, first_taken, rule, options);
}

}  // namespace

Result<SpatialSum> united(std::span<const SpatialOperand> sets, const SpatialOptions& options) {
  return by_winding(sets, sets.size(), {}, options);
}

Result<SpatialSum> intersection(std::span<const SpatialOperand> sets, const SpatialOptions& options) {
  if (sets.empty()) return Error{ErrorCode::out_of_range, "an intersection takes at least one solid, not 0", {}};
  return by_winding(sets, sets.size(), {static_cast<int>(sets.size()), false, false}, options);
}

Result<SpatialSum> difference(const SpatialOperand& a, std::span<const SpatialOperand> taken,
                              const SpatialOptions& options) {
  std::vector<SpatialOperand> all{a};
  all.insert(all.end(), taken.begin(), taken.end());
  return by_winding(all, 1, {}, options);
}

Result<SpatialSum> intersection(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options) {
  return by_winding(a, b, 2, {2, false, false}, options);
}

Result<SpatialSum> difference(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options) {
  return by_winding(a, b, 1, {}, options);
}

Result<SpatialSum> symmetric_difference(const SpatialOperand& a, const SpatialOperand& b,
                                        const SpatialOptions& options) {
  return by_winding(a, b, 2, {1, true, true}, options);
}

}  // namespace dymsum
