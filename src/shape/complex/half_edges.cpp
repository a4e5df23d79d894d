#include "shape/complex/half_edges.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/scratch.h"
#include "exact/orient.h"

namespace dymsum::shape {
namespace {

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

}  // namespace

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

}  // namespace dymsum::shape
