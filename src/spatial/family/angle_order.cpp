#include "spatial/family/angle_order.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "exact/big.h"

namespace dymsum::spatial {
namespace {

using exact::BigInteger;
using exact::BigRational;

/// Angles in doubles are within 2^-44 of what they stand for.
constexpr double kUnsure = 0x1p-40;
constexpr double kCircle = 2 * std::numbers::pi;

int sign_at(const std::vector<std::string>& polynomial, const BigRational& t) {
  BigRational value = 0;
  for (std::size_t k = polynomial.size(); k-- > 0;) value = value * t + BigRational(BigInteger(polynomial[k]));
  return value.sign();
}

/// The sign of t less the root.
int compare_with_root(const BigRational& t, const AlgebraicTurn& root) {
  if (root.t_low == root.t_high) return exact::compare(t, exact::exact_value(root.t_low));
  // An end may be infinite past the range of doubles.
  if (std::isfinite(root.t_low) && t <= exact::exact_value(root.t_low)) return -1;
  if (std::isfinite(root.t_high) && t >= exact::exact_value(root.t_high)) return 1;
  const int here = sign_at(root.polynomial, t);
  if (here == 0) return 0;
  // The root is simple, and the only one between the ends.
  if (std::isfinite(root.t_low)) return here == sign_at(root.polynomial, exact::exact_value(root.t_low)) ? -1 : 1;
  return here == sign_at(root.polynomial, exact::exact_value(root.t_high)) ? 1 : -1;
}

}  // namespace

AngleOrder::AngleOrder(const RotationCircle& circle, std::optional<ChartPosition> from, std::optional<ChartPosition> to)
    : circle_(circle), from_(std::move(from)), to_(std::move(to)) {}

double AngleOrder::ahead(double radians, bool below_zero) const {
  // Beside pi doubles do not tell which end of the circle is near.
  if (!from_)
    return radians + std::numbers::pi +
           (below_zero && radians > 0    ? -kCircle
            : !below_zero && radians < 0 ? kCircle
                                         : 0);
  double by = radians - circle_.radians(from_->chart, exact::round_to_double(from_->t));
  while (by < -kUnsure) by += kCircle;
  while (by >= kCircle - kUnsure) by -= kCircle;
  return by;
}

std::optional<BigRational> AngleOrder::seen_in(int chart, const ChartPosition& theta) const {
  if (theta.chart == chart) return theta.t;
  if (theta.t.is_zero()) return std::nullopt;
  return BigRational(-1 / (theta.t * circle_.square()));
}

int AngleOrder::compare(const ChartPosition& a, const ChartPosition& b) const {
  const std::optional<BigRational> t = seen_in(b.chart, a);
  return t ? exact::compare(*t, b.t) : 1;
}

double AngleOrder::ahead(const ChartPosition& theta) const {
  const double radians = std::remainder(circle_.radians(theta.chart, exact::round_to_double(theta.t)), kCircle);
  return ahead(radians, theta.chart == 0 ? theta.t < 0 : theta.t > 0);
}

double AngleOrder::ahead(const SolidRotationEvent& event) const {
  // Behind half a turn, in chart 1, t is positive: there angles are below zero.
  const int root = -compare_with_root(0, event.parameter);
  return ahead(event.approx, event.parameter.opposite ? root > 0 : root < 0);
}

bool AngleOrder::holds(const ChartPosition& theta) const {
  if (!from_) return true;
  const double by = ahead(theta), all = ahead(*to_);
  if (std::abs(by) <= 2 * kUnsure && compare(theta, *from_) < 0) return false;
  return by < all - 2 * kUnsure || (by <= all + 2 * kUnsure && compare(theta, *to_) <= 0);
}

int AngleOrder::compare(const ChartPosition& theta, const SolidRotationEvent& event) const {
  const double by = ahead(theta), at = ahead(event);
  if (by < at - 4 * kUnsure) return -1;
  if (by > at + 4 * kUnsure) return 1;
  const std::optional<BigRational> t = seen_in(event.parameter.opposite ? 1 : 0, theta);
  return t ? compare_with_root(*t, event.parameter) : 1;
}

}  // namespace dymsum::spatial
