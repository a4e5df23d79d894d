#include "exact/root_field.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "exact/root_expression.h"

namespace dymsum::exact {

namespace {

/// Products of terms, each counted by the length of its factors in words, after which algebra gives up: some 20 ms.
constexpr std::size_t kMostWork = 1 << 20;
constexpr std::size_t kMostRoots = 32;

/// A sum of coefficient * product of the roots in the set; sets ascend, coefficients are not 0.
struct RootTerm {
  std::uint32_t roots = 0;
  BigInteger coefficient;
  friend bool operator==(const RootTerm&, const RootTerm&) = default;
};
using RootPolynomial = std::vector<RootTerm>;

/// Thrown within this file where an answer would take too long.
struct TooLong {};

RootPolynomial constant(BigInteger n) { return n.is_zero() ? RootPolynomial{} : RootPolynomial{{0, std::move(n)}}; }
bool is_constant(const RootPolynomial& p) { return p.empty() || (p.size() == 1 && p[0].roots == 0); }

/// The length of its first coefficient: the others are about as long.
std::size_t words_of(const RootPolynomial& p) {
  return p.empty() ? 0 : msb(boost::multiprecision::abs(p[0].coefficient)) / 64 + 1;
}

RootPolynomial combined(const RootPolynomial& p, const RootPolynomial& q, int sign) {
  RootPolynomial result;
  result.reserve(p.size() + q.size());
  std::size_t i = 0, j = 0;
  while (i < p.size() || j < q.size()) {
    if (j == q.size() || (i < p.size() && p[i].roots < q[j].roots)) {
      result.push_back(p[i++]);
    } else if (i == p.size() || q[j].roots < p[i].roots) {
      result.push_back(q[j++]);
      if (sign < 0) result.back().coefficient = -result.back().coefficient;
    } else {
      BigInteger c =
          sign < 0 ? BigInteger(p[i].coefficient - q[j].coefficient) : BigInteger(p[i].coefficient + q[j].coefficient);
      if (!c.is_zero()) result.push_back({p[i].roots, std::move(c)});
      ++i, ++j;
    }
  }
  return result;
}

/// The polynomial with these terms in any order.
RootPolynomial gathered(RootPolynomial terms) {
  std::sort(terms.begin(), terms.end(), [](const RootTerm& a, const RootTerm& b) { return a.roots < b.roots; });
  RootPolynomial result;
  for (RootTerm& term : terms) {
    if (!result.empty() && result.back().roots == term.roots) {
      result.back().coefficient += term.coefficient;
    } else {
      if (!result.empty() && result.back().coefficient.is_zero()) result.pop_back();
      result.push_back(std::move(term));
    }
  }
  if (!result.empty() && result.back().coefficient.is_zero()) result.pop_back();
  return result;
}

struct RootFraction {
  RootPolynomial num, den;
};

/// The tower. Every root is positive, and its square is made of earlier ones.
class RootField {
 public:
  RootPolynomial product(const RootPolynomial& p, const RootPolynomial& q);
  RootFraction root_of(const RootFraction& x);
  bool is_zero(const RootPolynomial& p);

 private:
  struct Root {
    RootPolynomial square;
    bool nested = false;
  };
  RootFraction root_of_integer(const BigInteger& n);
  void add_product(const RootTerm& a, const RootTerm& b, RootPolynomial& terms);
  Ball value(const RootPolynomial& p, unsigned precision, const std::vector<Ball>& roots) const;
  int sign_of_nonzero(const RootPolynomial& p) const;

  std::vector<Root> roots_;
  SquareClasses integers_;
  std::vector<std::uint32_t> root_of_member_;  // member of integers_ -> bit
  std::size_t work_ = 0;
};

void RootField::add_product(const RootTerm& a, const RootTerm& b, RootPolynomial& terms) {
  const std::uint32_t common = a.roots & b.roots;
  RootTerm term{a.roots ^ b.roots, a.coefficient * b.coefficient};
  bool nested = false;
  for (std::size_t k = 0; k < roots_.size(); ++k) {
    if ((common >> k & 1) == 0) continue;
    if (roots_[k].nested) nested = true;
    else term.coefficient *= roots_[k].square[0].coefficient;
  }
  if (!nested) {
    terms.push_back(std::move(term));
    return;
  }
  RootPolynomial p{std::move(term)};
  for (std::size_t k = 0; k < roots_.size(); ++k)
    if ((common >> k & 1) != 0 && roots_[k].nested) p = product(p, roots_[k].square);
  terms.insert(terms.end(), p.begin(), p.end());
}

RootPolynomial RootField::product(const RootPolynomial& p, const RootPolynomial& q) {
  work_ += p.size() * q.size() * (words_of(p) + words_of(q));
  if (work_ > kMostWork) throw TooLong{};
  RootPolynomial terms;
  terms.reserve(p.size() * q.size());
  for (const RootTerm& a : p)
    for (const RootTerm& b : q) add_product(a, b, terms);
  return p.size() == 1 && q.size() == 1 && terms.size() == 1 ? terms : gathered(std::move(terms));
}

// With n times the product m of members the square of s, sqrt(n) = s / sqrt(m) = s sqrt(m) / m.
RootFraction RootField::root_of_integer(const BigInteger& n) {
  const std::size_t known = integers_.members().size();
  const std::optional<SquareClasses::Relation> relation = integers_.add(n);
  if (!relation) throw TooLong{};
  if (integers_.members().size() > known) {
    if (roots_.size() == kMostRoots) throw TooLong{};
    root_of_member_.push_back(std::uint32_t{1} << roots_.size());
    roots_.push_back({constant(n), false});
    return {{{root_of_member_.back(), 1}}, constant(1)};
  }
  RootTerm term{0, relation->root};
  BigInteger members = 1;
  for (std::size_t k = 0; k < known; ++k) {
    if ((relation->members >> k & 1) == 0) continue;
    term.roots |= root_of_member_[k];
    members *= integers_.members()[k];
  }
  const BigInteger common = gcd(term.coefficient, members);
  term.coefficient /= common;
  return {{std::move(term)}, constant(BigInteger(members / common))};
}

// sqrt(N / D) = sqrt(N D) / D for D > 0.
RootFraction RootField::root_of(const RootFraction& x) {
  const RootPolynomial square = product(x.num, x.den);
  if (is_constant(square)) {
    RootFraction root = root_of_integer(square[0].coefficient);
    return {std::move(root.num), product(root.den, x.den)};
  }
  std::size_t k = 0;
  while (k < roots_.size() && roots_[k].square != square) ++k;
  if (k == kMostRoots) throw TooLong{};
  if (k == roots_.size()) roots_.push_back({square, true});
  return {{{std::uint32_t{1} << k, 1}}, x.den};
}

Ball RootField::value(const RootPolynomial& p, unsigned precision, const std::vector<Ball>& roots) const {
  Ball total;
  for (const RootTerm& term : p) {
    Ball v(term.coefficient, 0, 0, precision);
    for (std::size_t k = 0; k < roots_.size(); ++k)
      if (term.roots >> k & 1) v = Ball::product(v, roots[k], precision);
    total = Ball::sum(total, v, 1, precision);
  }
  return total;
}

int RootField::sign_of_nonzero(const RootPolynomial& p) const {
  for (unsigned precision = 128;; precision *= 2) {
    std::vector<Ball> roots;
    for (const Root& root : roots_) roots.push_back(Ball::root(value(root.square, precision, roots), precision));
    if (const std::optional<int> sign = value(p, precision, roots).sign()) return *sign;
  }
}

bool RootField::is_zero(const RootPolynomial& p) {
  std::uint32_t all = 0;
  for (const RootTerm& term : p) all |= term.roots;
  std::size_t top = roots_.size();
  while (top > 0 && ((all >> (top - 1) & 1) == 0 || !roots_[top - 1].nested)) --top;
  if (top == 0) return p.empty();
  const auto own = std::uint32_t{1} << (top - 1);
  RootPolynomial x, y;
  for (const RootTerm& term : p) {
    if ((term.roots & own) == 0) x.push_back(term);
    else y.push_back({term.roots ^ own, term.coefficient});
  }
  const bool no_x = is_zero(x), no_y = is_zero(y);
  if (no_x || no_y) return no_x && no_y;
  const RootPolynomial norm = combined(product(x, x), product(product(y, y), roots_[top - 1].square), -1);
  return is_zero(norm) && sign_of_nonzero(x) != sign_of_nonzero(y);
}

RootFraction fraction_of(const RootNode& node, const RootFraction& a, const RootFraction& b, RootField& field) {
  using Kind = RootNode::Kind;
  switch (node.kind) {
    case Kind::rational:
      return {constant(node.num), constant(node.den)};
    case Kind::product:
      return {field.product(a.num, b.num), field.product(a.den, b.den)};
    case Kind::quotient: {
      RootFraction q{field.product(a.num, b.den), field.product(a.den, b.num)};
      if (sign_of_node(*node.b).sign > 0) return q;
      return {combined({}, q.num, -1), combined({}, q.den, -1)};
    }
    case Kind::root:
      return field.root_of(a);
    default:
      break;
  }
  const int sign = node.kind == Kind::sum ? 1 : -1;
  if (a.den == b.den) return {combined(a.num, b.num, sign), a.den};
  return {combined(field.product(a.num, b.den), field.product(b.num, a.den), sign), field.product(a.den, b.den)};
}

}  // namespace

std::optional<bool> is_zero_by_algebra(const RootParts& parts) {
  try {
    RootField field;
    std::vector<RootFraction> values;
    values.reserve(parts.all().size());
    const RootFraction none;
    for (const RootParts::Part& part : parts.all()) {
      const bool leaf = part.node->is_rational();
      values.push_back(fraction_of(*part.node, leaf ? none : values[part.a], leaf ? none : values[part.b], field));
    }
    return field.is_zero(values.back().num);
  } catch (const TooLong&) {
    return std::nullopt;
  }
}

}  // namespace dymsum::exact
