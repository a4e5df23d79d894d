#include "spatial/boolean/closed_sets.h"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "spatial/mesh/vec3.h"
#include "spatial/sum/exact_locator.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/thin_sums.h"

namespace dymsum::spatial {

using exact::BigRational;

bool holds(SetOperation operation, std::span<const Side> sides, bool open) {
  const auto in = [&](Side side) { return open ? side == Side::inside : side != Side::outside; };
  const auto taken = [&](Side side) { return open ? side != Side::outside : side == Side::inside; };
  switch (operation) {
    case SetOperation::united:
      return std::any_of(sides.begin(), sides.end(), in);
    case SetOperation::intersection:
      return std::all_of(sides.begin(), sides.end(), in);
    case SetOperation::difference:
      return in(sides[0]) && std::none_of(sides.begin() + 1, sides.end(), taken);
    case SetOperation::symmetric_difference:
      return (in(sides[0]) && !taken(sides[1])) || (in(sides[1]) && !taken(sides[0]));
  }
  return false;
}

namespace {

/// Sets put together, one after the other.
class Operands {
 public:
  void add(const OperandSet& set, bool inside_out) {
    const ExactSet exact = set.set();
    const auto vertex = static_cast<std::uint32_t>(all_.at.size());
    all_.at.insert(all_.at.end(), exact.at.begin(), exact.at.end());
    all_.set.vertices.insert(all_.set.vertices.end(), exact.set.vertices.begin(), exact.set.vertices.end());
    Part& part = parts_.emplace_back();
    const auto add_triangle = [&](const Face& triangle, std::uint32_t face, bool thin) {
      Triangle t{triangle[0] + vertex, triangle[1] + vertex, triangle[2] + vertex};
      if (inside_out) std::swap(t[1], t[2]);
      (thin ? part.thin : part.regular).push_back({t, face});
    };
    const auto add_line = [&](const Face& line) {
      if (line.size() == 1) part.points.push_back(line[0] + vertex);
      else part.segments.push_back({line[0] + vertex, line[1] + vertex});
    };
    if (set.mesh()) {
      const Mesh& mesh = *set.mesh();
      const TriangulatedMesh triangles = triangulated(mesh);
      for (std::size_t t = 0; t < triangles.face.size(); ++t) {
        const Face& face = triangles.mesh.faces()[t];
        const std::uint32_t name = triangles.face[t];
        if (face.size() < 3) add_line(face);
        else add_triangle(face, faces_ + name, mesh.has_thin_parts() && mesh.thin_faces()[name]);
      }
      faces_ += static_cast<std::uint32_t>(mesh.faces().size());
    } else {
      for (std::uint32_t f = 0; f < exact.set.faces.size(); ++f) {
        const Face& face = exact.set.faces[f];
        if (face.size() < 3) add_line(face);
        else add_triangle(face, faces_ + f, !exact.thin.empty() && exact.thin[f]);
      }
      faces_ += static_cast<std::uint32_t>(exact.set.faces.size());
    }
  }

  ClosedOperands finish(bool of_solids, CommonGrid& grid) {
    ClosedOperands result;
    SolidOperand& operand = result.surface.operand;
    const bool doubles = in_doubles(all_);
    if (!doubles) {
      const ExactSet* const sets[]{&all_};
      grid = common_grid(sets);
      operand.exact = vertices_on(grid, all_), operand.exponent = grid.unit();
      result.scale = BigRational(grid.scale, exact::BigInteger(1) << grid.shift());
    }
    operand.vertices = all_.set.vertices;
    const std::vector<std::uint32_t> first = doubles ? first_at_position(operand.vertices) : first_at_exact_position();
    const auto named = [&](const Triangle& t) { return Triangle{first[t[0]], first[t[1]], first[t[2]]}; };
    const auto put = [&](const Triangle& t, std::uint32_t face) {
      operand.triangles.push_back(t), operand.face.push_back(face);
    };
    const auto count = [&] { return static_cast<std::uint32_t>(operand.triangles.size()); };
    bool thin = false;
    for (const Part& part : parts_) {
      ClosedOperands::Set& set = result.sets.emplace_back();
      set.first = count();
      if (of_solids) result.surface.first_triangle.push_back(set.first);
      for (const auto& [t, face] : part.regular) put(named(t), face);
      set.last = count();
      thin = thin || !part.thin.empty();
    }
    if (of_solids) result.surface.first_triangle.push_back(count());
    if (thin) result.surface.first_triangle.clear();
    operand.first_plate = count();
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      ClosedOperands::Set& set = result.sets[k];
      set.first_thin = count();
      for (const auto& [triangle, face] : parts_[k].thin) {
        const Triangle t = named(triangle);
        put(t, face), put({t[0], t[2], t[1]}, face);
      }
      set.last_thin = count();
      for (const auto& [from, to] : parts_[k].segments) {
        set.segments.push_back({scaled(from, result.scale), scaled(to, result.scale)});
        set.segment_names.push_back({SolidFeature::Kind::edge, std::min(from, to), std::max(from, to)});
      }
      for (const std::uint32_t v : parts_[k].points) {
        set.points.push_back(scaled(v, result.scale));
        set.point_names.push_back({SolidFeature::Kind::vertex, v, 0});
      }
    }
    move_unused(operand);
    result.at = std::move(all_.at);
    return result;
  }

 private:
  struct Part {
    std::vector<std::pair<Triangle, std::uint32_t>> regular, thin;
    std::vector<std::array<std::uint32_t, 2>> segments;
    std::vector<std::uint32_t> points;
  };

  ExactPosition scaled(std::uint32_t vertex, const BigRational& scale) const {
    ExactPosition at = all_.at[vertex];
    for (BigRational& c : at) c *= scale;
    return at;
  }
  std::vector<std::uint32_t> first_at_exact_position() const {
    std::vector<std::uint32_t> order(all_.at.size()), first(order.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const int s = lexicographic_order(all_.at[a], all_.at[b]);
      return s != 0 ? s < 0 : a < b;
    });
    for (std::size_t k = 0; k < order.size(); ++k)
      first[order[k]] = k > 0 && all_.at[order[k]] == all_.at[order[k - 1]] ? first[order[k - 1]] : order[k];
    return first;
  }
  /// Vertices that no triangle has lie where another one does, so that they need no digits of their own.
  static void move_unused(SolidOperand& operand) {
    std::vector<bool> used(operand.vertices.size());
    for (const Triangle& t : operand.triangles)
      for (const std::uint32_t v : t) used[v] = true;
    const auto some = static_cast<std::size_t>(std::find(used.begin(), used.end(), true) - used.begin());
    for (std::size_t v = 0; v < used.size() && some < used.size(); ++v) {
      if (used[v]) continue;
      operand.vertices[v] = operand.vertices[some];
      if (!operand.exact.empty()) operand.exact[v] = operand.exact[some];
    }
  }

  ExactSet all_;
  std::vector<Part> parts_;
  std::uint32_t faces_ = 0;
};

}  // namespace

ClosedOperands closed_operands(std::span<const OperandSet> sets, std::size_t first_taken, CommonGrid& grid) {
  Operands operands;
  bool of_solids = true;  // in which triangles have vertices and edges alone in common
  for (std::size_t k = 0; k < sets.size(); ++k) {
    operands.add(sets[k], k >= first_taken);
    of_solids = of_solids && sets[k].mesh() && !sets[k].has_thin();
  }
  return operands.finish(of_solids, grid);
}

namespace {

/// How positions lie to the sets, by rationals.
class Sides {
 public:
  explicit Sides(const ClosedOperands& operands) : sets_(operands.sets) {
    std::vector<ExactPosition> at = operands.at;
    for (ExactPosition& x : at)
      for (BigRational& c : x) c *= operands.scale;
    for (const ClosedOperands::Set& set : operands.sets) {
      std::vector<ExactTriangle> triangles;
      const auto add = [&](std::uint32_t t) {
        const Triangle& v = operands.surface.operand.triangles[t];
        triangles.push_back({at[v[0]], at[v[1]], at[v[2]]});
      };
      for (std::uint32_t t = set.first; t < set.last; ++t) add(t);
      const std::size_t first_tight = triangles.size();
      for (std::uint32_t t = set.first_thin; t < set.last_thin; t += 2) add(t);
      locators_.emplace_back(std::move(triangles), first_tight);
    }
  }

  /// Of a position, as if the sets had no thin segments and points.
  void of(const ExactPosition& x, std::vector<Side>& sides) const {
    sides.clear();
    for (const ExactLocator& locator : locators_) {
      const ExactLocator::Where where = locator.of(x);
      sides.push_back(where == ExactLocator::Where::inside                                 ? Side::inside
                      : where == ExactLocator::Where::boundary || locator.on_tight_face(x) ? Side::boundary
                                                                                           : Side::outside);
    }
  }
  /// Of a position, with them.
  void with_lines(const ExactPosition& x, std::vector<Side>& sides) const {
    of(x, sides);
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      if (sides[k] != Side::outside) continue;
      const auto on = [&](const auto& s) { return lies_on_segment(s[0], s[1], x); };
      if (std::any_of(sets_[k].segments.begin(), sets_[k].segments.end(), on) ||
          std::find(sets_[k].points.begin(), sets_[k].points.end(), x) != sets_[k].points.end())
        sides[k] = Side::boundary;
    }
  }
  const std::vector<ExactLocator>& locators() const { return locators_; }

 private:
  const std::vector<ClosedOperands::Set>& sets_;
  std::vector<ExactLocator> locators_;
};

/// Whether some position, with sides of the sets, is in the closed result and not in the open one.
bool is_between(SetOperation operation, const std::vector<Side>& sides) {
  return holds(operation, sides, false) && !holds(operation, sides, true);
}

/// No set alone: of facets, of several or thin ones.
constexpr std::uint32_t kMixed = 0xfffffffe;

class TightParts {
 public:
  TightParts(SetOperation operation, const ClosedOperands& operands, const SolidBoundary& boundary,
             const SpatialSum& regular, StageWatch& watch)
      : operation_(operation),
        operands_(operands),
        space_(*boundary.space),
        arrangement_(*boundary.arrangement),
        table_(boundary.table),
        boundary_(boundary.boundary),
        regular_(regular),
        watch_(watch) {}

  TightFeatures run() {
    find_owners();
    TightFeatures result;
    is_tight_.assign(arrangement_.cell_count, 0);
    in_mixed_groups([&](const PlaneGroup& group, std::uint32_t c) {
      if (boundary_[group.first_cell + c]) return;
      is_tight_[group.first_cell + c] = is_tight(inside_cell(group, group.cells.cells[c]));
    });
    for (std::uint32_t c = 0; c < arrangement_.cell_count; ++c)
      if (is_tight_[c]) result.cells.push_back(c);
    find_edges(result);
    find_points(result);
    return result;
  }

 private:
  /// The set that all facets in a group are of.
  void find_owners() {
    const std::vector<ClosedOperands::Set>& sets = operands_.sets;
    std::vector<std::uint32_t> owner(operands_.surface.operand.triangles.size(), kMixed);
    for (std::uint32_t k = 0; k < sets.size(); ++k)
      std::fill(owner.begin() + sets[k].first, owner.begin() + sets[k].last, k);
    for (const PlaneGroup& group : arrangement_.groups) {
      std::uint32_t all = kNoId;
      for (const std::uint32_t f : group.facets) all = both(all, owner[table_.facets[f].facet.p]);
      owner_.push_back(all);
    }
  }
  static std::uint32_t both(std::uint32_t a, std::uint32_t b) { return a == kNoId || a == b ? b : kMixed; }

  /// Made when the first position is looked up: mostly none is.
  struct Lookup {
    Sides sides;
    ExactLocator regular;
  };
  bool is_tight(const ExactPosition& x) const {
    std::call_once(once_, [&] { lookup_.emplace(Lookup{Sides(operands_), ExactLocator(regular_)}); });
    std::vector<Side> sides;
    lookup_->sides.of(x, sides);
    return is_between(operation_, sides) && lookup_->regular.of(x) != ExactLocator::Where::boundary;
  }

  template <class F>
  void in_mixed_groups(F f) {
    std::vector<std::array<std::uint32_t, 2>> cells;
    for (std::uint32_t g = 0; g < owner_.size(); ++g)
      for (std::uint32_t c = 0; owner_[g] == kMixed && c < arrangement_.groups[g].cells.cells.size(); ++c)
        cells.push_back({g, c});
    watch_.run_intervals(cells.size(), 16, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) f(arrangement_.groups[cells[k][0]], cells[k][1]);
    });
  }

  ExactPosition position(PointId point) const {
    ExactPosition at;
    for (int axis = 0; axis < 3; ++axis) at[axis] = space_.world_coordinate(arrangement_.points.source(point), axis);
    return at;
  }

  /// A position in an open cell: between the first two places at which a line through it, along one axis, meets its
  /// edges, at a height at which no vertex lies.
  ExactPosition inside_cell(const PlaneGroup& group, const Cell& cell) const {
    int up = 0;
    while (space_.exact_normal(group.plane, up) == 0) ++up;
    const int i = (up + 1) % 3, j = (up + 2) % 3;
    std::vector<std::array<ExactPosition, 2>> edges;
    std::vector<BigRational> heights;
    for (std::uint32_t l = cell.first_loop; l < cell.last_loop; ++l)
      for (std::uint32_t k = group.cells.loops[l]; k < group.cells.loops[l + 1]; ++k) {
        const CellEdge& e = group.cells.edges[group.cells.half_edges[k] / 2];
        edges.push_back({position(arrangement_.point(group, e.a)), position(arrangement_.point(group, e.b))});
        for (const ExactPosition& end : edges.back()) heights.push_back(end[j]);
      }
    std::sort(heights.begin(), heights.end());
    const auto second = std::upper_bound(heights.begin(), heights.end(), heights.front());
    const BigRational height = (heights.front() + *second) / 2;
    std::vector<std::pair<BigRational, ExactPosition>> crossings;
    for (const auto& [a, b] : edges) {
      if ((a[j] < height) == (b[j] < height)) continue;
      ExactPosition at = position_between(a, b, (height - a[j]) / (b[j] - a[j]));
      crossings.emplace_back(at[i], at);
    }
    std::sort(crossings.begin(), crossings.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    // An edge with the cell on both sides is there twice.
    std::size_t k = 0;
    while (crossings[k].first == crossings[k + 1].first) k += 2;
    return position_between(crossings[k].second, crossings[k + 1].second, BigRational(1, 2));
  }

  void find_edges(TightFeatures& result) {
    const std::size_t count = arrangement_.edge_ends.size();
    std::vector<std::uint8_t> tight(count);
    watch_.run_intervals(count, 512, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e) tight[e] = is_tight_edge(static_cast<std::uint32_t>(e));
    });
    for (std::uint32_t e = 0; e < count; ++e)
      if (tight[e]) result.segments.push_back(arrangement_.edge_ends[e]);
  }
  /// What such a cell ends in is tight with it, or on the boundary of the regular result.
  bool is_settled(std::uint32_t cell) const { return is_tight_[cell] != 0 || boundary_[cell]; }
  bool is_tight_edge(std::uint32_t edge) const {
    std::uint32_t owner = kNoId;
    for (const EdgeUse use : arrangement_.uses(edge)) {
      const PlaneGroup& group = arrangement_.groups[use.group];
      if (owner_[use.group] != kNoId) owner = both(owner, owner_[use.group]);
      const CellEdge& e = group.cells.edges[use.edge];
      for (const std::uint32_t c : {e.left, e.right})
        if (c != kNoId && is_settled(group.first_cell + c)) return false;
    }
    if (owner != kMixed) return false;
    const auto [a, b] = arrangement_.edge_ends[edge];
    return is_tight(position_between(position(a), position(b), BigRational(1, 2)));
  }

  void find_points(TightFeatures& result) {
    const std::size_t count = arrangement_.points.size();
    std::vector<std::uint32_t> owner(count, kNoId);
    std::vector<std::uint8_t> held(count);  // by a cell of the boundary, a tight cell or a tight segment
    for (std::uint32_t g = 0; g < arrangement_.groups.size(); ++g) {
      const PlaneGroup& group = arrangement_.groups[g];
      if (owner_[g] == kNoId) continue;  // a sheet
      const auto add = [&](PointId at) { owner[at] = both(owner[at], owner_[g]); };
      for (const CellEdge& e : group.cells.edges)
        for (const PointId id : {e.a, e.b}) {
          const PointId at = arrangement_.point(group, id);
          add(at);
          for (const std::uint32_t c : {e.left, e.right})
            if (c != kNoId && is_settled(group.first_cell + c)) held[at] = 1;
        }
      for (const PlaneCells::Touch& touch : group.cells.touches) add(arrangement_.point(group, touch.at));
    }
    for (const auto& segment : result.segments)
      for (const PointId at : segment) held[at] = 1;
    std::vector<std::uint8_t> tight(count);
    watch_.run_intervals(count, 256, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t p = first; p < last; ++p)
        tight[p] = owner[p] == kMixed && !held[p] && is_tight(position(static_cast<PointId>(p)));
    });
    for (std::uint32_t p = 0; p < count; ++p)
      if (tight[p]) result.points.push_back(p);
  }

  SetOperation operation_;
  const ClosedOperands& operands_;
  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const FacetTable& table_;
  const std::vector<bool>& boundary_;  // per cell: of the regular result
  const SpatialSum& regular_;
  mutable std::once_flag once_;
  mutable std::optional<Lookup> lookup_;
  StageWatch& watch_;
  std::vector<std::uint32_t> owner_;    // per group
  std::vector<std::uint8_t> is_tight_;  // per cell
};

}  // namespace

TightFeatures tight_of(SetOperation operation, const ClosedOperands& operands, const SolidBoundary& boundary,
                       const SpatialSum& regular, StageWatch& watch) {
  return TightParts(operation, operands, boundary, regular, watch).run();
}

namespace {

/// A segment or, where both ends are one, a point.
using Line = std::array<ExactPosition, 2>;

/// Where a segment meets another one, or a point: parameters on it.
void add_meetings(const Line& s, const Line& other, std::vector<BigRational>& cuts) {
  const auto add = [&](const ExactPosition& x) {
    if (!lies_on_segment(s[0], s[1], x)) return;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (s[0][axis] != s[1][axis]) {
        cuts.push_back((x[axis] - s[0][axis]) / (s[1][axis] - s[0][axis]));
        return;
      }
  };
  add(other[0]), add(other[1]);
  if (other[0] == other[1]) return;
  // s0 + t u = o + w v: two of the three equations with a determinant give t, and the third whether they meet.
  std::array<BigRational, 3> u, v, d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    u[axis] = s[1][axis] - s[0][axis], v[axis] = other[1][axis] - other[0][axis];
    d[axis] = other[0][axis] - s[0][axis];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const BigRational det = u[i] * v[j] - u[j] * v[i];
    if (det == 0) continue;
    const BigRational t = (d[i] * v[j] - d[j] * v[i]) / det;
    if (t < 0 || t > 1) return;
    const ExactPosition x = position_between(s[0], s[1], t);
    if (lies_on_segment(other[0], other[1], x)) cuts.push_back(t);
    return;
  }
}

std::vector<ThinSum> thin_lines(const ClosedOperands& operands) {
  std::vector<ThinSum> lines;
  const SolidFeature origin{SolidFeature::Kind::vertex, 0, 0};
  for (const ClosedOperands::Set& set : operands.sets) {
    for (std::size_t k = 0; k < set.segments.size(); ++k)
      lines.push_back({set.segments[k][0], set.segments[k][1], {set.segment_names[k], origin}});
    for (std::size_t k = 0; k < set.points.size(); ++k)
      lines.push_back({set.points[k], set.points[k], {set.point_names[k], origin}});
  }
  for (ThinSum& line : lines)
    if (lexicographic_order(line.to, line.from) < 0) std::swap(line.from, line.to);
  return lines;
}

/// Parameters on a segment, both ends with them, between which the sides of all sets are what they are.
std::vector<BigRational> cuts_of(const ThinSum& line, const Sides& sides, const ExactLocator& result,
                                 const std::vector<ThinSum>& lines) {
  std::vector<BigRational> cuts{0, 1};
  const auto add = [&](std::vector<BigRational> some) {
    std::move(some.begin(), some.end(), std::back_inserter(cuts));
  };
  for (const ExactLocator& locator : sides.locators()) add(locator.cuts(line.from, line.to));
  add(result.cuts(line.from, line.to));
  for (const ThinSum& other : lines) add_meetings({line.from, line.to}, {other.from, other.to}, cuts);
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

/// The tight segments and points that a sum has, as pieces with what touches on them.
void add_found(const SpatialSum& sum, std::vector<ThinSum>& sources, std::vector<Line>& segments,
               std::vector<ExactPosition>& points) {
  if (sum.tight_segments.empty() && sum.tight_points.empty()) return;
  const SpatialPositions& positions = SpatialSumInternals::positions(sum);
  for (std::size_t k = 0; k < sum.tight_segments.size(); ++k) {
    const auto [from, to] = sum.tight_segments[k];  // in the order of positions
    segments.push_back({positions.at(from), positions.at(to)});
    for (const SolidContact& contact : sum.tight_segment_contacts[k])
      sources.push_back({segments.back()[0], segments.back()[1], contact});
  }
  for (std::size_t k = 0; k < sum.tight_points.size(); ++k) {
    points.push_back(positions.at(sum.tight_points[k]));
    for (const SolidContact& contact : sum.tight_point_contacts[k])
      sources.push_back({points.back(), points.back(), contact});
  }
}

}  // namespace

void add_thin_lines(SetOperation operation, const ClosedOperands& operands, const SpatialSum& others, SpatialSum& sum) {
  const std::vector<ThinSum> lines = thin_lines(operands);
  const Sides sides(operands);
  const ExactLocator result(sum);
  std::vector<Side> of;
  const auto is_left = [&](const ExactPosition& x) {
    sides.with_lines(x, of);
    return is_between(operation, of) && result.of(x) != ExactLocator::Where::boundary && !result.on_tight_face(x);
  };
  std::vector<Line> segments;
  std::vector<ExactPosition> points;
  for (const ThinSum& line : lines) {
    if (line.from == line.to) {
      if (is_left(line.from)) points.push_back(line.from);
      continue;
    }
    const std::vector<BigRational> cuts = cuts_of(line, sides, result, lines);
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const ExactPosition at = position_between(line.from, line.to, cuts[k]);
      if (is_left(at)) points.push_back(at);
      if (k + 1 == cuts.size()) break;
      if (is_left(position_between(line.from, line.to, (cuts[k] + cuts[k + 1]) / 2)))
        segments.push_back({at, position_between(line.from, line.to, cuts[k + 1])});
    }
  }
  std::vector<ThinSum> sources = lines;
  add_found(others, sources, segments, points);
  add_tight_lines(sum, std::move(sources), std::move(segments), std::move(points));
}

}  // namespace dymsum::spatial
