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
#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/boolean/cell_windings.h"
#include "spatial/boolean/closed_sets.h"
#include "spatial/boolean/far_faces.h"
#include "spatial/boolean/surface.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/mesh_validate.h"
#include "spatial/mesh/vec3.h"
#include "spatial/sum/common_grid.h"
#include "spatial/sum/exact_locator.h"
#include "spatial/sum/solid_boundary.h"
#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {
namespace {

/// The origin, on the grid of a surface.
SolidOperand point_operand(const SolidOperand& surface) {
  SolidOperand operand;
  operand.vertices = {{0, 0, 0}};
  if (!surface.exact.empty()) operand.exact.emplace_back(), operand.exponent = surface.exponent;
  return operand;
}

/// The facets of those triangles.
ReducedConvolution facets_of(const SolidOperand& surface, const std::vector<std::uint32_t>& triangles) {
  ReducedConvolution result;
  result.facets.reserve(triangles.size()), result.planes.reserve(triangles.size());
  for (const std::uint32_t t : triangles) {
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

/// Pairs of near triangles, by the order of these.
NearPairs among_near(const NearPairs& pairs, const FarFaces& faces) {
  std::vector<std::uint32_t> name(faces.sheet.size(), kNoId);
  for (std::uint32_t k = 0; k < faces.near.size(); ++k) name[faces.near[k]] = k;
  NearPairs among;
  among.begin.reserve(faces.near.size() + 1), among.others.reserve(pairs.others.size());
  among.begin.push_back(0);
  for (const std::uint32_t t : faces.near) {
    for (const std::uint32_t other : pairs.of(t)) among.others.push_back(name[other]);
    among.begin.push_back(among.others.size());
  }
  return among;
}

std::vector<Sheet> sheets_of(const FarFaces& faces) {
  std::vector<Sheet> sheets;
  for (const auto& rim : faces.rims) {
    Sheet& sheet = sheets.emplace_back();
    sheet.rim.reserve(rim.size());
    for (const auto& [from, to] : rim) sheet.rim.push_back({SumPoint{from, 0}, SumPoint{to, 0}});
  }
  return sheets;
}

/// The cells of the surface, and of solids what is far.
FarFaces arrange_surface(const Surface& surface, bool all_pairs, SolidBoundary& result, SpatialStats& stats,
                         StageWatch& watch) {
  const SolidOperand& operand = surface.operand;
  FarFaces faces;
  NearPairs pairs;
  const bool by_solids = surface.of_solids() && !all_pairs;
  if (by_solids) {
    std::vector<Box> boxes = boxes_of(result.space->p(), operand.triangles, result.space->sum_radius());
    pairs = near_pairs_between(boxes, surface.first_triangle, watch);
    base::free_memory(boxes);
    faces = far_faces(surface, pairs, watch);
  } else {
    faces.near.resize(operand.triangles.size());
    std::iota(faces.near.begin(), faces.near.end(), 0u);
  }
  watch.hold(table_bytes(faces.near.size()));
  result.table = facet_table(*result.space, facets_of(operand, faces.near), watch);
  if (!all_pairs) find_inner_edges(*result.space, result.table);
  watch.begin("contacts");
  Contacts contacts = by_solids ? find_contacts_between(*result.space, result.table, among_near(pairs, faces), watch)
                                : find_contacts(*result.space, result.table, watch);
  stats.box_pairs = contacts.counts.box_pairs, stats.contacts = contacts.counts.contacts;
  watch.begin("arrangement");
  result.arrangement = std::make_unique<SolidArrangement>(
      arrange(*result.space, result.table, std::move(contacts), watch, {}, sheets_of(faces)));
  return faces;
}

/// The vertices of triangles as points of an arrangement: those that none of its points is are added.
class VertexPoints {
 public:
  VertexPoints(PointTable& points, std::size_t vertices) : points_(points), point_(vertices, kNoId) {
    for (PointId p = 0; p < points.size(); ++p)
      if (const PointSource& s = points.source(p); s.kind == PointSource::Kind::sum) point_[s.a] = p;
  }
  PointId at(std::uint32_t vertex) {
    PointId& point = point_[vertex];
    if (point == kNoId) point = points_.add_other({PointSource::Kind::sum, vertex, 0, 0});
    return point;
  }

 private:
  PointTable& points_;
  std::vector<PointId> point_;
};

/// A far face by one of its triangles, seen from its front or from its back.
SheetFace sheet_face(const FarFaces& far, const SolidOperand& surface, std::uint32_t triangle, bool front,
                     std::vector<std::uint8_t>& seen, VertexPoints& points) {
  SheetFace result;
  result.face = surface.face[triangle];
  result.loops = outlines(far, triangle, seen);
  bool several = false;
  for (const std::vector<std::uint32_t>& loop : result.loops)
    for (const std::uint32_t h : loop) several = several || surface.face[h / 3] != result.face;
  for (std::vector<std::uint32_t>& loop : result.loops) {
    std::vector<std::uint32_t> faces;
    for (std::uint32_t& h : loop) {
      if (several) faces.push_back(surface.face[h / 3]);
      h = points.at(surface.triangles[h / 3][h % 3]);
    }
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const PointId from = loop[k], to = loop[k + 1 < loop.size() ? k + 1 : 0];
      result.sides.push_back({front ? from : to, front ? to : from, faces[k]});
    }
    if (!front) std::reverse(loop.begin(), loop.end());
  }
  return result;
}

/// The faces of sheets that bound what is inside.
std::vector<SheetFace> sheet_faces(const FarFaces& far, const SolidOperand& surface, SolidBoundary& boundary) {
  std::vector<SheetFace> found;
  if (far.rims.empty()) return found;
  SolidArrangement& arrangement = *boundary.arrangement;
  const std::size_t first_group = arrangement.groups.size() - far.rims.size();
  VertexPoints points(arrangement.points, surface.vertices.size());
  std::vector<std::uint8_t> seen(far.sheet.size(), 0);
  for (std::uint32_t t = 0; t < far.sheet.size(); ++t) {
    if (far.sheet[t] == kNoId || seen[t] != 0) continue;
    const PlaneGroup& group = arrangement.groups[first_group + far.sheet[t]];
    if (!boundary.boundary[group.first_cell]) continue;
    found.push_back(sheet_face(far, surface, t, group.cells.cells[0].front > 0, seen, points));
    found.back().cell = group.first_cell;
  }
  return found;
}

/// The cells that bound what is inside, and the faces of sheets that do.
SolidBoundary boundary_inside(const Surface& surface, const SolidOperand& point, InsideRule rule,
                              const SpatialOptions& options, std::vector<SheetFace>& far, SpatialStats& stats,
                              StageWatch& watch) {
  SolidBoundary result;
  result.either_side = true;
  watch.begin("surface");
  result.space = space_of(surface.operand, point);
  const FarFaces faces = arrange_surface(surface, options.engine == SpatialEngine::brute, result, stats, watch);
  if (const auto edge = open_edge(*result.arrangement))
    throw OpenAt{midpoint(*result.space, *result.arrangement, *edge)};
  watch.begin("winding numbers");
  const CellWindings windings = cell_windings(*result.space, *result.arrangement, surface.operand.triangles, watch);
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
  far = sheet_faces(faces, surface.operand, result);
  watch.begin("");
  stats.bits = result.space->bits();
  stats.face_vertex = surface.operand.triangles.size();
  stats.points = result.arrangement->points.size(), stats.cells = result.arrangement->cell_count;
  stats.patches = links.patches;
  stats.collision_tests = windings.components;
  stats.held_bytes = watch.held();
  stats.double_pair_signs = result.space->signs().at(exact::Rung::double_pairs);
  stats.exact_signs = result.space->signs().exact();
  return result;
}

/// What is closed with what is tight, and by which operation.
struct ClosedResult {
  SetOperation operation;
  const ClosedOperands& operands;
};

/// Finds what is tight in a result whose regular part is there, and puts it together with it.
SpatialSum with_tight(const ClosedResult& closed, SolidBoundary& boundary, const SolidOperand& point,
                      const std::vector<SheetFace>& far, SpatialSum regular, StageWatch& watch) {
  const auto assembled = [&] {
    SpatialSum sum;
    assemble(boundary, closed.operands.surface.operand, point, sum, watch, far);
    return sum;
  };
  watch.begin("tight features");
  boundary.tight = tight_of(closed.operation, closed.operands, boundary, regular, watch);
  TightFeatures& tight = boundary.tight;
  SpatialSum sum = std::move(regular);
  if (!tight.cells.empty() || !tight.segments.empty() || !tight.points.empty()) sum = assembled();
  if (!tight.cells.empty() && !tight.points.empty()) {  // facets may touch the inside of a tight face at a point
    const ExactLocator locator(sum);
    const auto held = [&](PointId p) {
      ExactPosition at;
      for (int axis = 0; axis < 3; ++axis)
        at[axis] = boundary.space->world_coordinate(boundary.arrangement->points.source(p), axis);
      return locator.on_tight_face(at);
    };
    if (std::erase_if(tight.points, held) > 0) sum = assembled();
  }
  if (!has_thin_lines(closed.operands)) return sum;
  const SpatialSum others = std::move(sum);
  tight.segments.clear(), tight.points.clear();
  sum = assembled();
  add_thin_lines(closed.operation, closed.operands, others, sum);
  return sum;
}

Result<SpatialSum> inside_of(const Surface& surface, InsideRule rule, const SpatialOptions& options,
                             const ClosedResult* closed = nullptr) {
  SpatialSum sum;
  if (surface.operand.triangles.empty()) {
    if (closed) add_thin_lines(closed->operation, closed->operands, SpatialSum(), sum);
    return sum;
  }
  const SolidOperand point = point_operand(surface.operand);
  try {
    StageWatch watch(options, sum.stats);
    std::vector<SheetFace> far;
    SolidBoundary boundary = boundary_inside(surface, point, rule, options, far, sum.stats, watch);
    watch.begin("faces");
    assemble(boundary, surface.operand, point, sum, watch, far);
    if (closed) {
      const SpatialStats stats = sum.stats;
      sum = with_tight(*closed, boundary, point, far, std::move(sum), watch);
      sum.stats = stats;
    }
    watch.begin("");
  } catch (const std::invalid_argument&) {
    if (std::optional<Error> error = grid_error(surface.operand.vertices, point.vertices)) return *std::move(error);
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
  return inside_of(surface_of(data), rule, options);
}

Result<SpatialSum> solid_inside(std::span<const DirectedSolid> solids, InsideRule rule, const SpatialOptions& options) {
  return inside_of(surface_of(solids), rule, options);
}

/// From units of a grid to those of the operands.
Result<SpatialSum> unscaled(Result<SpatialSum> inside, const CommonGrid& grid) {
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

Result<SpatialSum> solid_inside(const ExactSet& data, InsideRule rule, const SpatialOptions& options) {
  const ExactSet* const sets[]{&data};
  const CommonGrid grid = common_grid(sets);
  return unscaled(inside_of(surface_of(grid, data), rule, options), grid);
}

/// With what is tight: in the closed result and not in the open one.
Result<SpatialSum> closed_result(SetOperation operation, std::span<const OperandSet> sets, InsideRule rule,
                                 const SpatialOptions& options) {
  CommonGrid grid;
  const std::size_t first_taken = operation == SetOperation::difference ? 1 : sets.size();
  const ClosedOperands operands = closed_operands(sets, first_taken, grid);
  const ClosedResult closed{operation, operands};
  Result<SpatialSum> made = inside_of(operands.surface, rule, options, &closed);
  if (operands.surface.operand.exact.empty()) return made;
  return unscaled(std::move(made), grid);
}

}  // namespace dymsum::spatial

namespace dymsum {
namespace {

using spatial::InsideRule;

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

namespace {

using spatial::SetOperation;

/// The winding numbers that are inside of the result of so many sets, those that are taken away being inside out.
InsideRule rule_of(SetOperation operation, std::size_t sets) {
  switch (operation) {
    case SetOperation::intersection:
      return {static_cast<int>(sets), false, false};
    case SetOperation::symmetric_difference:
      return {1, true, true};
    default:
      return {};
  }
}

/// By winding numbers: of meshes where doubles hold all of them.
Result<SpatialSum> regular_result(SetOperation operation, std::span<const SpatialOperand> sets,
                                  const SpatialOptions& options) {
  const std::size_t first_taken = operation == SetOperation::difference ? 1 : sets.size();
  const InsideRule rule = rule_of(operation, sets.size());
  // Results as sets of their own; solids are taken as they are.
  std::vector<std::optional<spatial::OperandSet>> results(sets.size());
  std::vector<spatial::DirectedSolid> solids;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const Mesh* mesh = nullptr;
    if (spatial::result_of(sets[k]) == nullptr) mesh = *std::get_if<const Mesh*>(&sets[k].set());
    else if (results[k].emplace(sets[k], Semantics::regular).mesh()) mesh = &*results[k]->mesh();
    if (mesh != nullptr) solids.push_back({mesh, k >= first_taken});
  }
  if (solids.size() == sets.size()) return spatial::solid_inside(solids, rule, options);
  spatial::ExactSet triangles;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    if (!results[k]) results[k].emplace(sets[k], Semantics::regular);
    spatial::append(triangles, spatial::regular_triangles(*results[k]), k >= first_taken);
  }
  return spatial::solid_inside(triangles, rule, options);
}

Result<SpatialSum> result_of_sets(SetOperation operation, std::span<const SpatialOperand> sets,
                                  const SpatialOptions& options) {
  if (options.semantics == Semantics::regular || !options.tight) return regular_result(operation, sets, options);
  std::vector<spatial::OperandSet> closed;
  for (const SpatialOperand& set : sets) closed.emplace_back(set, Semantics::closed);
  return spatial::closed_result(operation, closed, rule_of(operation, sets.size()), options);
}

std::vector<SpatialOperand> operands_of(std::span<const Mesh> solids) { return {solids.begin(), solids.end()}; }

}  // namespace

Result<SpatialSum> united(std::span<const SpatialOperand> sets, const SpatialOptions& options) {
  return result_of_sets(SetOperation::united, sets, options);
}

Result<SpatialSum> intersection(std::span<const SpatialOperand> sets, const SpatialOptions& options) {
  if (sets.empty()) return Error{ErrorCode::out_of_range, "an intersection takes at least one solid, not 0", {}};
  return result_of_sets(SetOperation::intersection, sets, options);
}

Result<SpatialSum> difference(const SpatialOperand& a, std::span<const SpatialOperand> taken,
                              const SpatialOptions& options) {
  std::vector<SpatialOperand> all{a};
  all.insert(all.end(), taken.begin(), taken.end());
  return result_of_sets(SetOperation::difference, all, options);
}

Result<SpatialSum> intersection(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options) {
  const SpatialOperand both[]{a, b};
  return result_of_sets(SetOperation::intersection, both, options);
}

Result<SpatialSum> difference(const SpatialOperand& a, const SpatialOperand& b, const SpatialOptions& options) {
  const SpatialOperand both[]{a, b};
  return result_of_sets(SetOperation::difference, both, options);
}

Result<SpatialSum> symmetric_difference(const SpatialOperand& a, const SpatialOperand& b,
                                        const SpatialOptions& options) {
  const SpatialOperand both[]{a, b};
  return result_of_sets(SetOperation::symmetric_difference, both, options);
}

Result<SpatialSum> united(std::span<const Mesh> solids, const SpatialOptions& options) {
  return united(std::span<const SpatialOperand>(operands_of(solids)), options);
}

Result<SpatialSum> intersection(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  return intersection(SpatialOperand(a), SpatialOperand(b), options);
}

Result<SpatialSum> intersection(std::span<const Mesh> solids, const SpatialOptions& options) {
  return intersection(std::span<const SpatialOperand>(operands_of(solids)), options);
}

Result<SpatialSum> difference(const Mesh& a, std::span<const Mesh> taken, const SpatialOptions& options) {
  return difference(SpatialOperand(a), std::span<const SpatialOperand>(operands_of(taken)), options);
}

Result<SpatialSum> difference(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  return difference(SpatialOperand(a), SpatialOperand(b), options);
}

Result<SpatialSum> symmetric_difference(const Mesh& a, const Mesh& b, const SpatialOptions& options) {
  return symmetric_difference(SpatialOperand(a), SpatialOperand(b), options);
}

}  // namespace dymsum
