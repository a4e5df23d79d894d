#include "shape/complex/walks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/scratch.h"
#include "exact/grid.h"
#include "exact/orient.h"
#include "shape/complex/complex.h"

namespace dymsum::shape {
namespace {

// The boundary of a region as directed edges with the discs on their right, joined so that each closed walk bounds
// free space that is connected there.

struct HalfEdge {
  std::uint32_t from = 0, to = 0;  ///< points
  std::uint32_t index = 0;         ///< of the edge in the region
  std::uint32_t from_index = 0;    ///< of a vertex of the region that lies at `from`
};

struct HalfEdges {
  std::vector<Point> points;  ///< no two equal, lexicographically
  std::vector<HalfEdge> edges;
  std::vector<std::uint32_t> next;                                ///< edge -> edge
  std::vector<std::pair<std::uint32_t, std::uint32_t>> isolated;  ///< points that are components; vertex indices
  std::vector<std::uint32_t> component;                           ///< point -> connected piece of the region
};

bool before(const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

/// A segment of the boundary as the region has it.
struct Segment {
  Point a, b;
  std::uint32_t index = 0, from_index = 0, to_index = 0;  ///< edge, and vertices; kNoIndex where it was cut
  bool one_sided = true;                                  ///< of a ring
};

struct Segments {
  std::vector<Segment> list;
  std::vector<std::pair<Point, std::uint32_t>> isolated;
  /// Pairs of vertices of one piece that no boundary joins: an outer ring and its hole.
  std::vector<std::pair<Point, Point>> joined;
};

void add_ring(Segments& out, const Ring& ring, std::uint32_t first) {
  const auto n = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = i + 1 == n ? 0 : i + 1;
    out.list.push_back({ring[i], ring[j], first + i, first + i, first + j, true});
  }
}

Segments segments_of(const Region& region, Side side) {
  Segments out;
  std::uint32_t first = 0;
  for (const Part& part : region.parts()) {
    add_ring(out, part.outer, first);
    first += static_cast<std::uint32_t>(part.outer.size());
    for (const Ring& hole : part.holes) {
      add_ring(out, hole, first);
      first += static_cast<std::uint32_t>(hole.size());
      out.joined.push_back({part.outer[0], hole[0]});
    }
  }
  if (side == Side::inside) return out;
  for (const Polyline& line : region.polylines()) {
    for (std::uint32_t i = 0; i + 1 < line.size(); ++i)
      out.list.push_back({line[i], line[i + 1], first + i, first + i, first + i + 1, false});
    first += static_cast<std::uint32_t>(line.size());
  }
  for (const Point& p : region.points()) out.isolated.push_back({p, first++});
  return out;
}

/// The boundary cut at the touching points that lie inside of its segments.
class Cutter {
 public:
  explicit Cutter(std::vector<Point> touching) : touching_(std::move(touching)) {
    std::sort(touching_.begin(), touching_.end(), before);
  }

  void cut(const Segment& s, std::vector<Segment>& out) const {
    const bool forward = before(s.a, s.b);
    const Point low = forward ? s.a : s.b, high = forward ? s.b : s.a;
    std::vector<Point> on;
    for (auto p = std::upper_bound(touching_.begin(), touching_.end(), low, before);
         p != touching_.end() && before(*p, high); ++p) {
      if (std::min(s.a.y, s.b.y) <= p->y && p->y <= std::max(s.a.y, s.b.y) && exact::orient_sign(s.a, s.b, *p) == 0)
        on.push_back(*p);
    }
    if (!forward) std::reverse(on.begin(), on.end());
    Segment rest = s;
    for (const Point& p : on) {
      out.push_back({rest.a, p, rest.index, rest.from_index, kNoIndex, rest.one_sided});
      rest.a = p;
      rest.from_index = kNoIndex;
    }
    out.push_back(rest);
  }

 private:
  std::vector<Point> touching_;
};

/// Whether d lies before e, counter-clockwise from the direction `from`; all from the point `at`, to the points given.
bool earlier(Point at, Point from, Point d, Point e) {
  const auto half = [&](Point p) {
    const int side = exact::orient_sign(at, from, p);
    if (side != 0) return side > 0 ? 0 : 2;
    return exact::dot_sign(at, from, at, p) > 0 ? 3 : 1;  // the direction itself comes last
  };
  const int hd = half(d), he = half(e);
  return hd != he ? hd < he : exact::orient_sign(at, d, e) > 0;
}

class GraphBuilder {
 public:
  explicit GraphBuilder(const Segments& s) {
    for (const Segment& e : s.list) graph_.points.insert(graph_.points.end(), {e.a, e.b});
    for (const auto& [p, index] : s.isolated) graph_.points.push_back(p);
    std::sort(graph_.points.begin(), graph_.points.end(), before);
    graph_.points.erase(std::unique(graph_.points.begin(), graph_.points.end()), graph_.points.end());
  }

  void add(const Segment& s, bool reversed) {
    const std::uint32_t a = find(s.a), b = find(s.b);
    if (!reversed) graph_.edges.push_back({a, b, s.index, s.from_index});
    if (reversed) graph_.edges.push_back({b, a, s.index, s.to_index});
  }
  void add_isolated(Point p, std::uint32_t index) {
    const std::uint32_t i = find(p);
    if (graph_.isolated.empty() || graph_.isolated.back().first != i) graph_.isolated.push_back({i, index});
  }

  HalfEdges finish(const std::vector<std::pair<Point, Point>>& joined) {
    name_cuts();
    link();
    UnionFind pieces(static_cast<std::uint32_t>(graph_.points.size()));
    for (const HalfEdge& e : graph_.edges) pieces.unite(e.from, e.to);
    for (const auto& [p, q] : joined) pieces.unite(find(p), find(q));
    graph_.component.assign(graph_.points.size(), kNoIndex);
    std::vector<std::uint32_t> name(graph_.points.size(), kNoIndex);
    std::uint32_t count = 0;
    const auto component = [&](std::uint32_t p) {
      std::uint32_t& n = name[pieces.root(p)];
      if (n == kNoIndex) n = count++;
      graph_.component[p] = n;
    };
    for (const HalfEdge& e : graph_.edges) component(e.from);
    for (const auto& [p, index] : graph_.isolated) component(p);
    return std::move(graph_);
  }

 private:
  std::uint32_t find(Point p) const {
    return static_cast<std::uint32_t>(std::lower_bound(graph_.points.begin(), graph_.points.end(), p, before) -
                                      graph_.points.begin());
  }

  /// A cut has the index of the vertex that touches there.
  void name_cuts() {
    std::vector<std::uint32_t> name(graph_.points.size(), kNoIndex);
    for (const HalfEdge& e : graph_.edges) {
      if (e.from_index != kNoIndex) name[e.from] = std::min(name[e.from], e.from_index);
    }
    for (HalfEdge& e : graph_.edges) {
      if (e.from_index == kNoIndex) e.from_index = name[e.from];
    }
  }

  /// Links each half-edge in to the next one out, counter-clockwise: between them lies free space.
  void link() {
    std::vector<std::uint32_t> first(graph_.points.size() + 1, 0), out(graph_.edges.size());
    for (const HalfEdge& e : graph_.edges) ++first[e.from + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> fill(first.begin(), first.end() - 1);
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e) out[fill[graph_.edges[e].from]++] = e;
    graph_.next.resize(graph_.edges.size());
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e) {
      const HalfEdge& in = graph_.edges[e];
      std::uint32_t best = out[first[in.to]];
      for (std::uint32_t i = first[in.to] + 1; i < first[in.to + 1]; ++i) {
        if (earlier(graph_.points[in.to], graph_.points[in.from], end(out[i]), end(best))) best = out[i];
      }
      graph_.next[e] = best;
    }
  }
  Point end(std::uint32_t e) const { return graph_.points[graph_.edges[e].to]; }

  HalfEdges graph_;
};

/// Edges are cut at the positions where rings touch. Outside, a polyline is there and back; inside, polylines and
/// points are nothing. Errors: as make_complex. O(n log n) for n vertices that touch at O(log n) places.
Result<HalfEdges> make_half_edges(const Region& region, Side side) {
  const Segments whole = segments_of(region, side);
  const Cutter cutter(region.touching_points());
  Segments cut{{}, whole.isolated, whole.joined};
  for (const Segment& s : whole.list) cutter.cut(s, cut.list);
  GraphBuilder builder(cut);
  for (const Segment& s : cut.list) {
    const bool one = s.one_sided;
    if (!one || side == Side::outside) builder.add(s, false);
    if (!one || side == Side::inside) builder.add(s, true);
  }
  for (const auto& [p, index] : cut.isolated) builder.add_isolated(p, index);
  return builder.finish(whole.joined);
}

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
