// The patches of a configuration-space obstacle as functions of the angle, in doubles with stated errors, and as ranges
// over intervals of angles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/doubles.h"
#include "dymsum/cspace_obstacle.h"
#include "dymsum/region.h"
#include "exact/rounding_bound.h"

namespace dymsum::cspace {

// Intervals of numbers and of points. Roundings are not in them: who uses them adds a margin.

/// All values between low and high.
struct Range {
  double low = 0, high = 0;
};
inline Range operator+(Range a, Range b) { return {a.low + b.low, a.high + b.high}; }
inline Range operator-(Range a, Range b) { return {a.low - b.high, a.high - b.low}; }
inline Range operator*(double a, Range b) {
  return a >= 0 ? Range{a * b.low, a * b.high} : Range{a * b.high, a * b.low};
}
inline Range operator*(Range a, Range b) {
  const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
  return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
}
inline Range operator+(double a, Range b) { return {a + b.low, a + b.high}; }
inline Range join(Range a, Range b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }
inline Range clamp(Range a, double low, double high) {
  return {std::clamp(a.low, low, high), std::clamp(a.high, low, high)};
}
inline Range between(double a, double b) { return {std::min(a, b), std::max(a, b)}; }
/// The square of the number nearest to 0.
inline double least_square(Range a) { return a.low > 0 ? a.low * a.low : a.high < 0 ? a.high * a.high : 0; }
inline double magnitude(Range a) { return std::max(std::abs(a.low), std::abs(a.high)); }

struct PointRange {
  Range x, y;
};
inline PointRange operator+(const PointRange& a, const PointRange& b) { return {a.x + b.x, a.y + b.y}; }
inline PointRange operator-(const PointRange& a, const PointRange& b) { return {a.x - b.x, a.y - b.y}; }
inline PointRange operator*(Range a, const PointRange& b) { return {a * b.x, a * b.y}; }
inline Range cross(const PointRange& a, const PointRange& b) { return a.x * b.y - a.y * b.x; }
inline Range dot(const PointRange& a, const PointRange& b) { return a.x * b.x + a.y * b.y; }

/// A vector that turns by an angle of at most `half` either way; requires half <= 1.
inline PointRange turning(Point v, double half) {
  const Range c{1 - half * half / 2, 1}, s{-half, half};
  return {v.x * c + -v.y * s, v.y * c + v.x * s};
}

using base::DoublePair;

/// (cosine, sine) of an angle.
struct Turn {
  double c = 1, s = 0;
  explicit Turn(double theta) : c(std::cos(theta)), s(std::sin(theta)) {}
  Point operator*(Point v) const { return {c * v.x - s * v.y, s * v.x + c * v.y}; }
};

/// a + R(theta) b: a corner of the boundary while it lasts.
struct Hinge {
  Point a, b;
};

/// The line of a contact: from `start` along `along`, which turns with theta where `turns`; the edge ends at factor 1.
struct ContactLine {
  Hinge start;
  Point along, unit;
  double length = 0;
  bool turns = false;
};

/// An end of a patch: a hinge, or the crossing with another line. Where along the edge that is, as a length from its
/// start: at a hinge always `at`. A crossing of two lines that both turn or both do not is at
/// constant + cosine cos(theta) + sine sin(theta), up to `error` where they are nearly parallel. Else the lines are
/// parallel at `parallel` and half a turn later, and with psi = theta - parallel - k pi it is at constant - tangent
/// tan(psi / 2) + gap[k] / sin(psi). There the gap, the distance of the lines while they are parallel, has its relative
/// accuracy, and is 0 exactly where they coincide. Where it is short the crossing runs fast; then `half_tangent` tells
/// the parallel angle more exactly: its tan(parallel / 2), and that of the angle less half a turn.
struct PatchEnd {
  bool corner = true;
  Hinge hinge;
  double at = 0;
  ContactLine other;
  bool mixed = false;
  double constant = 0, cosine = 0, sine = 0, error = 0, tangent = 0, parallel = 0;
  std::array<double, 2> gap{};
  std::array<DoublePair, 2> half_tangent{};
  /// Any fraction is right: more angles are kept with more digits.
  static constexpr double kFastFraction = 0x1p-13;
  bool fast(int k, double length) const {
    const double g = std::abs(gap[static_cast<std::size_t>(k)]);
    return g != 0 && g < kFastFraction * length;
  }
};

/// Positions are relative to PatchForms::origin, all lengths in its units.
struct PatchForm {
  ContactLine own;
  PatchEnd left, right;
};

/// An interval of a patch: angles [low, high] within (-pi, pi], up to one rounding.
struct PatchPiece {
  std::uint32_t patch = 0;
  double low = 0, high = 0;
};

/// More than event angles (kAngleDouble, and the width of their intervals) and the angles of questions (8 u) err,
/// together.
inline constexpr double kAngleMargin = exact::rounding_bound(2 * 12 + 8, 128);

/// A position in doubles; each coordinate errs by at most `error`, infinite where the lines look parallel.
struct PlacedEnd {
  Point at;
  double error = 0;
};

class PatchForms {
 public:
  explicit PatchForms(const CspaceObstacle& obstacle);

  const std::vector<PatchForm>& forms() const { return forms_; }
  const PatchForm& operator[](std::uint32_t patch) const { return forms_[patch]; }
  Point origin() const { return origin_; }
  Point relative(Point v) const { return in_units({v.x - origin_.x, v.y - origin_.y}); }
  /// Units are a power of two, at most 1, for which no square of a length that matters underflows.
  double in_units(double length) const { return per_unit_ * length; }
  Point in_units(Point v) const { return {per_unit_ * v.x, per_unit_ * v.y}; }
  double unit() const { return 1 / per_unit_; }
  /// No vertex of a slice is farther from the origin; no vertex of the robot is farther from the reference point than
  /// reach().
  double size() const { return size_; }
  double reach() const { return reach_; }
  /// kAngleMargin, or twice the width of an event angle's interval.
  double angle_margin() const { return angle_margin_; }

  /// Proved: lines that coincide somewhere are not taken for granted.
  PlacedEnd end(const PatchForm& form, const PatchEnd& end, const Turn& turn) const;
  /// A box around a patch while the angle is within `half` of `theta`, roundings included.
  PointRange box(const PatchForm& form, double theta, double half) const;

  /// The intervals of a patch, none longer than `longest`.
  static void split(const CspaceObstacle& obstacle, std::uint32_t patch, double longest, std::vector<PatchPiece>& out);

 private:
  std::vector<PatchForm> forms_;
  Point origin_;
  double per_unit_ = 1;
  double size_ = 0, reach_ = 0, angle_margin_ = kAngleMargin;
};

inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point position(const Hinge& h, const Turn& turn) { return h.a + turn * h.b; }
inline Point direction(const ContactLine& l, const Turn& turn) { return l.turns ? turn * l.along : l.along; }

inline Point quarter(Point v) { return {-v.y, v.x}; }

// The position along its edge at which a patch ends, as a function of the angle near a reference: with derivatives, as
// ranges over intervals, and with errors. theta = reference + x.

/// The cosine and the sine of an x with |x| <= 1/2, each to 2^-52.
struct SmallRotation {
  double c = 1, s = 0;
  explicit SmallRotation(double x) {
    const double y = x * x;
    c = 1 - y / 2 * (1 - y / 12 * (1 - y / 30 * (1 - y / 56 * (1 - y / 90 * (1 - y / 132 * (1 - y / 182))))));
    s = x * (1 - y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72 * (1 - y / 110 * (1 - y / 156 * (1 - y / 210)))))));
  }
};

/// The number k of half turns at which `end` (a mixed crossing) has the angle theta nearest to parallel + k pi.
int nearest_parallel(const PatchEnd& end, double theta);
double parallel_angle(const PatchEnd& end, int k);

class EndCurve {
 public:
  EndCurve() = default;
  /// The curve around a reference angle.
  EndCurve(const PatchEnd& end, double length, double reference);
  /// The curve of a mixed crossing; the reference is its k-th parallel angle plus `psi`, which errs by 2^-50 of itself.
  EndCurve(const PatchEnd& end, double length, int k, double psi);

  bool constant() const { return kind_ == Kind::constant; }
  double value(const SmallRotation& x) const { return std::clamp(raw(x), 0.0, length_); }
  struct Derivatives {
    double value = 0, first = 0, second = 0;
  };
  /// The curve's position on the edge.
  Derivatives derivatives(const SmallRotation& x) const;
  /// The range on the edge, for x between a and b, |a|, |b| <= 1/2.
  Range range(double a, double b) const;
  struct Ranges {
    Range value, first, second;
    bool known = false;  ///< no where the crossing may run away
    double error = 0;    ///< more than the value errs anywhere
    double scale = 0;    ///< no term of it is larger that does not belong to a pole
  };
  Ranges ranges(double a, double b) const;
  /// More than value() errs.
  double error(const SmallRotation& x) const;
  /// The part of [a, b] where the crossing may be on the edge; [a, b] itself where that is no interval.
  Range possible(double a, double b) const;

 private:
  enum class Kind : std::uint8_t { constant, wave, pole };
  struct Sines {  // of psi, and how much they err relatively
    double c = 1, s = 0;
  };
  Sines psi(const SmallRotation& x) const { return {cosine_ * x.c - sine_ * x.s, sine_ * x.c + cosine_ * x.s}; }
  double raw(const SmallRotation& x) const;
  void set_pole(const PatchEnd& end, int k, double psi);
  double error_at(double sine) const;
  bool across_pole(const Sines& a, const Sines& b) const { return gap_ != 0 && !(a.s * b.s > 0); }

  Kind kind_ = Kind::constant;
  bool exact_ = false;  // pole: psi has its relative accuracy
  double length_ = 0, constant_ = 0;
  double first_ = 0, second_ = 0;           // wave: factors of cos x and sin x; pole: of -tan(psi / 2) and 1 / sin(psi)
  double gap_ = 0;                          // pole: second_
  double psi_ = 0, cosine_ = 1, sine_ = 0;  // pole: psi at the reference
  double slack_ = 0;                        // absolute errors of the coefficients
};

// How far a line of the obstacle and a line that turns with the robot are apart while they are parallel: zero is
// determined exactly, anything else keeps its relative accuracy. Near such an angle their crossing runs along the lines
// as the quotient of this distance and the angle.

/// The gaps, for unit vectors u along the fixed edge and m along the rotating one and any corner of theirs that moves
/// along: cross(corner_of_fixed - fixed start, u) +- cross(turning start - corner_of_turning, m); the plus sign first,
/// which stands for equal directions. `corner` is the obstacle's vertex on the turning line, `hand` the robot's on the
/// fixed one. They are within 2^-50 of the value, or 2^-90 of the largest coordinate where those span more than 2^100.
using CrossingGaps = std::array<double, 2>;
CrossingGaps crossing_gaps(const std::array<Point, 2>& fixed, const std::array<Point, 2>& turning, Point corner,
                           Point hand);

/// tan(phi / 2) of the angle from a to b, and of that angle less half a turn: each within 2^-98 where it is at most 1.
std::array<DoublePair, 2> half_tangents(const std::array<Point, 2>& a, const std::array<Point, 2>& b);

}  // namespace dymsum::cspace
