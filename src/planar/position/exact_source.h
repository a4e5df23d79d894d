// The source of the exact positions of a sum's vertices: the contract between the engine, which knows the integer
// operands, and everything that happens after the boundary has been found.
#pragma once

#include <memory>
#include <optional>

#include "base/double_pair.h"
#include "dymsum/planar_sum.h"
#include "exact/homogeneous_point.h"

namespace dymsum {

/// Exact positions of the vertices of one sum. The vertex's contacts and corner name the position; `at` is never read.
/// Requires: every vertex handed in was made by the engine that made this source. Implementations are immutable.
class ExactSource {
 public:
  struct Position {
    exact::BigRational x, y;
  };

  virtual ~ExactSource() = default;

  virtual Position position(const SumVertex& vertex) const = 0;

  using Homogeneous = exact::HomogeneousPoint;
  /// The same position without the greatest common divisors that lowest terms cost. The default requests position().
  virtual Homogeneous homogeneous(const SumVertex& vertex) const;

  /// What near() measures in: a position is origin + unit (x, y).
  struct NearFrame {
    exact::BigRational unit, x, y;
  };
  /// |x - exact| and |y - exact| are at most `error`, all in units; all numbers are below 2^404.
  struct NearPosition {
    base::DoublePair x, y;
    double error = 0;
  };
  /// Positions to some thirty digits, at the cost of a few operations on doubles. No frame where a source has none or
  /// its numbers are too large. near() requires that there is one.
  virtual std::optional<NearFrame> near_frame() const { return std::nullopt; }
  virtual NearPosition near(const SumVertex& vertex) const;
  /// The nearest doubles of a position where one rounding of doubles gives them: the sum of two vertices as they were
  /// given. Else nothing.
  virtual std::optional<Point> rounded_once(const SumVertex&) const { return std::nullopt; }

  /// The sign of x(a) - x(b), and of y(a) - y(b): -1, 0 or 1. The default compares positions; an engine overrides them
  /// where it can decide with fixed-width integers, because rectilinear sums ask this once or twice for every ring.
  virtual int compare_x(const SumVertex& a, const SumVertex& b) const;
  virtual int compare_y(const SumVertex& a, const SumVertex& b) const;
};

namespace planar {

/// What the rooms behind PlanarSum and SumOptions may do with them.
struct SumInternals {
  static const std::shared_ptr<const ExactSource>& source(const PlanarSum& sum) { return sum.source_; }
  static std::shared_ptr<const ExactSource>& source(PlanarSum& sum) { return sum.source_; }
  /// The number tier to use at least (29, 61, 512; above: arbitrary), for tests; 0 by itself.
  template <class Options>
  static int& min_tier_bits(Options& options) {
    return options.forced_tier.min_bits_;
  }
  template <class Options>
  static int min_tier_bits(const Options& options) {
    return options.forced_tier.min_bits_;
  }
};

/// True when two vertices have the same provenance, and therefore the same position.
inline bool same_position(const SumVertex& a, const SumVertex& b) {
  if (a.corner_p != SumVertex::kNone && a.corner_q != SumVertex::kNone)
    return a.corner_p == b.corner_p && a.corner_q == b.corner_q;
  return b.corner_p == SumVertex::kNone && a.in == b.in && a.out == b.out;
}

class VertexOrder {
 public:
  /// Requires |at - exact| <= at_error in each coordinate of every vertex that is compared.
  VertexOrder(const ExactSource& source, double at_error) : source_(source), slack_(2 * at_error) {}

  /// Lexicographic order of the exact positions: -1, 0, 1.
  int compare(const SumVertex& a, const SumVertex& b) const {
    if (const double d = a.at.x - b.at.x; d > slack_ || d < -slack_) return d > 0 ? 1 : -1;
    if (same_position(a, b)) return 0;
    if (slack_ == 0) return a.at.y != b.at.y ? (a.at.y > b.at.y ? 1 : -1) : 0;  // the doubles are the exact positions
    if (const int sign = source_.compare_x(a, b); sign != 0) return sign;
    if (const double d = a.at.y - b.at.y; d > slack_ || d < -slack_) return d > 0 ? 1 : -1;
    return source_.compare_y(a, b);
  }

  /// True when doubles prove that a lies to the right of b.
  bool provably_right(const SumVertex& a, const SumVertex& b) const { return a.at.x - b.at.x > slack_; }

 private:
  const ExactSource& source_;
  double slack_;  // subtraction rounds monotonically, so a computed difference above 2 at_error is above it exactly
};

}  // namespace planar

/// The exact positions behind a sum; null for a sum that was put together by hand. Setting it is for engines.
inline const std::shared_ptr<const ExactSource>& exact_source(const PlanarSum& sum) {
  return planar::SumInternals::source(sum);
}
inline std::shared_ptr<const ExactSource>& exact_source(PlanarSum& sum) { return planar::SumInternals::source(sum); }

}  // namespace dymsum
