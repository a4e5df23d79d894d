// Exact positions of a sum's vertices: where they come from, their signs and order, their nearest doubles, and what of
// a ring contains one.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/doubles.h"
#include "dymsum/planar_sum.h"
#include "exact/big.h"

namespace dymsum {

// The source of the exact positions of a sum's vertices: the contract between the engine, which knows the integer
// operands, and everything that happens after the boundary has been found.

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

namespace dymsum::planar {

// Exact signs of points given as rationals: order, orientation, and the position of a point against closed rings. The
// nearest doubles are tried first; they never decide unless their error bound proves the sign.

using Position = ExactSource::Position;
using Homogeneous = ExactSource::Homogeneous;

/// The position over the least common denominator.
Homogeneous homogeneous(const Position& p);
/// The position in lowest terms.
Position reduced(const Homogeneous& p);

/// The sign of a - b. (Boost's own comparison of rationals expands continued fractions.)
int compare(const exact::BigRational& a, const exact::BigRational& b);
/// Lexicographic order: -1, 0, 1.
int compare(const Position& a, const Position& b);

/// A position with its nearest doubles. Rounding to nearest is monotone: nearest coordinates that differ are in the
/// order of the exact ones.
struct Spot {
  Position exact;
  Point nearest;
};

Spot make_spot(Position p);
/// The spot at a double point. Requires: finite.
Spot make_spot(Point p);

int compare_x(const Spot& a, const Spot& b);
int compare_y(const Spot& a, const Spot& b);
/// Lexicographic order: -1, 0, 1.
int compare(const Spot& a, const Spot& b);
/// The sign of (b - a) x (c - a): 1 where c lies left of the directed line from a to b, 0 on it, -1 right.
int orientation(const Spot& a, const Spot& b, const Spot& c);
/// The same sign from the doubles alone, or 0 where their error bound does not decide.
int orientation_filtered(Point a, Point b, Point c);
/// True when c lies on the closed segment from a to b.
bool on_segment(const Spot& a, const Spot& b, const Spot& c);
/// True when the open segments a b and c d cross in one point.
bool cross_properly(const Spot& a, const Spot& b, const Spot& c, const Spot& d);

enum class Location { outside, boundary, inside };

/// The location of q against a closed ring of either orientation. O(n).
Location locate(std::span<const Spot> ring, const Spot& q);
/// The location of q against the set bounded by rings that do not cross (even-odd). O(n).
Location locate(const std::vector<std::vector<Spot>>& rings, const Spot& q);

// The nearest doubles of a sum's vertices: from one sum of doubles, from some thirty digits, or from the exact
// position, whichever decides first.

class NearestPoint {
 public:
  /// Requires that the source outlives this.
  explicit NearestPoint(const ExactSource& source);

  /// Both coordinates correctly rounded, infinite past the double range.
  Point operator()(const SumVertex& vertex) const;

 private:
  struct Frame {
    base::DoublePair unit, x, y;
  };
  const ExactSource& source_;
  std::optional<Frame> frame_;
};

// The rings of a sum, and those that they lie in.

/// A box that contains a ring's exact positions.
struct RingBox {
  double min_x, min_y, max_x, max_y;
};

RingBox box_of(const SumRing& ring, double at_error);
bool boxes_disjoint(const RingBox& a, const RingBox& b);

/// True when `inner` lies in the closed bounded side of `outer`. Requires: the two rings do not cross and differ; they
/// may touch at points. Doubles decide when a point of `inner` is clear of `outer`; positions of the source otherwise.
/// O(n + m); exact fallback O(n m) at worst, when all of inner's vertices lie on outer.
bool ring_contains(const SumRing& outer, const SumRing& inner, const ExactSource& source, double at_error);

}  // namespace dymsum::planar
