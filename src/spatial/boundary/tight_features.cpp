#include "spatial/boundary/tight_features.h"

#include <algorithm>
#include <span>
#include <tuple>

namespace dymsum::spatial {

namespace {

/// An edge of a plane's cells, or a point of them.
struct Trace {
  PointId a, b;  ///< a <= b; equal for a point
  PlaneId plane, cut;
  std::int8_t way;  ///< 1 where the way from a to b is n x n_cut
  bool full;        ///< all around it in the plane lie facets of one direction, none of the other
};

class Tight {
 public:
  Tight(const SumSpace& space, const SolidArrangement& arrangement, const std::vector<bool>& boundary,
        const Collision& collision)
      : space_(space),
        arrangement_(arrangement),
        boundary_(boundary),
        collision_(collision),
        touched_(arrangement.points.size()) {}

  TightFeatures run() {
    for (const PlaneGroup& group : arrangement_.groups) look_at_cells(group);
    for (const PlaneGroup& group : arrangement_.groups) collect(group);
    sort(edges_);
    for_each_place(edges_, [&](std::span<const Trace> traces) { look_at_edge(traces); });
    for (const PlaneGroup& group : arrangement_.groups) look_at_touches(group);
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

  void collect(const PlaneGroup& group) {
    const auto facing = [&](std::uint32_t c) {  // 1 or -1 for facets of one direction, else 0
      if (c == kNoId) return 0;
      const Cell& cell = group.cells.cells[c];
      return cell.front > 0 ? cell.back > 0 ? 0 : 1 : -1;
    };
    std::vector<Trace> ends;
    for (const CellEdge& e : group.cells.edges) {
      const PointId a = arrangement_.point(group, e.a), b = arrangement_.point(group, e.b);
      const bool full = facing(e.left) != 0 && facing(e.left) == facing(e.right);
      const auto way = static_cast<std::int8_t>((e.along ? 1 : -1) * (a < b ? 1 : -1));
      edges_.push_back({std::min(a, b), std::max(a, b), group.plane, e.cut, way, full});
      ends.push_back({a, a, group.plane, 0, 0, full});
      ends.push_back({b, b, group.plane, 0, 0, full});
    }
    sort(ends);
    for_each_place(ends, [&](std::span<const Trace> traces) {
      Trace trace = traces[0];
      trace.full = std::all_of(traces.begin(), traces.end(), [](const Trace& t) { return t.full; });
      points_.push_back(trace);
    });
  }

  /// Whether contacts there hold up motion in independent directions only: then what is free is free in a wedge, too.
  bool free_in_a_wedge(std::span<const Trace> traces) const {
    if (traces.size() > 3) return false;
    for (const Trace& t : traces)
      if (!t.full) return false;
    if (traces.size() < 3) return true;
    return space_.det(traces[0].plane, traces[1].plane, traces[2].plane) != 0;
  }

  void look_at_edge(std::span<const Trace> traces) {
    if (!closed_sorted_) {
      std::sort(closed_.begin(), closed_.end());
      closed_sorted_ = true;
    }
    const Trace& t = traces[0];
    if (std::binary_search(closed_.begin(), closed_.end(), edge_key(t.a, t.b))) return;
    if (traces.size() < 3 && free_in_a_wedge(traces)) return;
    if (overlaps({arrangement_.points.source(t.a), t.plane, t.cut, t.way, 0, 0})) return;
    result_.segments.push_back({t.a, t.b});
    touched_[t.a] = touched_[t.b] = true;
  }

  /// Where facets touch the inside of a cell at a point, the outside may lie in front of that cell.
  void look_at_touches(const PlaneGroup& group) {
    for (const PlaneCells::Touch& t : group.cells.touches) {
      const PointId at = arrangement_.point(group, t.at);
      for (const std::int8_t side : {std::int8_t{1}, std::int8_t{-1}})
        if (!touched_[at] && !overlaps({arrangement_.points.source(at), group.plane, t.cut, 1, 1, side}))
          touched_[at] = true;
    }
  }

  void look_at_point(std::span<const Trace> traces) {
    const PointId at = traces[0].a;
    if (touched_[at] || free_in_a_wedge(traces)) return;
    if (!overlaps({arrangement_.points.source(at), 0, 0, 0, 0, 0})) result_.points.push_back(at);
  }

  const SumSpace& space_;
  const SolidArrangement& arrangement_;
  const std::vector<bool>& boundary_;
  const Collision& collision_;
  std::vector<bool> touched_;          // points in the closure of something outside
  std::vector<std::uint64_t> closed_;  // edges alike
  bool closed_sorted_ = false;
  std::vector<Trace> edges_, points_;
  TightFeatures result_;
};

}  // namespace

TightFeatures tight_features(const SumSpace& space, const SolidArrangement& arrangement,
                             const std::vector<bool>& boundary, const Collision& collision) {
  return Tight(space, arrangement, boundary, collision).run();
}

}  // namespace dymsum::spatial
