#include "shape/features/geodesic.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace dymsum::shape {
namespace {

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

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<Position>& polygon) {
  return Ears(polygon).run();
}

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

}  // namespace dymsum::shape
