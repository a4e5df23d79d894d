// The patches of a configuration-space obstacle as functions of the angle, in doubles with stated errors, and as ranges
// over intervals of angles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dymsum/cspace_obstacle.h"

namespace dymsum::apps {

/// All values between low and high.
struct Range {
  double low = 0, high = 0;
};
inline Range operator+(Range a, Range b) { return {a.low + b.low, a.high + b.high}; }
inline Range operator-(Range a, Range b) { return {a.low - b.high, a.high - b.low}; }
inline Range operator*(double a, Range b) {
  return a >= 0 ? Range{a * b.low, a * b.high} : Range{a * b.high, a * b.low};
}
Range operator*(Range a, Range b);
inline double magnitude(Range a) { return std::max(std::abs(a.low), std::abs(a.high)); }

struct PointRange {
  Range x, y;
};
inline PointRange operator+(const PointRange& a, const PointRange& b) { return {a.x + b.x, a.y + b.y}; }
inline PointRange operator-(const PointRange& a, const PointRange& b) { return {a.x - b.x, a.y - b.y}; }
inline PointRange operator*(Range a, const PointRange& b) { return {a * b.x, a * b.y}; }
inline Range cross(const PointRange& a, const PointRange& b) { return a.x * b.y - a.y * b.x; }
inline Range dot(const PointRange& a, const PointRange& b) { return a.x * b.x + a.y * b.y; }

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
  Point along;
  bool turns = false;
};

/// An end of a patch: a hinge, or the crossing with another line.
struct PatchEnd {
  bool corner = true;
  Hinge hinge;
  ContactLine other;
  /// Where both lines coincide at an end of the patch's angles, at `theta0`, the crossing is a quotient of zeros there;
  /// as a share of the own edge it is share0 + share1 tan((theta - theta0) / 2).
  bool coincides = false;
  double theta0 = 0, share0 = 0, share1 = 0;
};

/// Positions are relative to PatchForms::origin.
struct PatchForm {
  ContactLine own;
  PatchEnd left, right;
};

/// A stretch of a patch: angles [low, high] within (-pi, pi], up to one rounding.
struct PatchPiece {
  std::uint32_t patch = 0;
  double low = 0, high = 0;
};

/// A position in doubles; each coordinate errs by at most `error`, infinite where the lines look parallel.
struct PlacedEnd {
  Point at;
  double error = 0;
};

/// Positions, their derivatives by the angle.
struct MovingRange {
  PointRange at, speed;
  bool known = true;  ///< no where the crossing may run away: then the whole edge
};

class PatchForms {
 public:
  explicit PatchForms(const CspaceObstacle& obstacle);

  const std::vector<PatchForm>& forms() const { return forms_; }
  const PatchForm& operator[](std::uint32_t patch) const { return forms_[patch]; }
  Point origin() const { return origin_; }
  Point relative(Point v) const { return {v.x - origin_.x, v.y - origin_.y}; }
  /// No vertex of a slice is farther from the origin; no vertex of the robot is farther from the reference point than
  /// reach().
  double size() const { return size_; }
  double reach() const { return reach_; }
  /// More than event angles and the angles of questions err, together.
  double angle_margin() const { return angle_margin_; }

  /// Proved: lines that coincide somewhere are not taken for granted.
  PlacedEnd end(const PatchForm& form, const PatchEnd& end, const Turn& turn) const;
  /// The same, and with small errors everywhere, if lines that coincide within 2^-44 do so exactly.
  PlacedEnd end_at(const PatchForm& form, const PatchEnd& end, double theta, const Turn& turn) const;
  /// Of an end while the angle is within `half` of `theta`, without roundings; requires half <= 1. `turn` is by theta.
  MovingRange end_within(const PatchForm& form, const PatchEnd& end, double theta, const Turn& turn, double half) const;
  /// A box around a patch while the angle is within `half` of `theta`, roundings included.
  PointRange box(const PatchForm& form, double theta, double half) const;

  /// The stretches of a patch, none longer than `longest`.
  static void split(const CspaceObstacle& obstacle, std::uint32_t patch, double longest, std::vector<PatchPiece>& out);

 private:
  void find_coincidence(const CspaceObstacle& obstacle, const Patch& patch, const ContactLine& own,
                        PatchEnd& end) const;
  std::vector<PatchForm> forms_;
  Point origin_;
  double size_ = 0, reach_ = 0, angle_margin_ = 0x1p-46;
};

inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point place(const Hinge& h, const Turn& turn) { return h.a + turn * h.b; }
inline Point direction(const ContactLine& l, const Turn& turn) { return l.turns ? turn * l.along : l.along; }

/// A vector that turns with the angle, within `half` of where it is `at`; and its derivative.
PointRange turning(Point at, double half);
inline Point quarter(Point v) { return {-v.y, v.x}; }

}  // namespace dymsum::apps
