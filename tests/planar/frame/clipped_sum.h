// The slow answer: a whole planar sum, cut to a box in fractions.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "dymsum/planar_local_sum.h"
#include "exact/big.h"

namespace dymsum::clipped_sum {

using exact::BigRational;
using Position = std::array<BigRational, 2>;
using Segment = std::pair<Position, Position>;

/// Maximal directed segments of the boundary, tight ones to the right, tight points.
struct Shape {
  std::set<Segment> edges, tight;
  std::set<Position> points;
  friend bool operator==(const Shape&, const Shape&) = default;
  bool empty() const { return edges.empty() && tight.empty() && points.empty(); }
};

inline Position position(const RationalPoint& v) { return {exact::exact_value(v.x), exact::exact_value(v.y)}; }
inline Position position(Point v) { return {exact::exact_value(v.x), exact::exact_value(v.y)}; }

inline bool one_direction(const Segment& a, const Segment& b) {
  const BigRational ax = a.second[0] - a.first[0], ay = a.second[1] - a.first[1];
  const BigRational bx = b.second[0] - b.first[0], by = b.second[1] - b.first[1];
  return ax * by == ay * bx && ax * bx + ay * by > 0;
}

/// Segments in a row made one.
inline std::set<Segment> joined(std::set<Segment> list) {
  const auto join_one = [&] {
    for (const Segment& a : list)
      for (const Segment& b : list) {
        if (a.second != b.first || !one_direction(a, b)) continue;
        const Segment whole{a.first, b.second}, first = a, second = b;
        list.erase(first), list.erase(second), list.insert(whole);
        return true;
      }
    return false;
  };
  while (join_one()) continue;
  return list;
}

/// The piece with length in the box.
inline void add_cut(std::set<Segment>& list, const Position& a, const Position& b, const PlanarBox& box) {
  const Position low = position(box.low), high = position(box.high);
  BigRational from = 0, to = 1;
  for (std::size_t k = 0; k < 2; ++k) {
    const BigRational d = b[k] - a[k];
    if (d == 0) {
      if (a[k] < low[k] || a[k] > high[k]) return;
      continue;
    }
    BigRational s = (low[k] - a[k]) / d, t = (high[k] - a[k]) / d;
    if (s > t) std::swap(s, t);
    from = std::max(from, s), to = std::min(to, t);
  }
  if (!(from < to)) return;
  const auto at = [&](const BigRational& s) {
    return Position{BigRational(a[0] + s * (b[0] - a[0])), BigRational(a[1] + s * (b[1] - a[1]))};
  };
  list.insert({at(from), at(to)});
}

inline Shape cut(const PlanarSum& sum, const PlanarBox& box) {
  Shape shape;
  const auto add_ring = [&](const SumRing& ring) {
    for (std::size_t k = 0; k < ring.vertices.size(); ++k)
      add_cut(shape.edges, position(sum.exact(ring.vertices[k])),
              position(sum.exact(ring.vertices[(k + 1) % ring.vertices.size()])), box);
  };
  for (const SumPart& part : sum.parts) {
    add_ring(part.outer);
    for (const SumRing& hole : part.holes) add_ring(hole);
  }
  for (const SumSegment& s : sum.tight_segments)
    add_cut(shape.tight, position(sum.exact(s.from)), position(sum.exact(s.to)), box);
  const Position low = position(box.low), high = position(box.high);
  for (const SumVertex& v : sum.tight_points) {
    const Position at = position(sum.exact(v));
    if (at[0] >= low[0] && at[0] <= high[0] && at[1] >= low[1] && at[1] <= high[1]) shape.points.insert(at);
  }
  shape.edges = joined(std::move(shape.edges)), shape.tight = joined(std::move(shape.tight));
  return shape;
}

inline Shape shape_of(const PlanarLocalPart& part) {
  Shape shape;
  for (const PlanarLocalPart::Edge& e : part.edges)
    shape.edges.insert({position(part.exact(e.from)), position(part.exact(e.to))});
  for (const PlanarLocalPart::Edge& e : part.tight_segments)
    shape.tight.insert({position(part.exact(e.from)), position(part.exact(e.to))});
  for (const std::uint32_t v : part.tight_points) shape.points.insert(position(part.exact(v)));
  return shape;
}

/// What of a cut shape meets a closed disc.
inline Shape in_disc(Shape shape, const PlanarDisc& disc) {
  const Position m = position(disc.centre);
  const BigRational r = exact::exact_value(disc.radius);
  const auto off = [&](const Segment& s) {
    const BigRational dx = s.second[0] - s.first[0], dy = s.second[1] - s.first[1], size = dx * dx + dy * dy;
    BigRational t = 0;
    if (size > 0) t = ((m[0] - s.first[0]) * dx + (m[1] - s.first[1]) * dy) / size;
    t = std::clamp(t, BigRational(0), BigRational(1));
    const BigRational x = s.first[0] + t * dx - m[0], y = s.first[1] + t * dy - m[1];
    return x * x + y * y > r * r;
  };
  std::erase_if(shape.edges, off), std::erase_if(shape.tight, off);
  std::erase_if(shape.points, [&](const Position& v) { return off({v, v}); });
  return shape;
}

}  // namespace dymsum::clipped_sum
