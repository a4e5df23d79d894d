#include "check/convex_cells.h"

#include <algorithm>
#include <map>

#include "check/edge_tree.h"
#include "planar/position/exact_source.h"

namespace dymsum::check {
namespace {

using LineRef = std::shared_ptr<const Line>;

/// An edge that is not vertical, from left to right.
struct Edge : Segment {
  LineRef line;
};

/// The position of the edge at the x of p.
PointRef at_x(const Edge& edge, const PointRef& p, const Line& vertical) {
  if (compare_x(*edge.from, *p) == 0) return edge.from;
  if (compare_x(*edge.to, *p) == 0) return edge.to;
  return meeting_of(*edge.line, vertical);
}

/// Whether edge a lies below b to the right of the left end of b, at which a is.
bool below(const Edge& a, const Edge& b) {
  const int sign = orientation(*a.from, *a.to, *b.from);
  return sign != 0 ? sign > 0 : orientation(*a.from, *a.to, *b.to) > 0;
}

class Trapezoids {
 public:
  explicit Trapezoids(std::vector<ConvexCell>& cells) : cells_(cells) {}

  void add_part(const PlanarSum& set, const SumPart& part) {
    PlanarSum rings;
    exact_source(rings) = exact_source(set);
    rings.parts = {part};
    edges_.clear();
    for (Segment& s : edges_of(rings)) {
      const int order = compare_x(*s.from, *s.to);
      if (order == 0) continue;
      if (order > 0) std::swap(s.from, s.to);
      auto line = std::make_shared<const Line>(line_through(s.from->exact, s.to->exact));
      edges_.push_back({std::move(s), std::move(line)});
    }
    sweep();
  }

 private:
  struct Event {
    PointRef at;
    std::uint32_t edge;
    bool ends;
  };

  void sweep() {
    std::vector<Event> events;
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      events.push_back({edges_[e].from, e, false}), events.push_back({edges_[e].to, e, true});
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
      const int order = compare_x(*a.at, *b.at);
      return order != 0 ? order < 0 : a.ends > b.ends;
    });
    for (std::size_t k = 0; k < events.size();) {
      const PointRef at = events[k].at;
      for (; k < events.size() && compare_x(*events[k].at, *at) == 0; ++k) {
        const std::uint32_t e = events[k].edge;
        if (events[k].ends) active_.erase(std::find(active_.begin(), active_.end(), e));
        else
          active_.insert(
              std::lower_bound(active_.begin(), active_.end(), e,
                               [&](std::uint32_t a, std::uint32_t b) { return below(edges_[a], edges_[b]); }),
              e);
      }
      pair_up(at);
    }
  }

  /// Every other gap between edges is inside the part.
  void pair_up(const PointRef& at) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, PointRef> now;
    for (std::size_t k = 0; k + 1 < active_.size(); k += 2) {
      const std::pair pair(active_[k], active_[k + 1]);
      const auto known = open_.find(pair);
      now.emplace(pair, known == open_.end() ? at : known->second);
    }
    for (const auto& [pair, since] : open_)
      if (!now.contains(pair)) add_cell(edges_[pair.first], edges_[pair.second], since, at);
    open_ = std::move(now);
  }

  void add_cell(const Edge& low, const Edge& high, const PointRef& from, const PointRef& to) {
    const auto vertical = [](const PointRef& p) {
      return std::make_shared<const Line>(Line{p->exact.w, 0, -p->exact.x});
    };
    const LineRef left = vertical(from), right = vertical(to);
    const PointRef corners[]{at_x(low, from, *left), at_x(low, to, *right), at_x(high, to, *right),
                             at_x(high, from, *left)};
    const LineRef lines[]{low.line, right, high.line, left};
    ConvexCell cell;
    for (int k = 0; k < 4; ++k) {
      if (same_position(*corners[k], *corners[(k + 1) % 4])) continue;
      cell.vertices.push_back(corners[k]);
      cell.lines.push_back(lines[k]);
    }
    cells_.push_back(std::move(cell));
  }

  std::vector<ConvexCell>& cells_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> active_;  // from below
  std::map<std::pair<std::uint32_t, std::uint32_t>, PointRef> open_;
};

}  // namespace

std::vector<ConvexCell> convex_cells(const PlanarSum& set) {
  std::vector<ConvexCell> cells;
  Trapezoids trapezoids(cells);
  for (const SumPart& part : set.parts) trapezoids.add_part(set, part);
  PlanarSum thin;
  exact_source(thin) = exact_source(set);
  thin.segments = set.segments;
  thin.points = set.points;
  for (const Segment& s : edges_of(thin)) {
    if (s.from == s.to) {
      cells.push_back({{s.from}, {nullptr}});
      continue;
    }
    const auto line = std::make_shared<const Line>(line_through(s.from->exact, s.to->exact));
    cells.push_back({{s.from, s.to}, {line, line}});
  }
  return cells;
}

HalvedCell halved(const ConvexCell& cell, Line line) {
  HalvedCell halves;
  const std::size_t n = cell.vertices.size();
  std::vector<int> side;
  for (const PointRef& p : cell.vertices) side.push_back(line.at(p->exact).sign());
  const auto cut = std::make_shared<const Line>(std::move(line));
  const auto add = [](ConvexCell& to, const PointRef& p, const LineRef& after) {
    to.vertices.push_back(p);
    to.lines.push_back(after);
  };
  for (std::size_t k = 0; k < n; ++k) {
    const int here = side[k], next = side[(k + 1) % n];
    const PointRef& p = cell.vertices[k];
    // From a position on the cut into the other half the own one goes on along the cut.
    if (here <= 0) add(halves.negative, p, here == 0 && next > 0 ? cut : cell.lines[k]);
    if (here >= 0) add(halves.positive, p, here == 0 && next < 0 ? cut : cell.lines[k]);
    if (here * next >= 0 || (n == 2 && k == 1)) continue;
    const PointRef q = meeting_of(*cell.lines[k], *cut);
    add(halves.negative, q, next > 0 && n > 2 ? cut : cell.lines[k]);
    add(halves.positive, q, next < 0 && n > 2 ? cut : cell.lines[k]);
  }
  return halves;
}

}  // namespace dymsum::check
