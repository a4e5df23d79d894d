// Vectors round a vertex of many edges, in a hierarchy of balls: questions about the largest product with a vector, or
// about its sign, look at a few balls instead of all edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

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
