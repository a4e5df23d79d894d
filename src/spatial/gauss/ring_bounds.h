// Vectors round a vertex of many edges, in a hierarchy of balls: questions about the largest product with a vector, or
// about its sign, look at a few balls instead of all edges.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

// The edge across whose arc a circle leaves a cell, for cells of at most eight edges: all sides at once, in floats.

/// A vertex's edges and the unit normals on their left, counter-clockwise, in floats. The last ones are repeated up to
/// eight, which changes nothing: a circle that goes round sees no change of sides there. More than eight are not kept:
/// not-a-numbers then, of which no side is proved.
struct alignas(32) RingOfEight {
  std::array<float, 8> x, y, z;
  std::array<std::uint32_t, 8> edge;
};
static_assert(sizeof(RingOfEight) == 128);

/// Where floats are certain of a side: normals, directions, three products and two sums each have relative errors of at
/// most 2^-24, in all at most 6 2^-24 of sum |n_i a_i| <= |a|, and what underflows is far below that.
constexpr double kFloatError = 0x1p-20;

constexpr std::uint32_t kNoEdge = ~std::uint32_t{0};

inline std::array<float, 3> in_floats(Vec3 a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// The sides of the circle of directions perpendicular to `along`.
struct EightSides {
  std::uint32_t left = 0;  ///< bit k: the normal on the left of edge k lies on the left
  bool proved = false;     ///< of all of them
  bool operator==(const EightSides&) const = default;
};

/// Requires, like all below: error >= kFloatError |along|.
inline EightSides eight_sides_one_by_one(const RingOfEight& ring, const std::array<float, 3>& along, float error) {
  EightSides sides{0, true};
  for (std::size_t k = 0; k < 8; ++k) {
    const float side = ring.x[k] * along[0] + ring.y[k] * along[1] + ring.z[k] * along[2];
    sides.left |= std::uint32_t{!std::signbit(side)} << k;
    sides.proved &= std::abs(side) > error;
  }
  return sides;
}

#if defined(__SSE2__)
/// The same.
inline EightSides eight_sides(const RingOfEight& ring, const std::array<float, 3>& along, float error) {
  const __m128 x = _mm_set1_ps(along[0]), y = _mm_set1_ps(along[1]), z = _mm_set1_ps(along[2]);
  const auto four = [&](std::size_t k) {
    return _mm_add_ps(_mm_add_ps(_mm_mul_ps(_mm_load_ps(&ring.x[k]), x), _mm_mul_ps(_mm_load_ps(&ring.y[k]), y)),
                      _mm_mul_ps(_mm_load_ps(&ring.z[k]), z));
  };
  const __m128 low = four(0), high = four(4), least = _mm_set1_ps(error), sign = _mm_set1_ps(-0.0F);
  const __m128 proved =
      _mm_and_ps(_mm_cmpgt_ps(_mm_andnot_ps(sign, low), least), _mm_cmpgt_ps(_mm_andnot_ps(sign, high), least));
  const int right = _mm_movemask_ps(low) | (_mm_movemask_ps(high) << 4);
  return {~static_cast<std::uint32_t>(right) & 0xFF, _mm_movemask_ps(proved) == 0xF};
}
#else
inline EightSides eight_sides(const RingOfEight& ring, const std::array<float, 3>& along, float error) {
  return eight_sides_one_by_one(ring, along, error);
}
#endif

/// The edge across whose arc the circle leaves the cell: the normal on the left of the edge lies on the left of the
/// circle, the one before it on the right. kNoEdge where floats cannot decide, or where there is none.
inline std::uint32_t leaving_edge(const RingOfEight& ring, const std::array<float, 3>& along, float error) {
  const auto [left, proved] = eight_sides(ring, along, error);
  const std::uint32_t exits = left & ~((left << 1) | (left >> 7));
  return proved && exits != 0 ? ring.edge[static_cast<std::size_t>(std::countr_zero(exits))] : kNoEdge;
}

class RingBounds {
 public:
  /// Vertices of fewer edges go without.
  static constexpr std::uint32_t kManyEdges = 32;

  RingBounds() = default;
  /// The bounds of unit vectors one after another round the ring.
  explicit RingBounds(std::span<const Vec3> vectors);

  bool empty() const { return balls_.empty(); }
  std::size_t bytes() const { return balls_.capacity() * sizeof(Ball); }

  /// Calls look(first, last) in order for runs of at most eight slots [first, last) one after another; slots that are
  /// not in one have products with `along` below `least` (computed in doubles or exact).
  template <class Look>
  void look_above(Vec3 along, double least, const Look& look) const {
    const double size = length(along) * kOutwards;
    descend(
        top_, 0, balls_of(top_), [&](const Ball& ball) { return dot(ball.centre, along) + ball.radius * size < least; },
        look);
  }

  /// No product with `along` is above this; where all are negative, the largest is at most four times as far below
  /// zero. `value(slot)` is the product.
  template <class Value>
  double above_all(Vec3 along, const Value& value) const {
    const double size = length(along) * kOutwards;
    double enough = dot(balls_[start_of(top_)].centre, along);
    for (std::uint32_t k = 1; k < balls_of(top_); ++k) {
      const double centre = dot(balls_[start_of(top_) + k].centre, along);
      enough = centre > enough ? centre : enough;
    }
    if (!(enough < 0)) return size;  // the products of a ball's vectors with it are as large on average
    enough *= 0.25;
    double most = -2 * size;
    const auto is_far = [&](const Ball& ball) {
      const double bound = dot(ball.centre, along) + ball.radius * size;
      if (bound > enough) return false;
      most = bound > most ? bound : most;
      return true;
    };
    descend(top_, 0, balls_of(top_), is_far, [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t k = first; k < last; ++k) most = value(k) > most ? value(k) : most;
    });
    return most;
  }

  /// The slot with the largest product.
  template <class Value>
  std::uint32_t largest(Vec3 along, const Value& value) const {
    const double size = length(along) * kOutwards;
    std::uint32_t best = 0;
    double most = value(0);
    const auto look = [&](std::uint32_t k) {
      const double v = value(k);
      if (v > most) best = k;
      most = v > most ? v : most;
    };
    for (std::uint32_t k = 0; k < balls_of(top_); ++k) look(balls_[start_of(top_) + k].first);
    descend(
        top_, 0, balls_of(top_), [&](const Ball& ball) { return dot(ball.centre, along) + ball.radius * size <= most; },
        [&](std::uint32_t first, std::uint32_t last) {
          for (std::uint32_t k = first; k < last; ++k) look(k);
        });
    return best;
  }

  /// Calls run(first, last, sign) in order for all slots, in runs; `sign` is that of all exact products with `along`,
  /// which is within `error` of the exact vector, or 0 for at most eight slots whose signs are to be looked at. Stops
  /// when run returns true.
  template <class Run>
  void signs(Vec3 along, double error, const Run& run) const {
    bool done = false;
    const double size = length(along) * kOutwards;
    const auto is_uniform = [&](const Ball& ball) {
      if (done) return true;
      const double at = dot(ball.centre, along), reach = ball.radius * size + error;
      if (!(at > reach) && !(at < -reach)) return false;
      done = run(ball.first, ball.last, at > 0 ? 1 : -1);
      return true;
    };
    descend(top_, 0, balls_of(top_), is_uniform, [&](std::uint32_t first, std::uint32_t last) {
      if (!done) done = run(first, last, 0);
    });
  }

 private:
  /// Roundings of lengths and products.
  static constexpr double kOutwards = 1 + 0x1p-40;
  struct Ball {
    Vec3 centre;
    double radius;
    std::uint32_t first, last;  // slots
  };
  std::uint32_t start_of(std::uint32_t level) const { return starts_[level]; }
  std::uint32_t balls_of(std::uint32_t level) const { return starts_[level + 1] - starts_[level]; }

  /// The balls [begin, end) of a level: those that skip(ball) does not settle are taken apart.
  template <class Skip, class Leaf>
  void descend(std::uint32_t level, std::uint32_t begin, std::uint32_t end, const Skip& skip, const Leaf& leaf) const {
    for (std::uint32_t k = begin; k < end; ++k) {
      const Ball& ball = balls_[start_of(level) + k];
      if (skip(ball)) continue;
      if (level == 0) {
        leaf(ball.first, ball.last);
      } else {
        const std::uint32_t below = balls_of(level - 1);
        descend(level - 1, 8 * k, 8 * k + 8 < below ? 8 * k + 8 : below, skip, leaf);
      }
    }
  }

  std::vector<Ball> balls_;  // level by level, the smallest ones first: each of at most eight of the level below
  std::array<std::uint32_t, 12> starts_{};  // of the levels; one more at the end. 8^11 slots are enough
  std::uint32_t top_ = 0;                   // the last level, of at most eight balls
};

}  // namespace dymsum::spatial
