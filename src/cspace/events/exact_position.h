// Points of the plane of sums at the exact angle of an event, where coordinates are algebraic numbers: on which side of
// a segment's line they are, and where along it.
#pragma once

#include <array>
#include <optional>

#include "cspace/events/overlap_filter.h"
#include "cspace/events/rotation_events.h"
#include "planar/motion/orientation.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

/// Products and sums of polynomials in t = tan(theta / 2), up to degree 6.
exact::Polynomial product(const exact::Polynomial& p, const exact::Polynomial& q);
/// p + sign q.
exact::Polynomial sum_of(const exact::Polynomial& p, const exact::Polynomial& q, int sign);

/// The quotient of two polynomials in t, for its value at one angle.
struct Fraction {
  exact::Polynomial num, den;
};

/// A sum of two vertices, the position on the first of two segments where the other one's line crosses it, or the
/// midpoint between two such points.
struct ExactPosition {
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
  int chart() const { return angle_.chart; }
  Heading heading() const { return heading_; }  ///< of an angle within 2^-49
  int sign(const exact::Polynomial& p) const { return p.is_zero() ? 0 : exact::sign_at(angle_.t, p); }
  int sign(const Fraction& f) const { return sign(f.num) * sign(f.den); }
  int compare(const Fraction& x, const Fraction& y) const;
  /// num / den in doubles, within 2^-49 of max(1, |num / den|). Requires that den is not 0.
  double quotient(const exact::Polynomial& num, const exact::Polynomial& den) const;

  /// What positions in doubles err by, times the span: sums of vertices at the heading, whose angle errs by 2^-49; and
  /// crossings.
  static constexpr double kCornerNear = 0x1p-45, kCrossingNear = 0x1p-37;
  static_assert(kTurnedPosition + 0x1p-49 <= kCornerNear);
  /// The position in the forms' doubles, within these errors; nothing where the lines cross clearly off the first
  /// segment.
  std::optional<Point> near(const ExactPosition& z) const;
  /// (1 + t^2) d_s x (z - start_s), and (1 + t^2) d_s . (z - start_s): of degrees 2 over 0 for a corner, 4 over 2 for a
  /// crossing, 6 over 4 for a middle.
  Fraction side(const WalkSegment& s, const ExactPosition& z) const;
  Fraction along(const WalkSegment& s, const ExactPosition& z) const;
  Fraction length(const WalkSegment& s) const;  ///< (1 + t^2) d_s . d_s
  /// Sides and positions along, of points within 2^-37 of the span and edges turned by an angle within 2^-49, err by
  /// less than this times span and length1.
  static constexpr double kNear = 0x1p-35;
  static_assert(2 * kCrossingNear + kTurnedSide + 2 * 0x1p-49 <= kNear);
  /// The sign of side; in doubles where `near`, the position in them, decides.
  int side_sign(const WalkSegment& s, const ExactPosition& z, Point near) const;
  /// Whether the position is on the segment, ends included; `within` where it is known to be on its line.
  bool holds(const WalkSegment& s, const ExactPosition& z, Point near) const {
    return side_sign(s, z, near) == 0 && within(s, z, near);
  }
  bool within(const WalkSegment& s, const ExactPosition& z, Point near) const;
  /// The order along s: 1 where y comes after z.
  int order(const WalkSegment& s, const ExactPosition& y, Point y_near, const ExactPosition& z, Point z_near) const;
  /// d_s . (z - start_s) in doubles.
  double along_near(const WalkSegment& s, Point near) const {
    const Point from = forms_.position(TurningForms::start(s), heading_), d = forms_.direction(s, heading_);
    return d.x * (near.x - from.x) + d.y * (near.y - from.y);
  }
  bool same(const ExactPosition& y, const ExactPosition& z) const;
  /// The signs of d x e and d . e.
  int cross(const WalkSegment& d, const WalkSegment& e) const;
  int dot(const WalkSegment& d, const WalkSegment& e) const;
  bool antiparallel(const WalkSegment& d, const WalkSegment& e) const { return cross(d, e) == 0 && dot(d, e) < 0; }

 private:
  Fraction side(const WalkSegment& s, const ExactPosition::Simple& z) const;
  Fraction along(const WalkSegment& s, const ExactPosition::Simple& z) const;
  std::optional<Point> near(const ExactPosition::Simple& z) const;
  bool same(const ExactPosition::Simple& y, const ExactPosition& z) const;

  const TurningForms& forms_;
  ExactAngle angle_;
  mutable exact::RootBracket bracket_;  // of the angle, as narrow as was requested
  Heading heading_;
};

// A piece of the boundary between two angles, of a segment between those of its neighbours along the boundary: where it
// begins and ends on its line.

struct SubEdge {
  WalkSegment segment, left, right;
};

/// A parameter along a segment, and how much it may err.
struct Located {
  double t = 0, error = 0;
};
/// The position at which a segment is cut by another one, or meets it in a common pair of vertices at the given end:
/// the error is that at every angle within `turn` of h.
Located position_on(const TurningForms& forms, const WalkSegment& s, const WalkSegment& other, bool at_start, Heading h,
                    double turn = 0);

/// The position at which a sub-edge begins or ends along the line of s at the exact angle, times |d_s|^2 and (1 + t^2);
/// the limit from near angles where its neighbour's line comes to lie along its own. Nothing where these are parallel
/// at every angle, or apart at this one.
std::optional<Fraction> end_along(const SignsAt& signs, const WalkSegment& s, const SubEdge& e, bool at_end);

// The position in the plane of sums at which an event happens, and whether that position is provably covered.

/// The position in the forms' doubles at heading h: a vertex for vertex events, for three segments the crossing of the
/// two that are least parallel, for alignments the vertex between the two edges, for overlaps the start of the first
/// segment.
struct EventPosition {
  Point at;
  double sine = 1;  ///< at most that of the angle between the two segments: the position errs by its inverse
};
EventPosition position_of(const RotationEvent& event, const TurningForms& forms, Heading h);

/// Lines that cross at a smaller sine have no position that is known well enough.
inline constexpr double kPlacedSine = 0x1p-5;

/// Provably inside the obstacle, where nothing is visible; false for nearly parallel segments and uncertain angles. Of
/// a vertex event or three segments.
bool provably_covered(const RotationEvent& event, const TurningForms& forms, const OverlapFilter& filter);

// Exact signs at the angle of one event, where doubles leave something open.

/// Signs at the sides of the directions between which a segment exists: 1 inside, 0 where it begins or ends, -1 beyond.
/// It exists between both; at an angle, ends included, where neither is -1. Requires an edge at the vertex.
std::array<int, 2> existence_signs(const SignsAt& signs, const WalkSegment& s);
/// Whether a segment exists at the angle, or just begins or ends there.
bool exists_at(const SignsAt& signs, const RotationCatalog& catalog, const WalkSegment& s);

class EventSigns {
 public:
  EventSigns(RotationEvent& event, const TurningForms& forms, const RotationCatalog& catalog,
             const RotationRange& range)
      : event_(event), forms_(forms), catalog_(catalog), range_(range) {}

  /// Made when they are first requested.
  const SignsAt& exact() const {
    if (!exact_) exact_.emplace(forms_, ExactAngle{range_.chart, exact_root(event_, forms_, range_)});
    return *exact_;
  }
  /// Whether a segment exists at the angle and at all near ones; `unsure` only where it begins or ends there.
  RotationCatalog::Existence exists(const WalkSegment& s) const;
  /// What ends and starts at a pair, by this existence.
  RotationCatalog::Joint joint(Pair v) const;
  /// The sign just after the angle of a form that is zero there, its polynomial being p.
  int after(const exact::Polynomial& p) const;

 private:
  RotationEvent& event_;
  const TurningForms& forms_;
  const RotationCatalog& catalog_;
  const RotationRange& range_;
  mutable std::optional<SignsAt> exact_;
};

}  // namespace dymsum::planar
