// Ends of patches in doubles, against exact positions: within the error that is said, down to lines that are nearly
// parallel.
#include "cspace/queries/patch_forms.h"

#include <gtest/gtest.h>

#include "exact/big.h"
#include "oracles/random.h"

namespace dymsum::cspace {
namespace {

using exact::BigRational;
using Vector = std::array<BigRational, 2>;

BigRational exactly(double v) { return exact::exact_value(v); }

/// The rotation by 2 atan(t).
struct ExactTurn {
  BigRational c, s;
  explicit ExactTurn(double tangent) {
    const BigRational t = exactly(tangent);
    c = (1 - t * t) / (1 + t * t);
    s = 2 * t / (1 + t * t);
  }
  Vector operator*(Point v) const {
    return {BigRational(c * exactly(v.x) - s * exactly(v.y)), BigRational(s * exactly(v.x) + c * exactly(v.y))};
  }
};
Vector position_at(const Hinge& h, const ExactTurn& turn) {
  const Vector b = turn * h.b;
  return {BigRational(exactly(h.a.x) + b[0]), BigRational(exactly(h.a.y) + b[1])};
}
Vector along(const ContactLine& l, const ExactTurn& turn) {
  return l.turns ? turn * l.along : Vector{exactly(l.along.x), exactly(l.along.y)};
}
BigRational product(const Vector& a, const Vector& b) { return BigRational(a[0] * b[1] - a[1] * b[0]); }

Region ring(oracles::Random& random, double size) {
  RegionData data;
  data.parts.emplace_back();
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.7854 * (k + 0.3 * random.signed_unit()), r = k % 2 == 0 ? size : 0.4 * size;
    data.parts[0].outer.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return Region::create(std::move(data)).value();
}

TEST(PatchForms, ends_err_by_less_than_they_say_and_not_by_much_less) {
  oracles::Random random(34);
  double corners = 0, crossings = 0;
  for (int k = 0; k < 4; ++k) {
    const CspaceObstacle obstacle =
        CspaceObstacle::create(ring(random, k % 2 == 0 ? 1 : 0.125), ring(random, 1)).value();
    const PatchForms forms(obstacle);
    for (const PatchForm& form : forms.forms())
      for (const PatchEnd* end : {&form.left, &form.right})
        for (int i = 0; i < 12; ++i) {
          double t = random.signed_unit();
          // Towards the angle at which the two lines are parallel.
          if (const double parallel = std::tan(end->parallel / 2); end->mixed && i > 4 && std::abs(parallel) < 1)
            t = parallel + std::ldexp(random.signed_unit(), -3 * i);
          const ExactTurn turn(t);
          const PlacedEnd found = forms.end(form, *end, Turn(2 * std::atan(t)));
          if (!std::isfinite(found.error)) continue;
          Vector truth;
          if (end->corner) {
            truth = position_at(end->hinge, turn);
          } else {
            const Vector d = along(form.own, turn), e = along(end->other, turn), s = position_at(form.own.start, turn),
                         o = position_at(end->other.start, turn),
                         gap{BigRational(o[0] - s[0]), BigRational(o[1] - s[1])};
            const BigRational across = product(d, e);
            if (across == 0) continue;
            BigRational fraction = product(gap, e) / across;
            if (fraction < 0) fraction = 0;
            if (fraction > 1) fraction = 1;
            truth = {BigRational(s[0] + fraction * d[0]), BigRational(s[1] + fraction * d[1])};
          }
          const double off = std::max(exact::round_to_double(BigRational(abs(exactly(found.at.x) - truth[0]))),
                                      exact::round_to_double(BigRational(abs(exactly(found.at.y) - truth[1]))));
          double& most = end->corner ? corners : crossings;
          most = std::max(most, off / found.error);
        }
  }
  for (const double most : {corners, crossings}) {
    EXPECT_LE(most, 1) << corners << ' ' << crossings;
    EXPECT_GT(most, 1.0 / 256) << corners << ' ' << crossings;
  }
}

}  // namespace
}  // namespace dymsum::cspace
