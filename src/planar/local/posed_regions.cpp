#include "planar/local/posed_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "exact/grid.h"
#include "planar/turning/turn.h"

namespace dymsum::planar {

using exact::BigInteger;
using exact::BigRational;

int compare(const BigPlace& a, const BigPlace& b, int axis) {
  const Big left = (axis == 0 ? a.x : a.y) * b.w, right = (axis == 0 ? b.x : b.y) * a.w;
  return left < right ? -1 : right < left ? 1 : 0;
}

bool same_place(const BigPlace& a, const BigPlace& b) { return compare(a, b, 0) == 0 && compare(a, b, 1) == 0; }

BigPlace halfway(const BigPlace& a, const BigPlace& b) {
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

RationalPoint LocalUnit::point(const BigPlace& place) const {
  return {exact::to_rational(value(place.x, place.w)), exact::to_rational(value(place.y, place.w))};
}

namespace {

/// 2^top is more than all coordinates of the operand where it stands, in magnitude.
int top_of(const Operand& o, const PlanarPose& pose) {
  double most = 0;
  for (const Point& v : o.points->input) most = std::max({most, std::abs(v.x), std::abs(v.y)});
  const double far = std::max(std::abs(pose.offset.x), std::abs(pose.offset.y));
  int top = std::numeric_limits<int>::min() / 2;
  if (most > 0) top = std::ilogb(most) + std::ilogb(pose.scale.approx()) + 3;
  if (far > 0) top = std::max(top, std::ilogb(far) + 1);
  return top;
}

void lower_to(int& exponent, double v) {
  if (v != 0) exponent = std::min(exponent, exact::to_dyadic(v).exponent);
}

double quotient(const BigInteger& n, const BigInteger& d) { return exact::round_to_double(BigRational(n, d)); }

}  // namespace

PosedRegions::PosedRegions(const Operand& p, const Operand& q, const PosePair& poses, const std::vector<Point>& places)
    : operands_{&p, &q} {
  // Of sums: one more than of either.
  scale_ = std::max({top_of(p, poses[0]), top_of(q, poses[1]), -1022}) + 2;
  constexpr int kNothing = std::numeric_limits<int>::max();
  int exponent = kNothing;
  for (const Operand* o : operands_)
    if (!o->points->input.empty()) exponent = std::min(exponent, o->points->exponent);
  for (const PlanarPose& pose : poses) lower_to(exponent, pose.offset.x), lower_to(exponent, pose.offset.y);
  for (const Point& v : places) lower_to(exponent, v.x), lower_to(exponent, v.y);
  unit_.exponent = exponent == kNothing ? 0 : exponent;
  std::array<LatticeScale, 2> turn;
  std::array<BigInteger, 2> den;
  for (std::uint32_t op = 0; op < 2; ++op) {
    turn[op] = turn_of(poses[op].orientation, op);
    den[op] = turn[op].den * exact::denominator_of(poses[op].scale.exact());
  }
  unit_.den = den[0] * den[1];
  for (std::uint32_t op = 0; op < 2; ++op) {
    Map& m = map_[op];
    const BigInteger by = exact::numerator_of(poses[op].scale.exact()), c = turn[op].x * by, s = turn[op].turn * by;
    m.exact_c = Big(BigInteger(c * den[1 - op])), m.exact_s = Big(BigInteger(s * den[1 - op]));
    m.exact_offset = exact(poses[op].offset);
    m.c = std::ldexp(quotient(c, den[op]), -scale_), m.s = std::ldexp(quotient(s, den[op]), -scale_);
    m.stretch = std::ldexp(poses[op].scale.approx(), -scale_);
    m.angle = poses[op].orientation.radians();
    m.offset = {std::ldexp(poses[op].offset.x, -scale_), std::ldexp(poses[op].offset.y, -scale_)};
    exact_[op].resize(operands_[op]->size());
  }
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
    kept = BigPoint{m.exact_c * x - m.exact_s * y, m.exact_s * x + m.exact_c * y} + m.exact_offset;
  }
  return *kept;
}

Point PosedRegions::scaled(const BigPlace& place) const {
  return {std::ldexp(unit_.rounded(place.x, place.w), -scale_), std::ldexp(unit_.rounded(place.y, place.w), -scale_)};
}

PoseChange change_of(const Operand& operand, const PlanarPose& from, const PlanarPose& to) {
  double most = 0;
  for (const Point& v : operand.points->input) most = std::max(most, std::hypot(v.x, v.y));
  const auto map = [](const PlanarPose& pose) {
    const double s = pose.scale.approx(), a = pose.orientation.radians();
    return Point{s * std::cos(a), s * std::sin(a)};
  };
  const Point a = map(from), b = map(to);
  const double size = from.scale.approx() + to.scale.approx();
  const double turn = std::remainder(to.orientation.radians() - from.orientation.radians(), 2 * std::numbers::pi);
  return {most * (std::hypot(b.x - a.x, b.y - a.y) + 0x1p-44 * size) * (1 + 0x1p-40) +
              std::hypot(to.offset.x - from.offset.x, to.offset.y - from.offset.y) * (1 + 0x1p-40),
          turn};
}

}  // namespace dymsum::planar
