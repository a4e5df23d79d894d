#include "exact/root_expression.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "exact/root_node.h"
#include "exact/square_class.h"

namespace dymsum::exact {

namespace {

using Kind = RootNode::Kind;
using NodePointer = std::shared_ptr<const RootNode>;

/// Rational parts longer than this stay formulas.
constexpr std::uint64_t kLongest = 1 << 14;

std::uint64_t bits_of(const BigInteger& positive) { return static_cast<std::uint64_t>(msb(positive)) + 1; }
/// max(|n|, 1) <= 2^result.
std::uint64_t log_of(const BigInteger& n) {
  const BigInteger magnitude = boost::multiprecision::abs(n);
  return magnitude <= 1 ? 0 : bits_of(BigInteger(magnitude - 1));
}

/// num / den in lowest terms, den > 0.
NodePointer rational_node(BigInteger num, BigInteger den) {
  auto node = std::make_shared<RootNode>();
  node->log_u = log_of(num);
  node->log_l = log_of(den);
  node->interval = den == 1 ? Interval(num) : Interval(num) / Interval(den);
  node->num = std::move(num);
  node->den = std::move(den);
  return node;
}
/// Divides both by their greatest common divisor. Requires b > 0.
void cancel(BigInteger& a, BigInteger& b) {
  if (b == 1) return;
  const BigInteger common = gcd(a, b);
  if (common != 1) a /= common, b /= common;
}
// Common divisors of short numbers take less time than those of long ones (Knuth, TAOCP 2, 4.5.1): with both fractions
// in lowest terms, a and d, c and b make all of a c / b d; a prime that divides a d' + c b' and b d', with b = b' g and
// d = d' g, divides g.
NodePointer product_of_fractions(BigInteger a, BigInteger b, BigInteger c, BigInteger d) {
  cancel(a, d);
  cancel(c, b);
  return rational_node(BigInteger(a * c), BigInteger(b * d));
}
NodePointer sum_of_fractions(const BigInteger& a, const BigInteger& b, const BigInteger& c, const BigInteger& d) {
  BigInteger common = b == d ? b : b == 1 || d == 1 ? BigInteger(1) : BigInteger(gcd(b, d));
  if (common == 1) return rational_node(BigInteger(a * d + c * b), BigInteger(b * d));
  const BigInteger b_part = b / common, d_part = d / common;
  BigInteger num = a * d_part + c * b_part;
  cancel(num, common);
  return rational_node(std::move(num), BigInteger(b_part * d_part * common));
}
const NodePointer& zero_node() {
  static const NodePointer node = rational_node(0, 1);
  return node;
}

bool is_zero(const RootNode& a) { return a.is_rational() && a.num.is_zero(); }

NodePointer operation_node(Kind kind, const NodePointer& a, const NodePointer& b, const Interval& interval) {
  auto node = std::make_shared<RootNode>();
  node->kind = kind;
  node->a = a;
  node->b = b;
  node->interval = interval;
  const std::uint64_t ua = a->log_u, la = a->log_l, ub = b ? b->log_u : 0, lb = b ? b->log_l : 0;
  switch (kind) {
    case Kind::product:
      node->log_u = ua + ub, node->log_l = la + lb;
      break;
    case Kind::quotient:
      node->log_u = ua + lb, node->log_l = la + ub;
      break;
    case Kind::root:
      node->log_u = ua >= la ? (ua + la + 1) / 2 : ua;
      node->log_l = ua >= la ? la : (ua + la + 1) / 2;
      break;
    default:
      node->log_u = is_zero(*a) ? ub : std::max(ua + lb, la + ub) + 1;
      node->log_l = la + lb;
      break;
  }
  return node;
}

bool is_short(const RootNode& a, const RootNode& b) {
  return a.is_rational() && b.is_rational() && a.log_u + a.log_l + b.log_u + b.log_l <= kLongest;
}
bool is_one(const RootNode& a) { return a.is_rational() && a.num == 1 && a.den == 1; }

NodePointer sum_node(const NodePointer& a, const NodePointer& b, int sign) {
  if (is_zero(*b)) return a;
  if (is_zero(*a) && sign > 0) return b;
  if (is_short(*a, *b)) return sum_of_fractions(a->num, a->den, BigInteger(sign * b->num), b->den);
  if (sign < 0 && a == b) return zero_node();
  return operation_node(sign < 0 ? Kind::difference : Kind::sum, a, b,
                        sign < 0 ? a->interval - b->interval : a->interval + b->interval);
}

NodePointer product_node(const NodePointer& a, const NodePointer& b) {
  if (is_zero(*a) || is_zero(*b)) return zero_node();
  if (is_one(*a)) return b;
  if (is_one(*b)) return a;
  if (is_short(*a, *b)) {
    if (a == b) return rational_node(BigInteger(a->num * a->num), BigInteger(a->den * a->den));
    return product_of_fractions(a->num, a->den, b->num, b->den);
  }
  if (a->kind == Kind::root && b->kind == Kind::root && has_same_value(*a->a, *b->a)) return a->a;
  return operation_node(Kind::product, a, b, a == b ? square(a->interval) : a->interval * b->interval);
}

NodePointer root_node(const NodePointer& a) {
  const int sign = sign_of_node(*a).sign;
  if (sign < 0) throw std::domain_error("RootExpression: the root of a negative number");
  if (sign == 0) return zero_node();
  if (!a->is_rational()) return operation_node(Kind::root, a, nullptr, sqrt(a->interval));
  std::optional<BigInteger> num = root_of_square(a->num), den = root_of_square(a->den);
  if (num && den) return rational_node(std::move(*num), std::move(*den));
  if (a->den == 1) return operation_node(Kind::root, a, nullptr, sqrt(a->interval));
  if (den) return product_node(rational_node(1, std::move(*den)), root_node(rational_node(a->num, 1)));
  // sqrt(n / d) = sqrt(n d) / d: the same root for more numbers.
  return product_node(rational_node(1, a->den), root_node(rational_node(BigInteger(a->num * a->den), 1)));
}

/// 64 good bits, or exactly 0.
Ball narrow_ball(const RootExpression& a) {
  if (sign_of(a) == 0) return {};
  const RootParts parts(a.node());
  for (unsigned precision = kFirstPrecision;; precision *= 2) {
    const std::optional<Ball> value = parts.value(precision);
    if (value && value->is_narrow(64)) return *value;
  }
}

}  // namespace

RootExpression::RootExpression() : node_(zero_node()) {}
RootExpression::RootExpression(double v) : RootExpression(exact_value(v)) {}
RootExpression::RootExpression(const BigInteger& v) : node_(rational_node(v, 1)) {}
RootExpression::RootExpression(const BigRational& v) : node_(rational_node(numerator(v), denominator(v))) {}

RootExpression operator-(const RootExpression& a) {
  if (a.node_->is_rational()) return RootExpression(rational_node(BigInteger(-a.node_->num), a.node_->den));
  return RootExpression() - a;
}
RootExpression operator+(const RootExpression& a, const RootExpression& b) {
  return RootExpression(sum_node(a.node_, b.node_, 1));
}
RootExpression operator-(const RootExpression& a, const RootExpression& b) {
  return RootExpression(sum_node(a.node_, b.node_, -1));
}
RootExpression operator*(const RootExpression& a, const RootExpression& b) {
  return RootExpression(product_node(a.node_, b.node_));
}
RootExpression operator/(const RootExpression& a, const RootExpression& b) {
  const NodePointer &x = a.node_, &y = b.node_;
  if (sign_of(b) == 0) throw std::domain_error("RootExpression: division by zero");
  if (is_zero(*x) || is_one(*y)) return a;
  if (is_short(*x, *y)) {
    const int sign = y->num.sign();
    return RootExpression(product_of_fractions(x->num, x->den, BigInteger(sign * y->den), BigInteger(sign * y->num)));
  }
  return RootExpression(operation_node(Kind::quotient, x, y, x->interval / y->interval));
}
RootExpression sqrt(const RootExpression& a) { return RootExpression(root_node(a.node_)); }

const Interval& RootExpression::interval() const { return node_->interval; }

SignAnswer sign_answer(const RootExpression& a) { return sign_of_node(a.node()); }

SignAnswer compare_answer(const RootExpression& a, const RootExpression& b) {
  if (a.interval().low() > b.interval().high()) return {1, Rung::doubles};
  if (a.interval().high() < b.interval().low()) return {-1, Rung::doubles};
  if (&a.node() == &b.node()) return {0, Rung::doubles};
  return {sign_of(a - b), Rung::big};
}

Interval narrow_interval(const RootExpression& a) {
  const Interval& known = a.interval();
  if (known.is_point() || std::nextafter(known.low(), known.high()) == known.high()) return known;
  return narrow_ball(a).rounded_outwards();
}

// The ends of a narrow interval two steps apart are so because the number is close to the double between them: nearer
// than 2^-64 of itself. Next to each other, their midpoint decides.
double nearest_double(const RootExpression& a) {
  const Interval near = narrow_interval(a);
  if (near.is_point()) return near.low();
  if (near.is_whole()) {
    const double infinity = std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::max();
    const RootExpression threshold(exact_value(most) + exact_value(0x1p970));
    return compare(a, threshold) >= 0 ? infinity : compare(a, -threshold) <= 0 ? -infinity : sign_of(a) * most;
  }
  const double step = std::nextafter(near.low(), near.high());
  if (step != near.high()) return step;
  const BigRational midpoint = (exact_value(near.low()) + exact_value(near.high())) / 2;
  const int side = compare(a, RootExpression(midpoint));
  return side == 0 ? round_to_double(midpoint) : (side > 0 ? near.high() : near.low()) + 0.0;
}

}  // namespace dymsum::exact
