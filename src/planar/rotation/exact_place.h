// Points of the plane of sums at the exact angle of an event, where coordinates are algebraic numbers: on which side of a segment's line
// they are, and where along it.
#pragma once

#include <optional>

#include "planar/rotation/obstacle_state.h"
#include "planar/rotation/turning_forms.h"

namespace dymsum::planar {

/// Products and sums of polynomials in t = tan(theta / 2), up to degree 6.
exact::Polynomial product(const exact::Polynomial& p, const exact::Polynomial& q);
/// p + sign q.
exact::Polynomial sum_of(const exact::Polynomial& p, const exact::Polynomial& q, int sign);

/// The quotient of two polynomials in t, for its value at one angle.
struct Fraction {
  exact::Polynomial num, den;
};

/// A sum of two vertices, the crossing of the lines of two segments, or the middle between two such points.
struct ExactPlace {
  struct Simple {
    bool crossing = false;
    Pair corner;
    WalkSegment a, b;  ///< not parallel at the angle
  };
  Simple first;
  std::optional<Simple> second;
};

/// Exact signs at one angle.
class SignsAt {
 public:
  SignsAt(const TurningForms& forms, const ExactAngle& angle);

  const TurningForms& forms() const { return forms_; }
  Heading heading() const { return heading_; }  ///< of an angle within 2^-49
  int sign(const exact::Polynomial& p) const { return p.is_zero() ? 0 : exact::sign_at(angle_.t, p); }
  int sign(const Fraction& f) const { return sign(f.num) * sign(f.den); }
  int compare(const Fraction& x, const Fraction& y) const;

  /// The place in the forms' doubles, within 2^-37 of the span; nothing where the lines are nearly parallel.
  std::optional<Point> near(const ExactPlace& z) const;
  /// (1 + t^2) d_s x (z - start_s), and (1 + t^2) d_s . (z - start_s): of degrees 2 over 0 for a corner, 4 over 2 for a crossing, 6 over
  /// 4 for a middle.
  Fraction side(const WalkSegment& s, const ExactPlace& z) const;
  Fraction along(const WalkSegment& s, const ExactPlace& z) const;
  Fraction length(const WalkSegment& s) const;  ///< (1 + t^2) d_s . d_s
  /// The sign of side; in doubles where `near` tells.
  int side_sign(const WalkSegment& s, const ExactPlace& z, const std::optional<Point>& near) const;
  /// On the segment, ends included.
  bool holds(const WalkSegment& s, const ExactPlace& z, const std::optional<Point>& near) const;
  bool same(const ExactPlace& y, const ExactPlace& z) const;
  /// The signs of d x e and d . e.
  int cross(const WalkSegment& d, const WalkSegment& e) const;
  int dot(const WalkSegment& d, const WalkSegment& e) const;
  bool antiparallel(const WalkSegment& d, const WalkSegment& e) const { return dot(d, e) < 0 && cross(d, e) == 0; }

 private:
  Fraction side(const WalkSegment& s, const ExactPlace::Simple& z) const;
  Fraction along(const WalkSegment& s, const ExactPlace::Simple& z) const;
  std::optional<Point> near(const ExactPlace::Simple& z) const;
  bool same(const ExactPlace::Simple& y, const ExactPlace& z) const;

  const TurningForms& forms_;
  const ExactAngle& angle_;
  Heading heading_;
};

}  // namespace dymsum::planar
