#include "planar/frame/posed_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

}  // namespace dymsum::planar
