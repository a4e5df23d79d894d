#include "shape/complex/walks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/scratch.h"
#include "exact/grid.h"
#include "exact/orient.h"
#include "shape/complex/half_edges.h"

namespace dymsum::shape {
namespace {

/// Grid integers and intervals of the coordinates.
void place(Walks& walks) {
  std::vector<Point> input;
  double most = 0;
  for (const BoundaryPoint& p : walks.points) {
    input.push_back(p.input);
    most = std::max({most, std::abs(p.input.x), std::abs(p.input.y)});
  }
  walks.grid_exponent = exact::common_exponent(std::span<const Point>(input));
  walks.unit_exponent = most == 0 ? 0 : std::ilogb(most);
  const auto interval = [&](double v) {
    const double u = std::ldexp(v, -walks.unit_exponent);
    if (std::ldexp(u, walks.unit_exponent) == v) return exact::Interval(u);
    return exact::Interval(std::nextafter(u, -1.0), std::nextafter(u, 1.0));
  };
  for (BoundaryPoint& p : walks.points) {
    p.x = exact::grid_coordinate<exact::Big>(p.input.x, walks.grid_exponent).value();
    p.y = exact::grid_coordinate<exact::Big>(p.input.y, walks.grid_exponent).value();
    p.ix = interval(p.input.x);
    p.iy = interval(p.input.y);
  }
}

/// One loop of half-edges, without flat vertices, as sites.
class LoopSites {
 public:
  LoopSites(Walks& walks, const HalfEdges& graph, std::vector<std::uint32_t> loop)
      : walks_(walks), graph_(graph), loop_(std::move(loop)) {}

  void add() {
    rotate_to_a_corner();
    const auto loop = static_cast<std::uint32_t>(walks_.loops.size());
    const auto first = static_cast<std::uint32_t>(walks_.sites.size());
    for (std::size_t i = 0; i < loop_.size();) {
      std::size_t last = i;
      while (last + 1 < loop_.size() && turn(last + 1) == Turn::flat) ++last;
      add_edge(i, last, loop);
      i = last + 1;
    }
    link(first);
  }

 private:
  enum class Turn : std::uint8_t { convex, flat, reflex };

  const HalfEdge& edge(std::size_t i) const { return graph_.edges[loop_[i % loop_.size()]]; }
  Point at(std::uint32_t point) const { return walks_.points[point].input; }

  /// The turn at the start of edge i.
  Turn turn(std::size_t i) const {
    const HalfEdge& in = edge(i + loop_.size() - 1);
    const HalfEdge& out = edge(i);
    const int cross = exact::cross_sign(at(in.from), at(in.to), at(out.from), at(out.to));
    if (cross != 0) return cross > 0 ? Turn::convex : Turn::reflex;
    return exact::dot_sign(at(in.from), at(in.to), at(out.from), at(out.to)) < 0 ? Turn::convex : Turn::flat;
  }

  /// The first vertex that is not flat, of those the one with the smallest index.
  void rotate_to_a_corner() {
    std::size_t best = loop_.size();
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      if (turn(i) != Turn::flat && (best == loop_.size() || edge(i).index < edge(best).index)) best = i;
    }
    std::rotate(loop_.begin(), loop_.begin() + static_cast<std::ptrdiff_t>(best), loop_.end());
  }

  void add_edge(std::size_t first, std::size_t last, std::uint32_t loop) {
    const std::uint32_t a = edge(first).from, b = edge(last).to;
    const std::uint32_t component = graph_.component[a];
    const Turn start = turn(first);
    if (start == Turn::convex)
      push({Site::Kind::vertex, edge(first).from_index, loop, component, at(a), at(a)}, a, a, kNoIndex);
    push({Site::Kind::edge, edge(first).index, loop, component, at(a), at(b)}, a, b,
         start == Turn::reflex ? edge(first).from_index : kNoIndex);
  }

  void push(const Site& site, std::uint32_t a, std::uint32_t b, std::uint32_t corner) {
    walks_.sites.push_back(site);
    walks_.ends.push_back({a, b, 0, 0});
    walks_.corner.push_back(corner);
  }

  void link(std::uint32_t first) {
    const auto last = static_cast<std::uint32_t>(walks_.sites.size());
    for (std::uint32_t s = first; s < last; ++s) {
      walks_.ends[s].prev = s == first ? last - 1 : s - 1;
      walks_.ends[s].next = s + 1 == last ? first : s + 1;
    }
    walks_.loops.push_back({first, last});
  }

  Walks& walks_;
  const HalfEdges& graph_;
  std::vector<std::uint32_t> loop_;
};

void add_isolated(Walks& walks, const HalfEdges& graph, std::uint32_t point, std::uint32_t index) {
  const auto s = static_cast<std::uint32_t>(walks.sites.size());
  const Point at = walks.points[point].input;
  walks.sites.push_back(
      {Site::Kind::vertex, index, static_cast<std::uint32_t>(walks.loops.size()), graph.component[point], at, at});
  walks.ends.push_back({point, point, s, s});
  walks.corner.push_back(kNoIndex);
  walks.loops.push_back({s, s + 1});
}

}  // namespace

Result<Walks> make_walks(const Region& region, Side side) {
  Result<HalfEdges> made = make_half_edges(region, side);
  if (!made) return made.error();
  const HalfEdges& graph = *made;
  Walks walks;
  walks.side = side;
  for (const Point& p : graph.points) walks.points.push_back({p, {}, {}, {}, {}});
  place(walks);
  std::vector<std::uint8_t> seen(graph.edges.size(), 0);
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (seen[e]) continue;
    std::vector<std::uint32_t> loop;
    for (std::uint32_t i = e; !seen[i]; i = graph.next[i]) {
      seen[i] = 1;
      loop.push_back(i);
    }
    LoopSites(walks, graph, std::move(loop)).add();
  }
  for (const auto& [point, index] : graph.isolated) add_isolated(walks, graph, point, index);
  return walks;
}

}  // namespace dymsum::shape
