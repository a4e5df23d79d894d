#include "spatial/family/turn_order.h"

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
constexpr double kTurn = 2 * std::numbers::pi;

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

TurnOrder::TurnOrder(const RotationCircle& circle, std::optional<AxisTurn> from, std::optional<AxisTurn> to)
    : circle_(circle), from_(std::move(from)), to_(std::move(to)) {}

double TurnOrder::ahead(double radians, bool below_zero) const {
  // Beside pi doubles do not tell which end of a whole turn is near.
  if (!from_)
    return radians + std::numbers::pi + (below_zero && radians > 0 ? -kTurn : !below_zero && radians < 0 ? kTurn : 0);
  double by = radians - from_->radians(circle_.axis());
  while (by < -kUnsure) by += kTurn;
  while (by >= kTurn - kUnsure) by -= kTurn;
  return by;
}

std::optional<BigRational> TurnOrder::seen_in(int chart, const AxisTurn& turn) const {
  const ChartPosition at = circle_.position(turn);
  if (at.chart == chart) return at.t;
  if (at.t.is_zero()) return std::nullopt;
  return BigRational(-1 / (at.t * circle_.square()));
}

int TurnOrder::compare(const AxisTurn& a, const AxisTurn& b) const {
  const ChartPosition at = circle_.position(b);
  const std::optional<BigRational> t = seen_in(at.chart, a);
  return t ? exact::compare(*t, at.t) : 1;
}

double TurnOrder::ahead(const AxisTurn& turn) const { return ahead(turn.radians(circle_.axis()), turn.t().sign() < 0); }

double TurnOrder::ahead(const SolidRotationEvent& event) const {
  // Behind half a turn, in chart 1, t is positive: there angles are below zero.
  const int root = -compare_with_root(0, event.parameter);
  return ahead(event.approx, event.parameter.opposite ? root > 0 : root < 0);
}

bool TurnOrder::holds(const AxisTurn& turn) const {
  if (!from_) return true;
  const double by = ahead(turn), all = ahead(*to_);
  if (std::abs(by) <= 2 * kUnsure && compare(turn, *from_) < 0) return false;
  return by < all - 2 * kUnsure || (by <= all + 2 * kUnsure && compare(turn, *to_) <= 0);
}

int TurnOrder::compare(const AxisTurn& turn, const SolidRotationEvent& event) const {
  const double by = ahead(turn), at = ahead(event);
  if (by < at - 4 * kUnsure) return -1;
  if (by > at + 4 * kUnsure) return 1;
  const std::optional<BigRational> t = seen_in(event.parameter.opposite ? 1 : 0, turn);
  return t ? compare_with_root(*t, event.parameter) : 1;
}

}  // namespace dymsum::spatial
