// The faces of a sum cut to a box, independently of how a local sum is made: as signed measures on lines. A set of
// polygons in a plane is known by the boundary of its area, and that, on every line, by the ends of its pieces; a
// polygon is a signed sum of triangles about any point of its plane, each of which is cut to the box by itself.
#pragma once

#include <array>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "dymsum/local_sum.h"
#include "exact/big.h"

namespace dymsum::clipped_chains {

using Number = exact::BigRational;
using Place = std::array<Number, 3>;
using Loops = std::vector<std::vector<std::uint32_t>>;
using Key = std::array<Number, 7>;  // of an oriented plane or a line
/// Per plane and line in it, what begins at a place less what ends there; nothing where both are equal.
using Chains = std::map<std::pair<Key, Key>, std::map<Place, int>>;

inline Place minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Number dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline bool is_zero(const Place& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }
/// Divided by the size of its first component, which keeps its sign.
inline Place unit(Place v) {
  std::size_t k = 0;
  while (v[k] == 0) ++k;
  const Number size = abs(v[k]);
  for (Number& c : v) c /= size;
  return v;
}

inline Key line_key(const Place& a, const Place& b) {
  Place d = unit(minus(b, a));
  std::size_t k = 0;
  while (d[k] == 0) ++k;
  if (d[k] < 0) d = {-d[0], -d[1], -d[2]};
  return {d[0], d[1], d[2], a[0] - a[k] * d[0], a[1] - a[k] * d[1], a[2] - a[k] * d[2], 0};
}

inline Place exact_place(const SpatialSum& sum, std::uint32_t v) {
  const RationalPoint3 x = sum.exact(v);
  return {exact::exact_value(x.x), exact::exact_value(x.y), exact::exact_value(x.z)};
}

struct Walls {
  Place low, high;
  explicit Walls(const ClipBox& box)
      : low{exact::exact_value(box.low.x), exact::exact_value(box.low.y), exact::exact_value(box.low.z)},
        high{exact::exact_value(box.high.x), exact::exact_value(box.high.y), exact::exact_value(box.high.z)} {}

  bool hold(const Place& x) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (x[k] < low[k] || x[k] > high[k]) return false;
    return true;
  }
  /// A convex polygon cut by all six.
  std::vector<Place> cut(std::vector<Place> polygon) const {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const bool from_below : {true, false}) {
        const auto height = [&](const Place& x) { return from_below ? Number(x[k] - low[k]) : Number(high[k] - x[k]); };
        std::vector<Place> rest;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
          const Place &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
          const Number u = height(a), v = height(b);
          if (u >= 0) rest.push_back(a);
          if ((u > 0 && v < 0) || (u < 0 && v > 0)) {
            const Number t = u / (u - v);
            rest.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
          }
        }
        polygon = std::move(rest);
      }
    }
    return polygon;
  }
};

inline void add(Chains& chains, const Key& plane, const Place& a, const Place& b, int sign) {
  if (a == b) return;
  std::map<Place, int>& line = chains[{plane, line_key(a, b)}];
  line[a] += sign, line[b] -= sign;
}

inline Place normal_of(const SpatialSum& sum, const std::vector<std::uint32_t>& loop) {
  const Place o = exact_place(sum, loop[0]);
  Place n{};
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const Place c = cross(minus(exact_place(sum, loop[k]), o), minus(exact_place(sum, loop[k + 1]), o));
    for (std::size_t i = 0; i < 3; ++i) n[i] += c[i];
  }
  return n;
}

inline Key plane_key(const SpatialSum& sum, const std::vector<std::uint32_t>& loop) {
  const Place n = unit(normal_of(sum, loop));
  return {n[0], n[1], n[2], dot(n, exact_place(sum, loop[0])), 0, 0, 0};
}

inline void add_cut(Chains& chains, const SpatialSum& sum, const Loops& loops, const Walls& walls) {
  const Key plane = plane_key(sum, loops[0]);
  const Place n{plane[0], plane[1], plane[2]}, o = exact_place(sum, loops[0][0]);
  for (const auto& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Place a = exact_place(sum, loop[k]), b = exact_place(sum, loop[(k + 1) % loop.size()]);
      const Place c = cross(minus(a, o), minus(b, o));
      if (is_zero(c)) continue;
      const int sign = dot(c, n) > 0 ? 1 : -1;
      if (sign < 0) std::swap(a, b);
      const std::vector<Place> piece = walls.cut({o, a, b});
      for (std::size_t i = 0; i < piece.size(); ++i) add(chains, plane, piece[i], piece[(i + 1) % piece.size()], sign);
    }
  }
}

inline void add_whole(Chains& chains, const SpatialSum& sum, const Loops& loops) {
  const Key plane = plane_key(sum, loops[0]);
  for (const auto& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      add(chains, plane, exact_place(sum, loop[k]), exact_place(sum, loop[(k + 1) % loop.size()]), 1);
}

inline Chains without_zeros(Chains chains) {
  for (auto line = chains.begin(); line != chains.end();) {
    std::erase_if(line->second, [](const auto& end) { return end.second == 0; });
    line = line->second.empty() ? chains.erase(line) : std::next(line);
  }
  return chains;
}

/// What tells a part of a sum: faces, tight faces, tight segments, tight points.
using Shape = std::tuple<Chains, Chains, Chains, std::vector<Place>>;

inline Shape cut(const SpatialSum& sum, const ClipBox& box) {
  const Walls walls(box);
  Chains faces, tight, segments;
  std::vector<Place> points;
  for (const SpatialFace& face : sum.faces) add_cut(faces, sum, face.loops, walls);
  for (const Loops& loops : sum.tight_faces) add_cut(tight, sum, loops, walls);
  for (const auto& [from, to] : sum.tight_segments) {
    const std::vector<Place> piece = walls.cut({exact_place(sum, from), exact_place(sum, to)});
    std::pair<Place, Place> ends;
    if (piece.empty()) continue;
    ends = {*std::min_element(piece.begin(), piece.end()), *std::max_element(piece.begin(), piece.end())};
    add(segments, {}, ends.first, ends.second, 1);
  }
  for (const std::uint32_t v : sum.tight_points)
    if (walls.hold(exact_place(sum, v))) points.push_back(exact_place(sum, v));
  std::sort(points.begin(), points.end());
  return {without_zeros(faces), without_zeros(tight), without_zeros(segments), points};
}

inline Shape shape_of(const SpatialSum& part) {
  Chains faces, tight, segments;
  std::vector<Place> points;
  for (const SpatialFace& face : part.faces) add_whole(faces, part, face.loops);
  for (const Loops& loops : part.tight_faces) add_whole(tight, part, loops);
  for (const auto& [from, to] : part.tight_segments)
    add(segments, {}, exact_place(part, from), exact_place(part, to), 1);
  for (const std::uint32_t v : part.tight_points) points.push_back(exact_place(part, v));
  std::sort(points.begin(), points.end());
  return {without_zeros(faces), without_zeros(tight), without_zeros(segments), points};
}

}  // namespace dymsum::clipped_chains
