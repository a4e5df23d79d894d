#include "planar/frame/near_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "exact/grid.h"
#include "planar/motion/orientation.h"

namespace dymsum::planar {

using exact::BigInteger;
using exact::BigRational;

int compare(const BigPosition& a, const BigPosition& b, int axis) {
  const Big left = (axis == 0 ? a.x : a.y) * b.w, right = (axis == 0 ? b.x : b.y) * a.w;
  return left < right ? -1 : right < left ? 1 : 0;
}

bool same_position(const BigPosition& a, const BigPosition& b) {
  return compare(a, b, 0) == 0 && compare(a, b, 1) == 0;
}

BigPosition halfway(const BigPosition& a, const BigPosition& b) {
  return {a.x * b.w + b.x * a.w, a.y * b.w + b.y * a.w, Big::from_int64(2) * a.w * b.w};
}

BigRational LocalUnit::value(const Big& n, const Big& w) const {
  const BigInteger power = BigInteger(1) << static_cast<unsigned>(std::abs(exponent));
  const BigRational v = exact::ratio(n, Big(BigInteger(w.value() * den)));
  return exponent < 0 ? BigRational(v / power) : BigRational(v * power);
}

double LocalUnit::rounded(const Big& n, const Big& w) const {
  const unsigned shift = static_cast<unsigned>(std::abs(exponent));
  const BigInteger below = w.value() * den;
  return exponent < 0 ? exact::round_to_double(n.value(), BigInteger(below << shift))
                      : exact::round_to_double(BigInteger(n.value() << shift), below);
}

RationalPoint LocalUnit::point(const BigPosition& position) const {
  return {exact::to_rational(value(position.x, position.w)), exact::to_rational(value(position.y, position.w))};
}

namespace {

/// 2^top is more than all coordinates of the operand where it stands, in magnitude.
int top_of(const Operand& o, const PlanarPose& pose) {
  double most = 0;
  for (const Point& v : o.points->input) most = std::max({most, std::abs(v.x), std::abs(v.y)});
  const double factor = std::max(pose.scale[0].approx(), pose.scale[1].approx());
  return most > 0 ? std::ilogb(most) + std::ilogb(factor) + 3 : std::numeric_limits<int>::min() / 2;
}

void lower_to(int& exponent, double v) {
  if (v != 0) exponent = std::min(exponent, exact::to_dyadic(v).exponent);
}

double quotient(const BigInteger& n, const BigInteger& d) { return exact::round_to_double(BigRational(n, d)); }

}  // namespace

PosedRegions::PosedRegions(const Operand& p, const Operand& q, const PosePair& poses,
                           const std::vector<Point>& positions)
    : operands_{&p, &q} {
  // Sums have one bit more than either operand.
  scale_ = std::max({top_of(p, poses[0]), top_of(q, poses[1]), -1022}) + 2;
  constexpr int kNothing = std::numeric_limits<int>::max();
  int exponent = kNothing;
  for (const Operand* o : operands_)
    if (!o->points->input.empty()) exponent = std::min(exponent, o->points->exponent);
  for (const Point& v : positions) lower_to(exponent, v.x), lower_to(exponent, v.y);
  unit_.exponent = exponent == kNothing ? 0 : exponent;
  std::array<LatticeScale, 2> turn;
  std::array<BigInteger, 2> den;
  for (std::uint32_t op = 0; op < 2; ++op) {
    const auto& [x, y] = poses[op].scale;
    turn[op] = turn_of(poses[op].rotation, op);
    den[op] = turn[op].den * exact::denominator_of(x.exact()) * exact::denominator_of(y.exact());
  }
  unit_.den = den[0] * den[1];
  for (std::uint32_t op = 0; op < 2; ++op) {
    Map& m = map_[op];
    const Rational &sx = poses[op].scale[0].exact(), &sy = poses[op].scale[1].exact();
    const BigInteger x = exact::numerator_of(sx) * exact::denominator_of(sy),
                     y = exact::numerator_of(sy) * exact::denominator_of(sx), &c = turn[op].x, &s = turn[op].turn;
    const auto entry = [&](const BigInteger& n, double& rounded, Big& exact) {
      rounded = std::ldexp(quotient(n, den[op]), -scale_);
      exact = Big(BigInteger(n * den[1 - op]));
    };
    entry(BigInteger(c * x), m.xx, m.exact_xx), entry(BigInteger(-s * y), m.xy, m.exact_xy);
    entry(BigInteger(s * x), m.yx, m.exact_yx), entry(BigInteger(c * y), m.yy, m.exact_yy);
    const Point factor = factor_of(poses[op]);
    m.factor = std::ldexp(std::max(factor.x, factor.y), -scale_);
    m.angle = poses[op].rotation.radians();
    exact_[op].resize(operands_[op]->size());
    pairs_[op].resize(operands_[op]->size());
  }
  const unsigned den_bits = static_cast<unsigned>(msb(unit_.den)) + 1;
  top_ = static_cast<int>(den_bits) + scale_ - unit_.exponent;
  pair_scale_ = quotient(BigInteger(1) << den_bits, unit_.den);
}

// Its 128 leading digits at least, as a sum of two doubles.
base::DoublePair PosedRegions::pair(const Big& n) const {
  const BigInteger& v = n.value();
  if (v.is_zero()) return {};
  const BigInteger size = abs(v);
  const int cut = std::max(0, static_cast<int>(msb(size)) - 127);
  const BigInteger head = size >> static_cast<unsigned>(cut);
  const double high = exact::to_double(Big(head));
  const BigInteger rest = head - numerator(exact::exact_value(high));
  const int shift = cut - top_, sign = v.sign();
  return {sign * std::ldexp(high, shift), sign * std::ldexp(exact::to_double(Big(rest)), shift)};
}

const PairPoint& PosedRegions::pair(std::uint32_t op, std::uint32_t walk) const {
  std::optional<PairPoint>& kept = pairs_[op][walk];
  if (!kept) {
    const BigPoint& at = exact(op, walk);
    kept = PairPoint{pair(at.x), pair(at.y)};
  }
  return *kept;
}

double PosedRegions::scaled(double coordinate) const {
  const double v = std::ldexp(coordinate, -scale_);
  return std::clamp(v, -2.0, 2.0);
}

Big PosedRegions::exact_number(double v) const {
  return Big(BigInteger(exact::grid_coordinate<Big>(v, unit_.exponent).value() * unit_.den));
}

const BigPoint& PosedRegions::exact(std::uint32_t op, std::uint32_t walk) const {
  std::optional<BigPoint>& kept = exact_[op][walk];
  if (!kept) {
    const Map& m = map_[op];
    const Point v = own(op, walk);
    const Big x = exact::grid_coordinate<Big>(v.x, unit_.exponent),
              y = exact::grid_coordinate<Big>(v.y, unit_.exponent);
    kept = BigPoint{m.exact_xx * x + m.exact_xy * y, m.exact_yx * x + m.exact_yy * y};
  }
  return *kept;
}

Point PosedRegions::scaled(const BigPosition& position) const {
  return {std::ldexp(unit_.rounded(position.x, position.w), -scale_),
          std::ldexp(unit_.rounded(position.y, position.w), -scale_)};
}

Point factor_of(const PlanarPose& pose) { return {pose.scale[0].approx(), pose.scale[1].approx()}; }

PoseChange change_of(const Operand& operand, const PlanarPose& from, const PlanarPose& to) {
  double most = 0;
  for (const Point& v : operand.points->input) most = std::max(most, std::hypot(v.x, v.y));
  // The largest singular value of the difference of both maps, (x . y; z . w) by columns.
  const auto map = [](const PlanarPose& pose) {
    const Point s = factor_of(pose);
    const double c = std::cos(pose.rotation.radians()), t = std::sin(pose.rotation.radians());
    return std::array{c * s.x, t * s.x, t * s.y, c * s.y};
  };
  const auto a = map(from), b = map(to);
  double squares = 0, size = 0;
  for (std::size_t k = 0; k < 4; ++k) squares += (b[k] - a[k]) * (b[k] - a[k]), size += std::abs(a[k]) + std::abs(b[k]);
  const double det = (b[0] - a[0]) * (b[3] - a[3]) - (b[1] - a[1]) * (b[2] - a[2]);
  const double largest = 0.5 * (squares + std::sqrt(std::max(0.0, squares * squares - 4 * det * det)));
  const double turn = std::remainder(to.rotation.radians() - from.rotation.radians(), 2 * std::numbers::pi);
  return {most * (std::sqrt(largest) + 0x1p-44 * size) * (1 + 0x1p-40), turn};
}

namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;
constexpr std::uint32_t kFeaturesInLeaf = 4;

/// The angle in [0, a whole turn], up to rounding.
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

FeatureDiscs::FeatureDiscs(const Operand& operand, Of of, Point factors)
    : operand_(operand), of_(of), factors_(factors) {
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
  return std::atan2(y / most * factors_.y, x / most * factors_.x);
}

DirectionRange FeatureDiscs::range_of(std::uint32_t item) const {
  if (of_ == Of::edges) return {angle_of(item), 0};
  const double from = angle_of(operand_.prev[item]);
  return {from, wrapped(angle_of(item) - from)};
}

FeatureDiscs::Node FeatureDiscs::leaf_of(std::uint32_t item) const {
  Node node;
  const Point a = at(item), b = of_ == Of::edges ? at(operand_.next[item]) : a;
  node.centre = between(a, b);
  node.radius = half_distance(a, b);
  node.directions = directions(item);
  return node;
}

/// Features in the order of their walks: neighbours are near each other, and their directions too.
std::uint32_t FeatureDiscs::build(std::uint32_t first, std::uint32_t last) {
  const auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node = leaf_of(items_[first]);
  double x0 = node.centre.x, x1 = x0, y0 = node.centre.y, y1 = y0;
  for (std::uint32_t k = first; k < last; ++k) {
    const Node one = leaf_of(items_[k]);
    node.directions = hull(node.directions, one.directions);
    for (const Point v : {at(items_[k]), of_ == Of::edges ? at(operand_.next[items_[k]]) : at(items_[k])})
      x0 = std::min(x0, v.x), x1 = std::max(x1, v.x), y0 = std::min(y0, v.y), y1 = std::max(y1, v.y);
  }
  node.centre = between({x0, y0}, {x1, y1});
  node.radius = half_distance({x0, y0}, {x1, y1}) * (1 + 0x1p-40);
  node.first = first, node.last = last;
  if (last - first > kFeaturesInLeaf) {
    const std::uint32_t half = first + (last - first) / 2;
    node.left = build(first, half), node.right = build(half, last);
  }
  nodes_[id] = node;
  return id;
}

namespace {

/// More than angles of edges and poses err.
constexpr double kAngleOff = 0x1p-44;
/// What is kept for the next places: so much of the box around it, and turns up to so many radians.
constexpr double kKeptFraction = 0.5, kKeptTurn = 0.1;
/// The reach where operands move fast: so many times as far as they moved between two calls.
constexpr double kKeptCalls = 8;

bool misses(const ScaledBox& box, Point centre, double radius) {
  const double dx = std::max({box.x0 - centre.x, centre.x - box.x1, 0.0}),
               dy = std::max({box.y0 - centre.y, centre.y - box.y1, 0.0});
  return dx * dx + dy * dy > radius * radius * (1 + 0x1p-40) + 0x1p-80;
}

ScaledBox grown(const ScaledBox& b, double by) { return {b.x0 - by, b.y0 - by, b.x1 + by, b.y1 + by}; }

}  // namespace

NearSegments::NearSegments(const Operand& p, const Operand& q, const std::array<Point, 2>& factors)
    : operands_{&p, &q},
      edges_{FeatureDiscs(p, FeatureDiscs::Of::edges, factors[0]),
             FeatureDiscs(q, FeatureDiscs::Of::edges, factors[1])},
      vertices_{FeatureDiscs(p, FeatureDiscs::Of::vertices, factors[0]),
                FeatureDiscs(q, FeatureDiscs::Of::vertices, factors[1])} {}

base::CountedArray<WalkSegment> NearSegments::find(const PosedRegions& posed, const ScaledBox& box) {
  rebuilt_ = true, pairs_ = 0;
  return search(posed, {box, kAngleOff});
}

base::CountedArray<WalkSegment> NearSegments::update(const PosedRegions& posed, const PosePair& poses,
                                                     const ScaledBox& box) {
  rebuilt_ = !still_holds(posed, poses, box), pairs_ = 0;
  if (rebuilt_) {
    const double a_call = kept_ ? kept_->moved / static_cast<double>(kept_->calls + 1) : 0;
    Kept kept;
    kept.poses = poses, kept.scale = posed.scale(), kept.turn = kKeptTurn;
    kept.box = grown(box, std::max(kKeptFraction * std::max(box.x1 - box.x0, box.y1 - box.y0), kKeptCalls * a_call));
    kept.segments = search(posed, {kept.box, kept.turn});
    kept_ = std::move(kept);
  }
  ++kept_->calls;
  pairs_ += kept_->segments.size();
  const Wanted wanted{box, kAngleOff};
  base::CountedArray<WalkSegment> near;
  for (const WalkSegment& s : kept_->segments)
    if (is_near(posed, s, wanted)) near.push_back(s);
  return near;
}

bool NearSegments::still_holds(const PosedRegions& posed, const PosePair& poses, const ScaledBox& box) {
  if (!kept_ || kept_->scale != posed.scale()) return false;
  const PoseChange p = change_of(*operands_[0], kept_->poses[0], poses[0]),
                   q = change_of(*operands_[1], kept_->poses[1], poses[1]);
  const double moved = std::ldexp(p.distance + q.distance, -posed.scale()) + 4 * PosedRegions::kOff;
  kept_->moved = moved;
  if (std::abs(p.turn - q.turn) + kAngleOff > kept_->turn) return false;
  const ScaledBox reach = grown(box, moved), &held = kept_->box;
  return reach.x0 > held.x0 && reach.y0 > held.y0 && reach.x1 < held.x1 && reach.y1 < held.y1;
}

base::CountedArray<WalkSegment> NearSegments::all(const PosedRegions& posed) const {
  base::CountedArray<WalkSegment> found;
  const Wanted everywhere{{-4, -4, 4, 4}, kAngleOff};
  for (std::uint32_t side = 0; side < 2; ++side)
    for (std::uint32_t e = 0; e < operands_[side]->size(); ++e)
      for (std::uint32_t v = 0; v < operands_[1 - side]->size(); ++v)
        if (operands_[1 - side]->convex[v] != 0 && is_near(posed, {side, e, v}, everywhere))
          found.push_back({side, e, v});
  return found;
}

base::CountedArray<WalkSegment> NearSegments::search(const PosedRegions& posed, const Wanted& wanted) {
  base::CountedArray<WalkSegment> found;
  for (std::uint32_t side = 0; side < 2; ++side) search_side(posed, wanted, side, found);
  return found;
}

void NearSegments::search_side(const PosedRegions& posed, const Wanted& wanted, std::uint32_t side,
                               base::CountedArray<WalkSegment>& found) {
  const FeatureDiscs &edges = edges_[side], &vertices = vertices_[1 - side];
  if (edges.empty() || vertices.empty()) return;
  const double turn = posed.angle(side) - posed.angle(1 - side);
  std::vector<std::array<std::uint32_t, 2>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [i, j] = stack.back();
    stack.pop_back();
    ++pairs_;
    const FeatureDiscs::Node &a = edges.node(i), &b = vertices.node(j);
    if (!may_meet(a.directions, turn, b.directions, wanted.turn)) continue;
    const Point m = posed.posed(side, a.centre), n = posed.posed(1 - side, b.centre);
    const double radius = posed.stretched(side, a.radius) + posed.stretched(1 - side, b.radius) + PosedRegions::kOff;
    if (misses(wanted.box, {m.x + n.x, m.y + n.y}, radius)) continue;
    if (a.leaf() && b.leaf()) {
      for (std::uint32_t k = a.first; k < a.last; ++k)
        for (std::uint32_t l = b.first; l < b.last; ++l)
          if (const WalkSegment s{side, edges.item(k), vertices.item(l)}; is_near(posed, s, wanted)) found.push_back(s);
    } else if (b.leaf() || (!a.leaf() && a.last - a.first >= b.last - b.first)) {
      stack.push_back({a.right, j}), stack.push_back({a.left, j});
    } else {
      stack.push_back({i, b.right}), stack.push_back({i, b.left});
    }
  }
}

bool NearSegments::is_near(const PosedRegions& posed, const WalkSegment& s, const Wanted& wanted) const {
  const Operand& o = *operands_[s.side];
  const Point v = posed.vertex(1 - s.side, s.vertex), a = posed.vertex(s.side, s.edge),
              b = posed.vertex(s.side, o.next[s.edge]);
  const ScaledBox reach = grown(wanted.box, 2 * PosedRegions::kOff);
  if (std::max(a.x, b.x) + v.x < reach.x0 || std::min(a.x, b.x) + v.x > reach.x1 ||
      std::max(a.y, b.y) + v.y < reach.y0 || std::min(a.y, b.y) + v.y > reach.y1)
    return false;
  return may_meet(edges_[s.side].directions(s.edge), posed.angle(s.side) - posed.angle(1 - s.side),
                  vertices_[1 - s.side].directions(s.vertex), wanted.turn);
}

namespace {

/// The least margin as a fraction of the sums' extent: nodes are found to within 2^-32 of it.
constexpr double kLeastMargin = 0x1p-28;
/// What lies beyond all sums in scaled doubles, where they are within 1.
constexpr double kBeyond = 1.5;

double lower(double v, double by) {
  const double w = v - by;
  return std::isfinite(w) ? (w < v ? w : std::nextafter(v, -INFINITY)) : -std::numeric_limits<double>::max();
}

}  // namespace

PlanarBox larger_box(const PlanarBox& box, double extent) {
  // Each axis has a margin of its own: a thin box stays thin.
  const double least = extent * kLeastMargin, x = std::max(box.high.x / 32 - box.low.x / 32, least),
               y = std::max(box.high.y / 32 - box.low.y / 32, least);
  return {{lower(box.low.x, x), lower(box.low.y, y)}, {-lower(-box.high.x, x), -lower(-box.high.y, y)}};
}

LocalWalls::LocalWalls(const PosedRegions& posed, const PlanarBox& box, const PlanarBox& reach) {
  const std::array<double, 8> values{box.low.x,   box.high.x,   box.low.y,   box.high.y,
                                     reach.low.x, reach.high.x, reach.low.y, reach.high.y};
  for (std::size_t k = 0; k < 8; ++k) {
    LocalWall& wall = walls_[k];
    wall.axis = k % 4 < 2 ? 0 : 1;
    wall.value = values[k];
    wall.scaled = posed.scaled(wall.value);
    wall.beyond = std::abs(wall.scaled) > kBeyond;
    if (wall.beyond) continue;
    const Big v = posed.exact_number(wall.value);
    wall.exact = {v, v, Big::from_int64(1)};
    wall.pair = posed.pair(v);
  }
}

}  // namespace dymsum::planar
