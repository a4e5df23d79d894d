#include "shape/features/pocket.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "exact/orient.h"
#include "shape/features/position.h"

namespace dymsum::shape {
namespace {

constexpr std::uint32_t kRun = 16;  // shorter runs are looked through

bool left_of(const BoundaryLoops& loops, std::uint32_t a, std::uint32_t b) {
  const Point p = loops.vertices[a].at, q = loops.vertices[b].at;
  return p.x != q.x ? p.x < q.x : p.y < q.y;
}

/// The chain of the hull above (turn > 0: the hull lies to the right of its edges) or below sorted vertices.
std::vector<std::uint32_t> half_hull(const BoundaryLoops& loops, const std::vector<std::uint32_t>& sorted, int turn) {
  std::vector<std::uint32_t> hull;
  for (const std::uint32_t v : sorted) {
    const auto at = [&](std::size_t back) { return loops.vertices[hull[hull.size() - back]].at; };
    if (!hull.empty() && at(1) == loops.vertices[v].at) {  // rings touch there, or a polyline comes back
      const auto name = [&](std::uint32_t w) { return std::make_pair(loops.rank[w], loops.vertices[w].vertex); };
      if (name(v) < name(hull.back())) hull.back() = v;
      continue;
    }
    while (hull.size() > 1 && exact::orient_sign(at(2), at(1), loops.vertices[v].at) * turn >= 0) hull.pop_back();
    hull.push_back(v);
  }
  return hull;
}

std::vector<std::uint32_t> merged(const BoundaryLoops& loops, const std::vector<std::uint32_t>& a,
                                  const std::vector<std::uint32_t>& b) {
  std::vector<std::uint32_t> all(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), all.begin(),
             [&](std::uint32_t x, std::uint32_t y) { return left_of(loops, x, y); });
  return all;
}

}  // namespace

ChainExtremes::ChainExtremes(const BoundaryLoops& loops) : loops_(&loops) {
  const std::uint32_t n = std::uint32_t(loops.vertices.size());
  levels_.emplace_back();
  for (std::uint32_t first = 0; first < n; first += kRun) {
    std::vector<std::uint32_t> run;
    for (std::uint32_t v = first; v < std::min(n, first + kRun); ++v) run.push_back(v);
    std::stable_sort(run.begin(), run.end(), [&](std::uint32_t a, std::uint32_t b) { return left_of(loops, a, b); });
    levels_[0].push_back({half_hull(loops, run, 1), half_hull(loops, run, -1)});
  }
  while (levels_.back().size() > 1) {
    std::vector<Hull> level;
    const std::vector<Hull>& below = levels_.back();
    for (std::size_t i = 0; i + 1 < below.size(); i += 2) {
      level.push_back({half_hull(loops, merged(loops, below[i].upper, below[i + 1].upper), 1),
                       half_hull(loops, merged(loops, below[i].lower, below[i + 1].lower), -1)});
    }
    levels_.push_back(std::move(level));
  }
}

bool ChainExtremes::better(Line& line, std::uint32_t v, std::uint32_t than) const {
  const Position p{loops_->vertices[v].at, nullptr}, q{loops_->vertices[than].at, nullptr};
  if (const int sign = cross_sign(line.a, line.b, q, p); sign != 0) return sign > 0;
  if (const int sign = dot_sign(line.a, line.b, q, p); sign != 0) {
    line.tied = true;
    return sign == line.wanted;
  }
  const auto name = [&](std::uint32_t w) { return std::make_pair(loops_->rank[w], loops_->vertices[w].vertex); };
  return name(v) < name(than);
}

void ChainExtremes::see(Line& line, std::uint32_t v, std::uint32_t& best) const {
  if (best == kNoIndex || better(line, v, best)) best = v;
}

void ChainExtremes::see_hull(Line& line, const Hull& hull, std::uint32_t& best) const {
  // Along the half hull the distance grows, stays for one edge at most, and falls.
  const std::vector<std::uint32_t>& half = line.dx >= 0 ? hull.upper : hull.lower;
  const auto grows = [&](std::size_t i) {
    const Position p{loops_->vertices[half[i]].at, nullptr}, q{loops_->vertices[half[i + 1]].at, nullptr};
    return cross_sign(line.a, line.b, p, q) > 0;
  };
  std::size_t low = 0, high = half.size() - 1;  // the first that does not grow
  while (low < high) {
    const std::size_t midpoint = (low + high) / 2;
    if (grows(midpoint)) low = midpoint + 1;
    else high = midpoint;
  }
  see(line, half[low], best);
  if (low + 1 < half.size()) see(line, half[low + 1], best);
}

void ChainExtremes::see_run(Line& line, std::uint32_t first, std::uint32_t end, std::uint32_t& best) const {
  while (first < end) {
    if (first % kRun != 0 || end - first < kRun) {
      see(line, first++, best);
      continue;
    }
    std::size_t level = 0, at = first / kRun;
    while (at % 2 == 0 && level + 1 < levels_.size() && at / 2 < levels_[level + 1].size() &&
           (std::uint64_t(kRun) << (level + 1)) <= end - first)
      ++level, at /= 2;
    see_hull(line, levels_[level][at], best);
    first += kRun << level;
  }
}

std::uint32_t ChainExtremes::farthest_on(Line& line, const BoundaryChain& chain) const {
  const BoundaryLoop& loop = loops_->loops[chain.loop];
  std::uint32_t best = kNoIndex;
  if (chain.first <= chain.last) {
    see_run(line, chain.first, chain.last + 1, best);
  } else {
    see_run(line, chain.first, loop.last, best);
    see_run(line, loop.first, chain.last + 1, best);
  }
  return best;
}

std::uint32_t ChainExtremes::farthest(const BoundaryChain& chain, const Position& a, const Position& b) const {
  const Position zero{{0, 0}, nullptr}, up{{0, 1}, nullptr};
  Line line{a, b, cross_sign(a, b, zero, up)};
  const std::uint32_t first = farthest_on(line, chain);
  if (!line.tied) return first;
  line.wanted = 1;
  const std::uint32_t last = farthest_on(line, chain);
  return loops_->rank[last] < loops_->rank[first] ? last : first;
}

namespace {

// Shortest paths inside a pocket from its bridge.

/// Triangles of a simple polygon, counter-clockwise, by indices of its vertices. Vertices in line and positions where
/// the polygon touches itself from outside are allowed. Requires: counter-clockwise. Exact. O(n^2) signs at most.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<Position>& polygon);

bool same(const Position& a, const Position& b) { return !a.exact && !b.exact && a.at == b.at; }

/// Whether a vertex p with neighbours before and after it keeps the ear a, b, c from being cut off: it lies in the
/// ear, its corners left out, or at one of them with the boundary going into the ear.
bool in_triangle(const Position& a, const Position& b, const Position& c, const Position& p) {
  return turn_sign(a, b, p) >= 0 && turn_sign(b, c, p) >= 0 && turn_sign(c, a, p) >= 0;
}

class Ears {
 public:
  explicit Ears(const std::vector<Position>& polygon) : polygon_(polygon) {
    const auto n = std::uint32_t(polygon.size());
    for (std::uint32_t i = 0; i < n; ++i) next_.push_back((i + 1) % n), previous_.push_back((i + n - 1) % n);
  }

  std::vector<std::array<std::uint32_t, 3>> run() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::uint32_t left = std::uint32_t(polygon_.size()), at = 0, tried = 0;
    while (left > 3) {
      if (!is_ear(at)) {
        // The walk round a pocket does not cross itself: it has a triangulation, whose tree has leaves, which are ears.
        if (tried > left) throw std::logic_error("a pocket without an ear");
        at = next_[at], ++tried;
        continue;
      }
      const std::uint32_t a = previous_[at], c = next_[at];
      triangles.push_back({a, at, c});
      next_[a] = c;
      previous_[c] = a;
      at = next_[c];  // ears taken by turns keep triangles from all meeting at one vertex
      --left, tried = 0;
    }
    if (left == 3) triangles.push_back({previous_[at], at, next_[at]});
    return triangles;
  }

 private:
  /// Vertices in line make flat ears, which are cut off as well, and so do equal neighbours, which are left where the
  /// two sides of a polyline's tip were: a triangle without area changes no path.
  bool is_ear(std::uint32_t b) const {
    const std::uint32_t a = previous_[b], c = next_[b];
    const int turn = turn_sign(polygon_[a], polygon_[b], polygon_[c]);
    if (turn < 0) return false;
    if (same(polygon_[a], polygon_[b]) || same(polygon_[b], polygon_[c])) return true;
    if (turn == 0)
      return dot_sign(polygon_[b], polygon_[a], polygon_[b], polygon_[c]) < 0 || same(polygon_[a], polygon_[c]);
    for (std::uint32_t v = next_[c]; v != a; v = next_[v]) {
      const Position& p = polygon_[v];
      if (same(p, polygon_[a]) || same(p, polygon_[b]) || same(p, polygon_[c])) {
        if (enters(a, b, c, v)) return false;
      } else if (in_triangle(polygon_[a], polygon_[b], polygon_[c], p)) {
        return false;
      }
    }
    return true;
  }
  /// A vertex at a corner of the ear where the polygon touches itself: one of its edges goes into the ear.
  bool enters(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t v) const {
    for (const std::uint32_t w : {previous_[v], next_[v]}) {
      if (w == a || w == b || w == c) continue;
      const Position &p = polygon_[v], &q = polygon_[w];
      const bool at_a = same(p, polygon_[a]), at_b = same(p, polygon_[b]);
      const Position &u = at_a   ? polygon_[b]
                          : at_b ? polygon_[c]
                                 : polygon_[a],
                     &t = at_a   ? polygon_[c]
                          : at_b ? polygon_[a]
                                 : polygon_[b];
      if (turn_sign(p, u, q) > 0 && turn_sign(p, t, q) < 0) return true;
    }
    return false;
  }

  const std::vector<Position>& polygon_;
  std::vector<std::uint32_t> next_, previous_;
};

/// Shortest paths from the edge 0 -> 1 of a polygon to its vertices. They come as from infinitely far below the edge,
/// square to it: so a path to a vertex right above it ends at its foot.
class Funnel {
 public:
  explicit Funnel(const std::vector<Position>& polygon) : polygon_(polygon), parent_(polygon.size(), kNoIndex) {
    known_.assign(polygon.size(), false);
    known_[0] = known_[1] = true;
    for (const auto& t : triangles_of(polygon))
      for (int i = 0; i < 3; ++i)
        beyond_[{t[std::size_t(i)], t[std::size_t((i + 1) % 3)]}] = t[std::size_t((i + 2) % 3)];
    std::vector<std::pair<std::uint32_t, std::uint32_t>> doors{{0, 1}};
    while (!doors.empty()) {
      const auto [a, b] = doors.back();  // what lies beyond is to the left of a -> b
      doors.pop_back();
      const auto found = beyond_.find({a, b});
      if (found == beyond_.end()) continue;
      const std::uint32_t c = found->second;
      parent_[c] = tangent(path(a), path(b), c);
      known_[c] = true;
      doors.push_back({a, c});
      doors.push_back({c, b});
    }
  }

  /// 0 for vertices on the edge.
  double distance(std::uint32_t v) const {
    std::vector<const Position*> path;
    for (; v != kNoIndex; v = parent_[v]) path.push_back(&polygon_[v]);
    return way_length(path, polygon_[0], polygon_[1]);
  }

 private:
  /// The path from the edge's far side to v; the vertex after kNoIndex, which is infinity, comes first.
  std::vector<std::uint32_t> path(std::uint32_t v) const {
    std::vector<std::uint32_t> vertices;
    for (; v != kNoIndex; v = parent_[v]) vertices.push_back(v);
    std::reverse(vertices.begin(), vertices.end());
    return vertices;
  }
  /// The side of p as seen along from -> through; from infinity the direction is square to the edge.
  int side(std::uint32_t from, std::uint32_t through, std::uint32_t p) const {
    if (from == kNoIndex) return -dot_sign(polygon_[0], polygon_[1], polygon_[through], polygon_[p]);
    return turn_sign(polygon_[from], polygon_[through], polygon_[p]);
  }
  /// The vertex at which the path to c leaves the funnel of two paths, left (of the door's first vertex) and right.
  std::uint32_t tangent(const std::vector<std::uint32_t>& left, const std::vector<std::uint32_t>& right,
                        std::uint32_t c) const {
    std::size_t i = 0;
    while (i < left.size() && i < right.size() && left[i] == right[i]) ++i;
    const std::uint32_t apex = i == 0 ? kNoIndex : left[i - 1];
    // Beyond the left path: on along it while c is to the left of its next piece. The same on the right.
    const auto along = [&](const std::vector<std::uint32_t>& chain, int sign) {
      std::uint32_t at = apex;
      for (std::size_t k = i; k < chain.size() && side(at, chain[k], c) * sign > 0; ++k) at = chain[k];
      return at;
    };
    const std::uint32_t on_left = along(left, 1);
    return on_left != apex ? on_left : along(right, -1);
  }

  const std::vector<Position>& polygon_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> beyond_;
  std::vector<std::uint32_t> parent_;
  std::vector<bool> known_;
};

std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<Position>& polygon) {
  return Ears(polygon).run();
}

/// The length, for every vertex of the chain, of the shortest path from the bridge from - to that stays in the pocket,
/// the polygon from, to, and the chain backwards; the pocket lies to the left of from -> to. Which way the paths go is
/// decided exactly; their lengths are the nearest doubles.
std::vector<double> distances_from_bridge(const Position& from, const std::vector<Position>& chain,
                                          const Position& to) {
  std::vector<Position> polygon{from, to};
  polygon.insert(polygon.end(), chain.rbegin(), chain.rend());
  const Funnel funnel(polygon);
  std::vector<double> distances;
  for (std::size_t i = 0; i < chain.size(); ++i)
    distances.push_back(funnel.distance(std::uint32_t(polygon.size() - 1 - i)));
  return distances;
}

bool holds_outermost(const BoundaryLoops& loops, const BoundaryChain& chain) {
  const auto& outermost = loops.loops[chain.loop].outermost;
  return std::any_of(outermost.begin(), outermost.end(),
                     [&](std::uint32_t v) { return v != kNoIndex && holds(loops, chain, v); });
}

Bridge bridge_between(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge, Position left,
                      Position right) {
  const PocketSide side = pocket_side(complex, loops, edge);
  const Edge& e = complex.edges[edge];
  if (side.ahead) return {std::move(left), std::move(right), e.left, e.right, side.chain};
  return {std::move(right), std::move(left), e.right, e.left, side.chain};
}

/// Whether an edge of the chain runs backwards along the bridge: only then may shortest paths turn at vertices.
bool turns_back(const BoundaryLoops& loops, const Bridge& bridge) {
  const BoundaryChain& chain = *bridge.pocket;
  Position last = bridge.from;
  for (std::uint32_t v = chain.first;; v = loops.next(v)) {
    const Position here{loops.vertices[v].at, nullptr};
    if (dot_sign(bridge.from, bridge.to, last, here) < 0) return true;
    last = here;
    if (v == chain.last) break;
  }
  return dot_sign(bridge.from, bridge.to, last, bridge.to) < 0;
}

Deepest straight_minimum(const BoundaryLoops& loops, const ChainExtremes& extremes, const Bridge& bridge) {
  const std::uint32_t v = extremes.farthest(*bridge.pocket, bridge.from, bridge.to);
  return {v, distance_left(bridge.from, bridge.to, {loops.vertices[v].at, nullptr})};
}

Deepest geodesic_minimum(const BoundaryLoops& loops, const Bridge& bridge) {
  std::vector<Position> chain;
  for (std::uint32_t v = bridge.pocket->first;; v = loops.next(v)) {
    chain.push_back({loops.vertices[v].at, nullptr});
    if (v == bridge.pocket->last) break;
  }
  const std::vector<double> far = distances_from_bridge(bridge.from, chain, bridge.to);
  Deepest best;
  std::uint32_t v = bridge.pocket->first;
  for (const double distance : far) {
    const bool first = best.vertex == kNoIndex;
    if (first || distance > best.concavity || (distance == best.concavity && loops.rank[v] < loops.rank[best.vertex]))
      best = {v, distance};
    v = loops.next(v);
  }
  return best;
}

}  // namespace

PocketSide pocket_side(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge) {
  const std::uint32_t left = complex.edges[edge].left, right = complex.edges[edge].right;
  const std::uint32_t loop = loops.loop_of_site[left];
  if (loops.loop_of_site[right] != loop) return {};
  const BoundaryChain behind{loop, loops.after[right], loops.before[left]};
  if (!holds_outermost(loops, behind)) return {behind, false};
  return {BoundaryChain{loop, loops.after[left], loops.before[right]}, true};
}

Bridge bridge_at_end(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge) {
  const Edge& e = complex.edges[edge];
  if (e.high == kNoIndex) {
    const Position left{complex.sites[e.left].a, nullptr}, right{complex.sites[e.right].a, nullptr};
    return bridge_between(complex, loops, edge, left, right);
  }
  if (complex.sites[e.left].kind == Site::Kind::vertex && complex.sites[e.right].kind == Site::Kind::vertex)
    return bridge_between(complex, loops, edge, {complex.sites[e.left].a, nullptr},
                          {complex.sites[e.right].a, nullptr});
  const Centre centre = centre_of(complex, e.high);
  return bridge_between(complex, loops, edge, contact_position(complex, e.left, centre),
                        contact_position(complex, e.right, centre));
}

Bridge bridge_at(const Complex& complex, const BoundaryLoops& loops, std::uint32_t edge, const Rational& r) {
  const Edge& e = complex.edges[edge];
  const Centre centre{exact_centre_on_edge(complex, edge, r)};
  return bridge_between(complex, loops, edge, contact_position(complex, e.left, centre),
                        contact_position(complex, e.right, centre));
}

Deepest pocket_minimum(const BoundaryLoops& loops, const ChainExtremes& extremes, const Bridge& bridge,
                       const FeatureOptions& options) {
  const bool shortest = options.concavity == Concavity::shortest_path ||
                        (options.concavity == Concavity::hybrid1 && turns_back(loops, bridge));
  if (shortest) return geodesic_minimum(loops, bridge);
  const Deepest straight = straight_minimum(loops, extremes, bridge);
  if (options.concavity == Concavity::hybrid2 && straight.concavity <= options.hybrid_tolerance)
    return geodesic_minimum(loops, bridge);
  return straight;
}

}  // namespace dymsum::shape
