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
using Position = std::array<Number, 3>;
using Loops = std::vector<std::vector<std::uint32_t>>;
using Key = std::array<Number, 7>;  // of an oriented plane or a line
/// Per plane and line in it, what begins at a position less what ends there; nothing where both are equal.
using Chains = std::map<std::pair<Key, Key>, std::map<Position, int>>;

inline Position minus(const Position& a, const Position& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Number dot(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Position cross(const Position& a, const Position& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline bool is_zero(const Position& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }
/// Divided by the size of its first component, which keeps its sign.
inline Position unit(Position v) {
  std::size_t k = 0;
  while (v[k] == 0) ++k;
  const Number size = abs(v[k]);
  for (Number& c : v) c /= size;
  return v;
}

inline Key line_key(const Position& a, const Position& b) {
  Position d = unit(minus(b, a));
  std::size_t k = 0;
  while (d[k] == 0) ++k;
  if (d[k] < 0) d = {-d[0], -d[1], -d[2]};
  return {d[0], d[1], d[2], a[0] - a[k] * d[0], a[1] - a[k] * d[1], a[2] - a[k] * d[2], 0};
}

inline Position exact_position(const SpatialSum& sum, std::uint32_t v) {
  const RationalPoint3 x = sum.exact(v);
  return {exact::exact_value(x.x), exact::exact_value(x.y), exact::exact_value(x.z)};
}

struct Walls {
  Position low, high;
  explicit Walls(const ClipBox& box)
      : low{exact::exact_value(box.low.x), exact::exact_value(box.low.y), exact::exact_value(box.low.z)},
        high{exact::exact_value(box.high.x), exact::exact_value(box.high.y), exact::exact_value(box.high.z)} {}

  bool hold(const Position& x) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (x[k] < low[k] || x[k] > high[k]) return false;
    return true;
  }
  /// A convex polygon cut by all six.
  std::vector<Position> cut(std::vector<Position> polygon) const {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const bool from_below : {true, false}) {
        const auto height = [&](const Position& x) {
          return from_below ? Number(x[k] - low[k]) : Number(high[k] - x[k]);
        };
        std::vector<Position> rest;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
          const Position &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
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

inline void add(Chains& chains, const Key& plane, const Position& a, const Position& b, int sign) {
  if (a == b) return;
  std::map<Position, int>& line = chains[{plane, line_key(a, b)}];
  line[a] += sign, line[b] -= sign;
}

inline Position normal_of(const SpatialSum& sum, const std::vector<std::uint32_t>& loop) {
  const Position o = exact_position(sum, loop[0]);
  Position n{};
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const Position c = cross(minus(exact_position(sum, loop[k]), o), minus(exact_position(sum, loop[k + 1]), o));
    for (std::size_t i = 0; i < 3; ++i) n[i] += c[i];
  }
  return n;
}

inline Key plane_key(const SpatialSum& sum, const std::vector<std::uint32_t>& loop) {
  const Position n = unit(normal_of(sum, loop));
  return {n[0], n[1], n[2], dot(n, exact_position(sum, loop[0])), 0, 0, 0};
}

inline void add_cut(Chains& chains, const SpatialSum& sum, const Loops& loops, const Walls& walls) {
  const Key plane = plane_key(sum, loops[0]);
  const Position n{plane[0], plane[1], plane[2]}, o = exact_position(sum, loops[0][0]);
  for (const auto& loop : loops) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Position a = exact_position(sum, loop[k]), b = exact_position(sum, loop[(k + 1) % loop.size()]);
      const Position c = cross(minus(a, o), minus(b, o));
      if (is_zero(c)) continue;
      const int sign = dot(c, n) > 0 ? 1 : -1;
      if (sign < 0) std::swap(a, b);
      const std::vector<Position> piece = walls.cut({o, a, b});
      for (std::size_t i = 0; i < piece.size(); ++i) add(chains, plane, piece[i], piece[(i + 1) % piece.size()], sign);
    }
  }
}

inline void add_whole(Chains& chains, const SpatialSum& sum, const Loops& loops) {
  const Key plane = plane_key(sum, loops[0]);
  for (const auto& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      add(chains, plane, exact_position(sum, loop[k]), exact_position(sum, loop[(k + 1) % loop.size()]), 1);
}

inline Chains without_zeros(Chains chains) {
  for (auto line = chains.begin(); line != chains.end();) {
    std::erase_if(line->second, [](const auto& end) { return end.second == 0; });
    line = line->second.empty() ? chains.erase(line) : std::next(line);
  }
  return chains;
}

/// What tells a part of a sum: faces, tight faces, tight segments, tight points.
using Shape = std::tuple<Chains, Chains, Chains, std::vector<Position>>;

inline Shape cut(const SpatialSum& sum, const ClipBox& box) {
  const Walls walls(box);
  Chains faces, tight, segments;
  std::vector<Position> points;
  for (const SpatialFace& face : sum.faces) add_cut(faces, sum, face.loops, walls);
  for (const Loops& loops : sum.tight_faces) add_cut(tight, sum, loops, walls);
  for (const auto& [from, to] : sum.tight_segments) {
    const std::vector<Position> piece = walls.cut({exact_position(sum, from), exact_position(sum, to)});
    std::pair<Position, Position> ends;
    if (piece.empty()) continue;
    ends = {*std::min_element(piece.begin(), piece.end()), *std::max_element(piece.begin(), piece.end())};
    add(segments, {}, ends.first, ends.second, 1);
  }
  for (const std::uint32_t v : sum.tight_points)
    if (walls.hold(exact_position(sum, v))) points.push_back(exact_position(sum, v));
  std::sort(points.begin(), points.end());
  return {without_zeros(faces), without_zeros(tight), without_zeros(segments), points};
}

inline Shape shape_of(const SpatialSum& part) {
  Chains faces, tight, segments;
  std::vector<Position> points;
  for (const SpatialFace& face : part.faces) add_whole(faces, part, face.loops);
  for (const Loops& loops : part.tight_faces) add_whole(tight, part, loops);
  for (const auto& [from, to] : part.tight_segments)
    add(segments, {}, exact_position(part, from), exact_position(part, to), 1);
  for (const std::uint32_t v : part.tight_points) points.push_back(exact_position(part, v));
  std::sort(points.begin(), points.end());
  return {without_zeros(faces), without_zeros(tight), without_zeros(segments), points};
}

}  // namespace dymsum::clipped_chains
