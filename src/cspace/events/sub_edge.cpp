#include "cspace/events/sub_edge.h"

#include <cmath>

#include "cspace/events/walk_indices.h"

namespace dymsum::planar {

using exact::Polynomial;

Located position_on(const TurningForms& forms, const WalkSegment& s, const WalkSegment& other, bool at_start, Heading h,
                    double turn) {
  if (at_start ? meet_at_ends(forms, other, s) : meet_at_ends(forms, s, other)) return {at_start ? 0.0 : 1.0, 0};
  const TrigForm side = forms.side(other, TurningForms::start(s)), cross = forms.cross(s, other);
  const double d = cross.at(h), t = side.at(h) / d;
  // The numerator and the denominator err by their bounds, and change by their swings: of lines that may be parallel
  // doubles know nothing. Other roundings are less than what the bounds grant beyond what they count.
  const double n_error = forms.side_error(other) + turn * side.swing(),
               d_error = kTurnedCross * forms.length1(s) * forms.length1(other) + turn * cross.swing(),
               size = std::abs(d) - d_error;
  return {t, size > 0 ? (n_error + std::abs(t) * d_error) / size : INFINITY};
}

// The start of its segment and a fraction of its vector, which is a crossing's side / cross. Where the crossing line
// runs along this one at the angle, both are zero and their derivatives tell the limit.
std::optional<Fraction> end_along(const SignsAt& signs, const WalkSegment& s, const SubEdge& e, bool at_end) {
  const TurningForms& forms = signs.forms();
  const int chart = signs.chart();
  const WalkSegment &t = e.segment, &by = at_end ? e.right : e.left;
  const Pair start = TurningForms::start(t), end = forms.end(t);
  const Polynomial one(std::vector<exact::Big>{exact::Big(exact::BigInteger(1))});
  if (at_end && meet_at_ends(forms, t, by))
    return Fraction{forms.exact_along(s, TurningForms::start(s), end, chart), one};
  const Polynomial base = forms.exact_along(s, TurningForms::start(s), start, chart);
  if (!at_end && meet_at_ends(forms, by, t)) return Fraction{base, one};
  Polynomial side = forms.exact_side(by, start, chart), cross = forms.exact_cross(t, by, chart);
  if (signs.sign(cross) == 0) {
    if (signs.sign(side) != 0) return std::nullopt;
    side = side.derivative();
    cross = cross.derivative();
    if (signs.sign(cross) == 0) return std::nullopt;
  }
  return Fraction{sum_of(product(base, cross), product(side, forms.exact_along(s, start, end, chart)), 1), cross};
}

}  // namespace dymsum::planar
