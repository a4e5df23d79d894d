#include "exact/root_node.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "exact/root_field.h"

namespace dymsum::exact {

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

}  // namespace dymsum::exact
