// Events that are not made: those of quarter turns at which more edges are aligned than there are, and those of
// lines that cross a segment at nearly the same places all through a window: most pairs of them keep their order.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cspace/events/near_angle.h"
#include "cspace/events/rotation_events.h"
#include "exact/int.h"

namespace dymsum::planar {

// Crowded quarter turns: orientations at which so many edges are aligned that a whole slice after the angle costs less
// than the events there. The coordinates of sums are integers then, so which events are theirs is known without
// polynomials.

/// The plane of sums at theta = quarter * pi / 2, in 64-bit integers.
class QuarterTurn {
 public:
  /// Whether coordinates are small enough, below 2^28 grid steps: sides have 60 bits, concurrencies 122.
  static bool representable(const TurningForms& forms);
  /// Requires representable(forms).
  QuarterTurn(const TurningForms& forms, int quarter);

  Heading heading() const { return heading_; }
  /// v on the line of s. Exact, as all of these.
  bool on_line(const WalkSegment& s, Pair v) const { return side(s, v) == 0; }
  /// The three lines have a point in common, or are parallel.
  bool concurrent(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c) const;
  /// Whether the coefficients of forms are exact in doubles: coordinates of at most 2^10 grid steps, whose differences,
  /// products and sums of products in TrigForm2 are multiples of 1/2 below 2^52.
  bool exact_forms() const { return exact_forms_; }
  /// Whether an exact form is zero here, and nowhere else within `width`. With d the first derivative that is not zero
  /// here, the m-th one, by Taylor's formula |f(u)| >= |u|^m / m! (|d| - |u| / (m + 1) max |f^(m + 1)|).
  bool zero_here_only(const TrigForm2& f, double width) const { return sign_beside(f, width) != 0; }
  bool zero_here_only(const TrigForm& f, double width) const {
    return zero_here_only(TrigForm2{f.a, f.b, f.g, 0, 0}, width);
  }
  /// The sign of such a form up to `width` after this angle, or before it for a negative width; 0 where
  /// zero_here_only() does not hold.
  int sign_beside(const TrigForm2& f, double width) const;
  /// Edge e of the rotating operand and edge f of the fixed one point in the same direction.
  bool aligned(std::uint32_t e, std::uint32_t f) const;

  /// Whether a form that is zero here has no other zero within `width` of this angle: by Taylor's formula,
  /// |f(u)| >= |u| (|f'| - |u| max |f''| / 2). `error` bounds that of the slope.
  bool only_zero(const TrigForm& f, double width, double error) const {
    return std::abs(f.slope(heading_)) > 0.5 * f.swing() * width + error;
  }
  bool only_zero(const TrigForm2& f, double width, double error) const {
    return std::abs(f.slope(heading_)) > 0.5 * f.bend() * width + error;
  }

 private:
  struct Vec {
    std::int64_t x = 0, y = 0;
  };
  Vec position(Pair v) const { return {at_[0][v.p].x + at_[1][v.q].x, at_[0][v.p].y + at_[1][v.q].y}; }
  Vec direction(const WalkSegment& s) const;
  std::int64_t side(const WalkSegment& s, Pair v) const;

  const TurningForms& forms_;
  Heading heading_;
  bool exact_forms_ = true;
  std::array<std::vector<Vec>, 2> at_;  // vertices, turned
};

struct CrowdedQuarter {
  QuarterTurn turn;
  Alignment pair;       ///< edges that are aligned there: one of many
  double per_edge = 0;  ///< how many are, per edge of the operands
};

/// The end of a window at which a whole slice is due, by one pair of edges of many that are aligned there.
struct CrowdedEnd {
  const QuarterTurn* turn = nullptr;  ///< null where coordinates are too large for it
  Alignment pair;
};

class CrowdedQuarters {
 public:
  /// None where coordinates are too large for QuarterTurn.
  CrowdedQuarters(const TurningForms& forms, const std::vector<Alignment>& alignments);
  /// The quarter turn at an end of a range; null where that is no crowded quarter turn.
  const CrowdedQuarter* at(int chart, double t) const;
  bool any() const {
    return std::any_of(quarters_.begin(), quarters_.end(), [](const auto& q) { return q.has_value(); });
  }

 private:
  std::array<std::optional<CrowdedQuarter>, 4> quarters_;
};

// A window whose ends may be crowded quarter turns, of which no event is made, or that may lie beside an angle at which
// much is aligned but for a rounding.

/// What radii and halves of parts of a window are widened by, relatively: far more than a dozen roundings of angles
/// below 8, as parts are not shorter than 2^-20.
inline constexpr double kWider = 1 + 0x1p-20;

class WindowEnds {
 public:
  WindowEnds(const EventWindow& window, const QuarterEnds& ends) : w_(window), ends_(ends) {}

  const QuarterTurn* low() const { return ends_.low; }
  const QuarterTurn* high() const { return ends_.high; }
  bool leaves_out_high() const { return ends_.high != nullptr || ends_.high_left_out; }
  double width() const { return w_.high - w_.low; }

  /// Whether a form with exact coefficients has its only zero in the window at an end.
  template <class Form>
  bool exactly_at_end(const Form& f) const {
    for (const QuarterTurn* end : {ends_.low, ends_.high})
      if (end != nullptr && end->exact_forms() && end->zero_here_only(f, width())) return true;
    return false;
  }
  /// Whether a form has its only zero in the window at an end, where `zero` tells exactly that it has one.
  template <class Form, class Zero>
  bool at_end(const Form& f, double error, Zero&& zero) const {
    if (exactly_at_end(f)) return true;
    for (const QuarterTurn* end : {ends_.low, ends_.high})
      if (end != nullptr && std::abs(f.at(end->heading())) <= error && end->only_zero(f, width(), error) && zero(*end))
        return true;
    return false;
  }
  /// The sign that a side, a cross product or a concurrency (TurningForms::concurrency) has in all of a window beside
  /// an angle at which much is aligned; else 0.
  int sign_beside(const WalkSegment& s, Pair v) const {
    return ends_.beside == nullptr ? 0 : sign_of(ends_.beside->side(s, v).polynomial());
  }
  int sign_beside(const WalkSegment& s, const WalkSegment& t) const {
    return ends_.beside == nullptr ? 0 : sign_of(ends_.beside->cross(s, t).polynomial());
  }
  int sign_beside(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c) const {
    if (ends_.beside == nullptr) return 0;
    const NearAngle& angle = *ends_.beside;
    const Pair start = TurningForms::start(a);
    return sign_of(difference_of_products(angle.side(b, start).polynomial(), angle.cross(a, c).polynomial(),
                                          angle.side(c, start).polynomial(), angle.cross(a, b).polynomial()));
  }

  /// Roots in the window, less those at a crowded end.
  std::vector<exact::AlgebraicRoot> roots(const exact::Polynomial& p) const {
    std::vector<exact::AlgebraicRoot> found = roots_in(p, w_.range.t_low, w_.range.t_high);
    if (leaves_out_high() && !found.empty() && exact::compare(found.back(), w_.range.t_high) == 0) found.pop_back();
    return found;
  }

 private:
  int sign_of(const NearPolynomial& p) const {
    const auto [low, high] = ends_.beside->range(w_.range);
    return sign_in(p, low, high);
  }

  const EventWindow& w_;
  QuarterEnds ends_;
};

/// The position at which the line of another segment crosses one.
struct LineCrossing {
  std::uint32_t other = 0;
  double low = 0, high = 0;  ///< of the parameter along the segment, at all angles
  std::uint32_t order = 0;   ///< of two with one number, other than 0, the lines keep their order along the segment
};

/// Whether parallel segments have the same direction.
inline bool same_direction(const TurningForms& forms, const WalkSegment& b, const WalkSegment& c) {
  const Point d = forms.edge(b.side, b.edge), e = forms.edge(c.side, c.edge);
  return forms.parallel(b, c) && d.x * e.x + d.y * e.y > 0;
}

class CrossingOrders {
 public:
  CrossingOrders(const EventWindow& window, const TurningForms& forms, const WindowEnds& ends)
      : w_(window), forms_(forms), ends_(ends) {}

  /// Numbers the crossings of segment i, which are sorted by `low`, where many of them overlap. In the order of their
  /// positions at the midpoint, neighbours that are never at one position within the window prove that of all between:
  /// places are continuous functions of the angle, as no line is parallel to the segment.
  void find(std::uint32_t i, std::vector<LineCrossing>& list) const;

 private:
  struct Position;
  void find(const WalkSegment& a, std::span<LineCrossing> run, std::uint32_t& orders) const;
  void sort_unclear(const WalkSegment& a, std::vector<Position>& positions) const;
  int order_beside_end(const WalkSegment& a, const Position& x, const Position& y) const;
  bool never_zero(const TrigForm2& g, double error) const;
  bool keep_order(const WalkSegment& a, const Position& x, const Position& y) const;

  const EventWindow& w_;
  const TurningForms& forms_;
  const WindowEnds& ends_;
};

}  // namespace dymsum::planar
