#include "exact/root_node.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "exact/root_field.h"

namespace dymsum::exact {

namespace {

/// The largest precision that a sign may ask for.
constexpr unsigned kLastPrecision = 1U << 28;

bool same_radicand(const RootNode& a, const RootNode& b) {
  return &a == &b || (a.is_rational() && b.is_rational() && a.num == b.num && a.den == b.den);
}

}  // namespace

RootParts::RootParts(const RootNode& node) { add(node); }

std::uint32_t RootParts::add(const RootNode& node) {
  // Expressions have a dozen parts: looking through them is cheaper than a table.
  for (std::uint32_t k = 0; k < parts_.size(); ++k)
    if (parts_[k].node == &node) return k;
  const std::uint32_t a = node.a ? add(*node.a) : 0, b = node.b ? add(*node.b) : 0;
  parts_.push_back({&node, a, b});
  return static_cast<std::uint32_t>(parts_.size() - 1);
}

std::uint64_t RootParts::separation_bits() const {
  std::vector<const RootNode*> radicands;
  for (const Part& part : parts_) {
    if (part.node->kind != RootNode::Kind::root) continue;
    const RootNode& radicand = *part.node->a;
    if (std::none_of(radicands.begin(), radicands.end(),
                     [&](const RootNode* r) { return same_radicand(*r, radicand); }))
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

/// From the first precision up; that the number is not zero, or the theorem, ends it.
int sign_by_precision(const RootNode& node) {
  const RootParts parts(node);
  std::optional<bool> zero;
  std::int64_t least = std::numeric_limits<std::int64_t>::min();
  for (unsigned precision = kFirstPrecision; precision <= kLastPrecision; precision *= 2) {
    const std::optional<Ball> value = parts.value(precision);
    if (const std::optional<int> sign = value ? value->sign() : std::nullopt) return *sign;
    if (precision == kFirstPrecision) {
      zero = is_zero_by_algebra(parts);
      if (zero && *zero) return 0;
      if (!zero) least = -static_cast<std::int64_t>(parts.separation_bits());
    }
    if (value && value->top() <= least) return 0;
  }
  throw std::length_error("RootExpression: a sign needs too many bits");
}

}  // namespace

SignAnswer sign_of_node(const RootNode& node) {
  if (node.is_rational()) return {node.num.sign(), Rung::filter};
  if (const std::optional<int> sign = sign_of(node.interval)) return {*sign, Rung::filter};
  return {sign_by_precision(node), Rung::big};
}

}  // namespace dymsum::exact
