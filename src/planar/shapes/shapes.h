// What the generators of shapes and solids are made of.
#pragma once

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "dymsum/region.h"

namespace dymsum::shapes {

/// x -> the multiple of `step` nearest to x, ties up; x itself where `step` is 0. Throws std::invalid_argument, with
/// the shape's name, for a step that is neither 0 nor a power of two from 2^-1000 to 2^1000.
class Snap {
 public:
  Snap(std::string_view shape, double step) : step_(step) {
    int exponent = 0;
    const bool power = step >= 0x1p-1000 && step <= 0x1p1000 && std::frexp(step, &exponent) == 0.5;
    if (step != 0 && !power) throw std::invalid_argument(std::string(shape) + ": snap is 0 or a power of two");
  }
  double operator()(double x) const { return step_ == 0 ? x : std::floor(x / step_ + 0.5) * step_; }

 private:
  double step_;
};

// The source of the generators' numbers: exact circle points, random bits, grids, smooth outlines. Only +, -, *, / and
// square roots, all of which IEEE rounds correctly: the same arguments give the same bits everywhere.

/// The point at k/n of a full turn on the unit circle, within a few units of the last place; exact on the axes, and
/// exactly
/// symmetric about both axes and the diagonals. Requires n > 0, 0 <= k < n.
/// It is ((1 - t^2)/(1 + t^2), 2t/(1 + t^2)) with t the tangent of half the angle from the nearest axis.
Point circle_point(std::int64_t k, std::int64_t n);

/// splitmix64 (Steele, Lea, Flood 2014): the state is the seed.
class Bits {
 public:
  explicit Bits(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  /// Uniform in [0, 1), a multiple of 2^-53.
  double unit();
  /// Uniform in [low, high) up to rounding.
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Uniform in [0, n), up to a bias of n / 2^64. Requires n > 0.
  std::uint64_t below(std::uint64_t n) { return next() % n; }

 private:
  std::uint64_t state_;
};

/// The multiple of 2^-bits nearest to x (ties up).
double on_grid(double x, int bits);
Ring on_grid(Ring ring, int bits);
/// The number of grid bits after the point that gives coordinates of this size 24 significant bits.
int grid_bits(double size);

/// The region of one ring with holes. Broken contracts (arguments that give no valid region) throw
/// std::invalid_argument
/// naming the shape.
Region made(std::string_view shape, Ring outer, std::vector<Ring> holes = {});
/// The same for the condition alone.
void require(bool condition, std::string_view shape);

/// `count` points evenly spaced, measured along the outline's chords, on the closed Catmull-Rom curve through it.
Ring smooth(const Ring& outline, int count);
/// The outline followed by its mirror image in the y axis, in the opposite order; points on the axis are not doubled.
Ring mirrored(const Ring& right_half);
Ring scaled_ring(Ring ring, double factor);
/// Reverses a ring that runs clockwise.
Ring counter_clockwise(Ring ring);

}  // namespace dymsum::shapes
