#include "exact/root_expression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "exact/big.h"
#include "exact/root_field.h"

namespace dymsum::exact {
namespace {

/// Odd primes below 2^8, eight to a product below 2^64.
constexpr std::array<std::array<std::uint64_t, 8>, 4> kPrimes{{{67, 71, 73, 79, 83, 89, 97, 101},
                                                               {103, 107, 109, 113, 127, 131, 137, 139},
                                                               {149, 151, 157, 163, 167, 173, 179, 181},
                                                               {191, 193, 197, 199, 211, 223, 227, 229}}};

/// Bit k of the set tells that k is a square modulo the number.
struct Squares {
  std::array<std::uint64_t, 4> bits{};
  constexpr explicit Squares(std::uint64_t number) {
    for (std::uint64_t k = 0; k < number; ++k) bits[k * k % number / 64] |= std::uint64_t{1} << (k * k % number % 64);
  }
  constexpr bool has(std::uint64_t k) const { return (bits[k / 64] >> (k % 64) & 1) != 0; }
};

constexpr std::array<std::uint64_t, 8> kSieve{63, 11, 13, 17, 19, 23, 29, 31};
constexpr std::uint64_t product_of(const std::array<std::uint64_t, 8>& numbers) {
  std::uint64_t product = 1;
  for (const std::uint64_t n : numbers) product *= n;
  return product;
}

template <std::size_t... I>
constexpr std::array<Squares, 8> squares_of(const std::array<std::uint64_t, 8>& numbers, std::index_sequence<I...>) {
  return {Squares(numbers[I])...};
}
constexpr std::array<Squares, 8> squares_of(const std::array<std::uint64_t, 8>& numbers) {
  return squares_of(numbers, std::make_index_sequence<8>{});
}

std::uint64_t remainder(const BigInteger& n, std::uint64_t m) { return static_cast<std::uint64_t>(BigInteger(n % m)); }

/// n without its divisors p, modulo p.
std::uint64_t unit_part(BigInteger n, std::uint64_t p) {
  while (remainder(n, p) == 0) n /= p;
  return remainder(n, p);
}

}  // namespace

std::optional<BigInteger> root_of_square(const BigInteger& n) {
  if (n.is_zero()) return n;
  const auto twos = static_cast<unsigned>(lsb(n));
  if (twos % 2 != 0 || static_cast<std::uint64_t>(BigInteger((n >> twos) & 7)) != 1) return std::nullopt;
  static constexpr std::array<Squares, 8> kSquares = squares_of(kSieve);
  const std::uint64_t rest = remainder(n, product_of(kSieve));
  for (std::size_t i = 0; i < 8; ++i)
    if (!kSquares[i].has(rest % kSieve[i])) return std::nullopt;
  BigInteger left;
  BigInteger root = floor_root(n, left);
  if (!left.is_zero()) return std::nullopt;
  return root;
}

std::uint32_t square_characters(const BigInteger& n) {
  static constexpr std::array<std::array<Squares, 8>, 4> kSquares{squares_of(kPrimes[0]), squares_of(kPrimes[1]),
                                                                  squares_of(kPrimes[2]), squares_of(kPrimes[3])};
  std::uint32_t result = 0;
  for (std::size_t g = 0; g < 4; ++g) {
    const std::uint64_t rest = remainder(n, product_of(kPrimes[g]));
    for (std::size_t i = 0; i < 8; ++i) {
      const std::uint64_t p = kPrimes[g][i], k = rest % p;
      if (!kSquares[g][i].has(k != 0 ? k : unit_part(n, p))) result |= std::uint32_t{1} << (8 * g + i);
    }
  }
  return result;
}

// Each row is the word of the product of some members, and no two rows have the same lowest bit.
std::optional<SquareClasses::Relation> SquareClasses::add(const BigInteger& n) {
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (members_[k] == n) return Relation{std::uint32_t{1} << k, n};
  Row row{square_characters(n), 0};
  for (const Row& known : rows_) {
    if ((row.characters & (known.characters & -known.characters)) == 0) continue;
    row.characters ^= known.characters;
    row.members ^= known.members;
  }
  if (row.characters == 0) {
    BigInteger product = n;
    for (std::size_t k = 0; k < members_.size(); ++k)
      if (row.members >> k & 1) product *= members_[k];
    std::optional<BigInteger> root = root_of_square(product);
    if (!root) return std::nullopt;
    return Relation{row.members, std::move(*root)};
  }
  const auto own = std::uint32_t{1} << members_.size();
  row.members ^= own;
  rows_.push_back(row);
  members_.push_back(n);
  return Relation{own, n};
}

namespace {

/// The largest precision that a sign may request.
constexpr unsigned kLastPrecision = 1U << 28;

}  // namespace

bool has_same_value(const RootNode& a, const RootNode& b) {
  return &a == &b || (a.is_rational() && b.is_rational() && a.num == b.num && a.den == b.den);
}

RootParts::RootParts(const RootNode& node) {
  std::unordered_map<const RootNode*, std::uint32_t> positions;
  add(node, positions);
}

std::uint32_t RootParts::add(const RootNode& node, std::unordered_map<const RootNode*, std::uint32_t>& positions) {
  if (const auto known = positions.find(&node); known != positions.end()) return known->second;
  const std::uint32_t a = node.a ? add(*node.a, positions) : 0, b = node.b ? add(*node.b, positions) : 0;
  const auto own = static_cast<std::uint32_t>(parts_.size());
  parts_.push_back({&node, a, b});
  positions.emplace(&node, own);
  return own;
}

std::uint64_t RootParts::separation_bits() const {
  std::vector<const RootNode*> radicands;
  for (const Part& part : parts_) {
    if (part.node->kind != RootNode::Kind::root) continue;
    const RootNode& radicand = *part.node->a;
    if (std::none_of(radicands.begin(), radicands.end(),
                     [&](const RootNode* r) { return has_same_value(*r, radicand); }))
      radicands.push_back(&radicand);
  }
  const RootNode& e = *parts_.back().node;
  constexpr std::uint64_t kFar = std::numeric_limits<std::uint64_t>::max() / 4;
  if (radicands.size() > 40 || e.log_u >= (kFar >> radicands.size()) || e.log_l >= kFar) return kFar;
  return ((std::uint64_t{1} << radicands.size()) - 1) * e.log_u + e.log_l;
}

std::optional<Ball> RootParts::value(unsigned precision) const {
  using Kind = RootNode::Kind;
  std::vector<Ball> values;
  values.reserve(parts_.size());
  for (const Part& part : parts_) {
    const RootNode& node = *part.node;
    if (node.kind == Kind::rational) {
      Ball num(node.num, 0, 0, precision);
      values.push_back(node.den == 1 ? std::move(num)
                                     : *Ball::quotient(num, Ball(node.den, 0, 0, precision), precision));
      continue;
    }
    const Ball &a = values[part.a], &b = values[part.b];
    switch (node.kind) {
      case Kind::sum:
        values.push_back(Ball::sum(a, b, 1, precision));
        break;
      case Kind::difference:
        values.push_back(Ball::sum(a, b, -1, precision));
        break;
      case Kind::product:
        values.push_back(Ball::product(a, b, precision));
        break;
      case Kind::quotient: {
        std::optional<Ball> q = Ball::quotient(a, b, precision);
        if (!q) return std::nullopt;
        values.push_back(std::move(*q));
        break;
      }
      default:
        values.push_back(Ball::root(a, precision));
        break;
    }
  }
  return values.back();
}

namespace {

std::optional<int> sign_at(const RootParts& parts, unsigned precision) {
  const std::optional<Ball> value = parts.value(precision);
  return value ? value->sign() : std::nullopt;
}

NodeAnswer beyond_doubles(const RootNode& node) {
  using By = NodeAnswer::By;
  const RootParts parts(node);
  unsigned precision = kFirstPrecision;
  for (; precision <= kLastBeforeAlgebra; precision *= 2)
    if (const std::optional<int> sign = sign_at(parts, precision)) return {*sign, By::precision};
  const std::optional<bool> zero = is_zero_by_algebra(parts);
  if (zero && *zero) return {0, By::algebra};
  const std::int64_t least =
      zero ? std::numeric_limits<std::int64_t>::min() : -static_cast<std::int64_t>(parts.separation_bits());
  for (; precision <= kLastPrecision; precision *= 2) {
    const std::optional<Ball> value = parts.value(precision);
    if (const std::optional<int> sign = value ? value->sign() : std::nullopt) return {*sign, By::precision_at_last};
    if (value && value->top() <= least) return {0, By::bound};
  }
  throw std::length_error("RootExpression: a sign needs too many bits");
}

}  // namespace

NodeAnswer answer_of_node(const RootNode& node) {
  if (node.is_rational()) return {node.num.sign(), NodeAnswer::By::doubles};
  if (const std::optional<int> sign = sign_of(node.interval)) return {*sign, NodeAnswer::By::doubles};
  return beyond_doubles(node);
}

SignAnswer sign_of_node(const RootNode& node) {
  const NodeAnswer answer = answer_of_node(node);
  return {answer.sign, answer.by == NodeAnswer::By::doubles ? Rung::doubles : Rung::big};
}

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

namespace {

/// How tightly a formula holds together: sums 0, products 1, what never needs brackets 2.
struct Formula {
  std::string text;
  int strength = 2;
};

std::string at_least(const Formula& f, int strength) { return f.strength < strength ? "(" + f.text + ")" : f.text; }

Formula formula_of(const RootNode& node) {
  using Kind = RootNode::Kind;
  if (node.kind == Kind::rational) {
    const std::string num = node.num.str();
    // A minus binds like a sum: brackets in all other places.
    if (node.den == 1) return {num, node.num.sign() < 0 ? 0 : 2};
    return {num + "/" + node.den.str(), node.num.sign() < 0 ? 0 : 1};
  }
  const Formula a = formula_of(*node.a);
  if (node.kind == Kind::root) return {"sqrt(" + a.text + ")", 2};
  const Formula b = formula_of(*node.b);
  switch (node.kind) {
    case Kind::sum:
      return {a.text + " + " + (b.text[0] == '-' ? "(" + b.text + ")" : b.text), 0};
    case Kind::difference:
      if (node.a->is_rational() && node.a->num.is_zero()) return {"-" + at_least(b, 1), 0};
      return {a.text + " - " + at_least(b, 1), 0};
    case Kind::product:
      return {at_least(a, 1) + " * " + at_least(b, 2), 1};
    default:
      return {at_least(a, 1) + " / " + at_least(b, 2), 1};
  }
}

}  // namespace

std::string to_text(const RootExpression& a) { return formula_of(a.node()).text; }

}  // namespace dymsum::exact
