#include "spatial/boundary/tight_features.h"

#include <algorithm>
#include <span>
#include <tuple>

#include "spatial/boundary/lone_contacts.h"

namespace dymsum::spatial {

namespace {

/// An edge of a plane's cells, or a point of them.
struct Trace {
  PointId a, b;  ///< a <= b; equal for a point
  PlaneId plane, cut;
  std::int8_t way;  ///< 1 where the way from a to b is n x n_cut
  bool full;        ///< all around it in the plane lie facets of one direction, none of the other
  /// What facets of the plane end there: none; one facet, along the edge of sums `border`; those with a corner at the
  /// sum that the point is; or something else.
  enum class End : std::uint8_t { none, border, corner, other } end = End::other;
  EdgeId border = kNoId;
  std::uint32_t group = 0;
};

class Tight {
 public:
  Tight(const SumSpace& space, const SolidArrangement& arrangement, const std::vector<bool>& boundary,
        const Collision& collision, LoneContacts lone)
      : space_(space),
        arrangement_(arrangement),
        boundary_(boundary),
        collision_(collision),
        lone_(std::move(lone)),
        touched_(arrangement.points.size()) {}

  TightFeatures run() {
    for (const PlaneGroup& group : arrangement_.groups) look_at_cells(group);
    std::sort(closed_.begin(), closed_.end());
    for (std::uint32_t g = 0; g < arrangement_.groups.size(); ++g) collect_edges(g);
    sort(edges_);
    for_each_place(edges_, [&](std::span<const Trace> traces) { look_at_edge(traces); });
    for (const PlaneGroup& group : arrangement_.groups) look_at_touches(group);
    std::sort(dots_.begin(), dots_.end());
    for (std::uint32_t g = 0; g < arrangement_.groups.size(); ++g) collect_points(g);
    sort(points_);
    for_each_place(points_, [&](std::span<const Trace> traces) { look_at_point(traces); });
    return std::move(result_);
  }

 private:
  static void sort(std::vector<Trace>& traces) {
    std::sort(traces.begin(), traces.end(), [](const Trace& x, const Trace& y) {
      return std::tie(x.a, x.b, x.plane, x.cut) < std::tie(y.a, y.b, y.plane, y.cut);
    });
  }
  template <class F>
  static void for_each_place(const std::vector<Trace>& traces, F f) {
    for (std::size_t first = 0, last = 0; first < traces.size(); first = last) {
      while (last < traces.size() && traces[last].a == traces[first].a && traces[last].b == traces[first].b) ++last;
      f(std::span<const Trace>(&traces[first], last - first));
    }
  }

  void touch(const PlaneGroup& group, std::uint32_t half_edge) {
    const CellEdge& e = group.cells.edges[half_edge / 2];
    touched_[arrangement_.point(group, e.a)] = touched_[arrangement_.point(group, e.b)] = true;
    closed_.push_back(edge_key(arrangement_.point(group, e.a), arrangement_.point(group, e.b)));
  }
  static std::uint64_t edge_key(PointId a, PointId b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
  }

  /// Cells with facets of both directions; and what the closures of boundary and tight cells touch.
  void look_at_cells(const PlaneGroup& group) {
    for (std::uint32_t c = 0; c < group.cells.cells.size(); ++c) {
      const Cell& cell = group.cells.cells[c];
      const std::uint32_t begin = group.cells.loops[cell.first_loop], end = group.cells.loops[cell.last_loop];
      bool outside = boundary_[group.first_cell + c];
      if (cell.front > 0 && cell.back > 0) {
        const std::uint32_t h = group.cells.half_edges[begin];
        const CellEdge& e = group.cells.edges[h / 2];
        const PointId at = arrangement_.point(group, h & 1 ? e.b : e.a);
        const auto way = static_cast<std::int8_t>((e.along ? 1 : -1) * (h & 1 ? -1 : 1));
        outside = !overlaps({arrangement_.points.source(at), group.plane, e.cut, way, 1, 0});
        if (outside) result_.cells.push_back(group.first_cell + c);
      }
      if (!outside) continue;
      for (std::uint32_t k = begin; k < end; ++k) touch(group, group.cells.half_edges[k]);
    }
  }

  bool overlaps(const Flag& flag) {
    ++result_.tests;
    return collision_.overlaps(flag);
  }

  /// 1 or -1 for facets of one direction, else 0.
  static int facing(const PlaneGroup& group, std::uint32_t c) {
    if (c == kNoId) return 0;
    const Cell& cell = group.cells.cells[c];
    return cell.front > 0 ? cell.back > 0 ? 0 : 1 : -1;
  }
  static bool is_full(const PlaneGroup& group, const CellEdge& e) {
    const int left = facing(group, e.left);
    return left != 0 && left == facing(group, e.right);
  }
  static bool single(const PlaneGroup& group, std::uint32_t c) {
    return c == kNoId || group.cells.cells[c].front + group.cells.cells[c].back == 1;
  }
  /// One facet on one side, nothing on the other.
  static bool one_sided(const PlaneGroup& group, const CellEdge& e) {
    return (e.left == kNoId) != (e.right == kNoId) && single(group, e.left) && single(group, e.right);
  }
  static bool one_border(const CellEdge& e) { return e.border != kNoId && e.border != kManyEdges; }

  /// Of places that nothing outside is known to touch.
  void collect_edges(std::uint32_t g) {
    const PlaneGroup& group = arrangement_.groups[g];
    for (const CellEdge& e : group.cells.edges) {
      const PointId a = arrangement_.point(group, e.a), b = arrangement_.point(group, e.b);
      if (std::binary_search(closed_.begin(), closed_.end(), edge_key(a, b))) continue;
      const auto way = static_cast<std::int8_t>((e.along ? 1 : -1) * (a < b ? 1 : -1));
      Trace trace{std::min(a, b), std::max(a, b), group.plane, e.cut, way, is_full(group, e), Trace::End::other,
                  e.border, g};
      if (one_border(e) && one_sided(group, e)) trace.end = Trace::End::border;
      edges_.push_back(trace);
    }
  }
  void collect_points(std::uint32_t g) {
    const PlaneGroup& group = arrangement_.groups[g];
    ends_.clear();
    for (std::uint32_t e = 0; e < group.cells.edges.size(); ++e)
      for (const PointId p : {group.cells.edges[e].a, group.cells.edges[e].b})
        if (const PointId at = arrangement_.point(group, p); !touched_[at]) ends_.push_back({at, e});
    std::sort(ends_.begin(), ends_.end());
    for (std::size_t first = 0, last = 0; first < ends_.size(); first = last) {
      while (last < ends_.size() && ends_[last][0] == ends_[first][0]) ++last;
      points_.push_back(point_trace(g, {&ends_[first], last - first}));
    }
  }
  Trace point_trace(std::uint32_t g, std::span<const std::array<std::uint32_t, 2>> ends) const {
    const PlaneGroup& group = arrangement_.groups[g];
    const PointId at = ends[0][0];
    const PointSource& source = arrangement_.points.source(at);
    const SumPoint sum{source.a, source.b};
    Trace trace{at, at, group.plane, 0, 0, true, Trace::End::other, kNoId, g};
    bool alone = true, through = true, corner = source.kind == PointSource::Kind::sum;
    int borders = 0;
    for (const auto& [p, edge] : ends) {
      const CellEdge& e = group.cells.edges[edge];
      trace.full = trace.full && is_full(group, e);
      alone = alone && single(group, e.left) && single(group, e.right);
      if (e.border == kNoId) continue;
      if (borders++ == 0) trace.border = e.border;
      through = through && e.border == trace.border && one_border(e) && one_sided(group, e);
      corner = corner && one_border(e) &&
               (space_.edges()[e.border].from == sum || space_.edges()[e.border].to == sum);
    }
    if (borders == 0) trace.end = trace.full ? Trace::End::none : Trace::End::other;
    else if (alone && through && borders == 2) trace.end = Trace::End::border;
    else if (alone && corner) trace.end = Trace::End::corner;
    return trace;
  }

  /// Whether contacts there hold up motion in independent directions only: then what is free is free in a wedge, too.
  bool free_in_a_wedge(std::span<const Trace> traces) const {
    if (traces.size() > 3) return false;
    for (const Trace& t : traces)
      if (!t.full) return false;
    if (traces.size() < 3) return true;
    return space_.det(traces[0].plane, traces[1].plane, traces[2].plane) != 0;
  }

  /// Whether all facets there come from one contact, or one and another that holds up motion across it only: the
  /// solids can be moved apart then, into an open set of positions.
  bool free_by_itself(std::span<const Trace> traces) {
    const Trace* plane = nullptr;
    const Trace* border = nullptr;
    std::size_t corners = 0;
    for (const Trace& t : traces) {
      if (t.end == Trace::End::other) return false;
      if (t.end == Trace::End::corner) ++corners;
      if (t.end == Trace::End::none) {
        if (plane != nullptr) return false;
        plane = &t;
      }
      if (t.end == Trace::End::border) {
        if (border != nullptr && border->border != t.border) return false;
        border = &t;
      }
    }
    if (corners > 0) {
      const PointSource& at = arrangement_.points.source(traces[0].a);
      return corners == traces.size() && lone_.corner({at.a, at.b});
    }
    if (border == nullptr || !lone_.edge(border->border)) return false;
    return plane == nullptr || (lone_.crosses(border->border, plane->plane) && lone_group(plane->group));
  }
  /// Whether the contacts inside all facets of a group are single points.
  bool lone_group(std::uint32_t g) {
    if (lone_groups_.empty()) lone_groups_.assign(arrangement_.groups.size(), 0);
    if (lone_groups_[g] == 0) {
      const std::vector<std::uint32_t>& facets = arrangement_.groups[g].facets;
      lone_groups_[g] = std::all_of(facets.begin(), facets.end(), [&](std::uint32_t f) { return lone_.facet(f); }) ? 2 : 1;
    }
    return lone_groups_[g] == 2;
  }

  void look_at_edge(std::span<const Trace> traces) {
    const Trace& t = traces[0];
    if (traces.size() < 3 && free_in_a_wedge(traces)) return;
    if (free_by_itself(traces)) return;
    if (overlaps({arrangement_.points.source(t.a), t.plane, t.cut, t.way, 0, 0})) return;
    result_.segments.push_back({t.a, t.b});
    touched_[t.a] = touched_[t.b] = true;
  }

  /// Where facets touch the inside of a cell at a point, the outside may lie in front of that cell.
  void look_at_touches(const PlaneGroup& group) {
    for (const PlaneCells::Touch& t : group.cells.touches) {
      const PointId at = arrangement_.point(group, t.at);
      dots_.push_back(at);
      for (const std::int8_t side : {std::int8_t{1}, std::int8_t{-1}})
        if (!touched_[at] && !overlaps({arrangement_.points.source(at), group.plane, t.cut, 1, 1, side}))
          touched_[at] = true;
    }
  }

  void look_at_point(std::span<const Trace> traces) {
    const PointId at = traces[0].a;
    if (touched_[at] || free_in_a_wedge(traces)) return;
    // Facets that touch it inside of a cell are in no trace.
    if (!std::binary_search(dots_.begin(), dots_.end(), at) && free_by_itself(traces)) return;
    if (!overlaps({arrangement_.points.source(at), 0, 0, 0, 0, 0})) result_.points.push_back(at);
  }

  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const std::vector<bool>& boundary_;
  const Collision& collision_;
  LoneContacts lone_;
  std::vector<bool> touched_;          // points in the closure of something outside
  std::vector<std::uint64_t> closed_;  // edges alike
  std::vector<Trace> edges_, points_;
  std::vector<PointId> dots_;                       // points that facets touch inside of a cell
  std::vector<std::array<std::uint32_t, 2>> ends_;  // scratch: points with edges of one plane
  std::vector<std::uint8_t> lone_groups_;           // 0 not known yet, 1 no, 2 yes
  TightFeatures result_;
};

}  // namespace

TightFeatures tight_features(const SumSpace& space, const FacetTable& table, const SolidArrangement& arrangement,
                             const std::vector<bool>& boundary, const Collision& collision) {
  return Tight(space, arrangement, boundary, collision, LoneContacts(space, table, collision.p(), collision.q())).run();
}

}  // namespace dymsum::spatial
