#include "planar/local/feature_discs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dymsum::planar {

namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;
constexpr std::uint32_t kFeaturesInLeaf = 4;

/// In [0, a whole turn], up to rounding.
double wrapped(double angle) {
  const double rest = std::fmod(angle, kWholeTurn);
  return rest < 0 ? rest + kWholeTurn : rest;
}

/// A range that holds both: the shorter one of those that begin with either.
DirectionRange hull(const DirectionRange& a, const DirectionRange& b) {
  const double from_a = std::max(a.width, wrapped(b.first - a.first) + b.width);
  const double from_b = std::max(b.width, wrapped(a.first - b.first) + a.width);
  const DirectionRange range = from_a <= from_b ? DirectionRange{a.first, from_a} : DirectionRange{b.first, from_b};
  return {range.first, std::min(range.width, kWholeTurn)};
}

/// Halves are taken before the difference: it cannot overflow.
double half_distance(Point a, Point b) { return std::hypot(b.x / 2 - a.x / 2, b.y / 2 - a.y / 2); }
Point between(Point a, Point b) { return {a.x / 2 + b.x / 2, a.y / 2 + b.y / 2}; }

}  // namespace

bool may_meet(const DirectionRange& a, double turn, const DirectionRange& b, double slack) {
  const double ahead = wrapped(b.first - (a.first + turn));
  return ahead <= a.width + slack || kWholeTurn - ahead <= b.width + slack;
}

FeatureDiscs::FeatureDiscs(const Operand& operand, Of of, Point stretch)
    : operand_(operand), of_(of), stretch_(stretch) {
  for (std::uint32_t k = 0; k < operand.size(); ++k)
    if (of == Of::edges || operand.convex[k] != 0) items_.push_back(k);
  ranges_.resize(operand.size());
  for (const std::uint32_t k : items_) ranges_[k] = range_of(k);
  nodes_.reserve(items_.size());
  if (!items_.empty()) build(0, static_cast<std::uint32_t>(items_.size()));
}

double FeatureDiscs::angle_of(std::uint32_t edge) const {
  const Point a = at(edge), b = at(operand_.next[edge]);
  const double x = b.x - a.x, y = b.y - a.y, most = std::max(std::abs(x), std::abs(y));
  return std::atan2(y / most * stretch_.y, x / most * stretch_.x);
}

DirectionRange FeatureDiscs::range_of(std::uint32_t item) const {
  if (of_ == Of::edges) return {angle_of(item), 0};
  const double from = angle_of(operand_.prev[item]);
  return {from, wrapped(angle_of(item) - from)};
}

FeatureDiscs::Node FeatureDiscs::leaf_of(std::uint32_t item) const {
  Node node;
  const Point a = at(item), b = of_ == Of::edges ? at(operand_.next[item]) : a;
  node.middle = between(a, b);
  node.radius = half_distance(a, b);
  node.directions = directions(item);
  return node;
}

/// Features in the order of their walks: neighbours are near each other, and their directions too.
std::uint32_t FeatureDiscs::build(std::uint32_t first, std::uint32_t last) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node = leaf_of(items_[first]);
  double x0 = node.middle.x, x1 = x0, y0 = node.middle.y, y1 = y0;
  for (std::uint32_t k = first; k < last; ++k) {
    const Node one = leaf_of(items_[k]);
    node.directions = hull(node.directions, one.directions);
    for (const Point v : {at(items_[k]), of_ == Of::edges ? at(operand_.next[items_[k]]) : at(items_[k])})
      x0 = std::min(x0, v.x), x1 = std::max(x1, v.x), y0 = std::min(y0, v.y), y1 = std::max(y1, v.y);
  }
  node.middle = between({x0, y0}, {x1, y1});
  node.radius = half_distance({x0, y0}, {x1, y1}) * (1 + 0x1p-40);
  node.first = first, node.last = last;
  if (last - first > kFeaturesInLeaf) {
    const std::uint32_t half = first + (last - first) / 2;
    node.left = build(first, half), node.right = build(half, last);
  }
  nodes_[id] = node;
  return id;
}

}  // namespace dymsum::planar
