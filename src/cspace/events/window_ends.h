// A window whose ends may be crowded quarter turns, of which no event is made, or that may lie beside an angle at which
// much is aligned but for a rounding.
#pragma once

#include <cmath>
#include <vector>

#include "cspace/events/near_angle.h"
#include "cspace/events/quarter_turn.h"

namespace dymsum::planar {

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

}  // namespace dymsum::planar
