#include "spatial/mesh/vec3.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/doubles.h"
#include "exact/big.h"
#include "exact/grid.h"

namespace dymsum::spatial {
namespace {

SpaceGrid::Line grid_line(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const int exponent = exact::common_exponent(values);
  const double offset = exact::grid_center(*low, *high, exponent);
  return {exponent, offset, exact::bits_needed(*low, *high, offset, exponent)};
}

}  // namespace

exact::Tier SpaceGrid::tier() const { return exact::choose_tier(std::max({x.bits, y.bits, z.bits}), 0); }

SpaceGrid space_grid(const std::vector<Point3>& points) {
  std::vector<double> values(points.size());
  const auto line = [&](auto coordinate) {
    std::transform(points.begin(), points.end(), values.begin(), coordinate);
    return grid_line(values);
  };
  return {line([](const Point3& p) { return p.x; }), line([](const Point3& p) { return p.y; }),
          line([](const Point3& p) { return p.z; })};
}

using exact::Big;

GridPositions grid_positions(std::span<const Point3> points) {
  GridPositions p;
  std::vector<double> all;
  all.reserve(3 * points.size());
  double most = 0;
  for (const Point3& v : points)
    for (const double c : {v.x, v.y, v.z}) {
      all.push_back(c);
      most = std::max(most, std::abs(c));
    }
  p.exponent = exact::common_exponent(all);
  p.bits = exact::bits_needed(most, p.exponent);
  if (p.bits <= 61) {
    const auto on = [&](double c) { return exact::grid_coordinate<exact::Int<61>>(c, p.exponent).raw(); };
    for (const Point3& v : points) p.grid.push_back({on(v.x), on(v.y), on(v.z)});
  } else {
    const auto on = [&](double c) { return exact::grid_coordinate<Big>(c, p.exponent); };
    for (const Point3& v : points) p.big.push_back({on(v.x), on(v.y), on(v.z)});
  }
  return p;
}

GridPositions grid_positions(const std::vector<exact::Vector3<Big>>& points, int exponent) {
  GridPositions p;
  p.exponent = exponent;
  for (const exact::Vector3<Big>& v : points) p.bits = std::max(p.bits, bit_length(v));
  if (p.bits > 61) {
    p.big = points;
    return p;
  }
  const auto on = [](const Big& c) { return static_cast<std::int64_t>(c.value()); };
  for (const exact::Vector3<Big>& v : points) p.grid.push_back({on(v.x), on(v.y), on(v.z)});
  return p;
}

namespace {

/// The exponent below which an interval about 0 holds what is left.
constexpr int kLeastExponent = -900;

/// All of at most 2^exponent.
exact::FineInterval up_to_power(int exponent) {
  const double r = std::ldexp(1.0, std::max(exponent, kLeastExponent));
  return exact::FineInterval(exact::Interval(-r, r));
}

}  // namespace

exact::FineInterval fine_coordinate(const exact::Big& v, int shift) {
  using exact::Big;
  using exact::FineInterval;
  const exact::BinaryParts high = exact::binary_parts(v);
  if (high.is_zero()) return {};
  // What is left behind two doubles is held by an interval about 0, too.
  if (high.exponent + shift < kLeastExponent + 110) return up_to_power(high.exponent + shift + 1);
  Big rest = v;
  const auto take = [&](const exact::BinaryParts& part) {
    const Big mantissa = Big::from_int64(static_cast<std::int64_t>(std::ldexp(part.mantissa, 53)));
    const int power = part.exponent - 53;
    // Fewer digits than a double has: the last ones of the mantissa are zeros.
    rest = rest - (power >= 0 ? Big(exact::BigInteger(mantissa.value() << power))
                              : Big(exact::BigInteger(mantissa.value() / (exact::BigInteger(1) << -power))));
  };
  take(high);
  const exact::BinaryParts low = exact::binary_parts(rest);
  if (low.is_zero()) return FineInterval(high.scaled(shift));
  take(low);
  const FineInterval both = FineInterval::difference(-low.scaled(shift), high.scaled(shift));
  const exact::BinaryParts left = exact::binary_parts(rest);
  return left.is_zero() ? both : both + up_to_power(left.exponent + shift);
}

exact::FineInterval fine_coordinate(const exact::RootValue& v, int shift) {
  if (v.terms().empty()) return {};
  if (v.at() == nullptr || v.terms().size() == 1) return fine_coordinate(exact::Big(v.terms()[0]), shift);
  const exact::RootPoint::Enclosure e = v.at()->enclose(v.terms(), 160);
  shift -= static_cast<int>(e.scale);
  const exact::FineInterval midpoint = fine_coordinate(exact::Big(e.value), shift);
  return e.error.is_zero() ? midpoint : midpoint + up_to_power(static_cast<int>(msb(e.error)) + 1 + shift);
}

exact::FineInterval fine_coordinate(const exact::Fraction& v, int shift) {
  if (sign(v) == 0) return {};
  const int power = exact::power_for_bits(v, 160);
  return fine_coordinate(exact::Big(rounded_down(v, power)), shift - power) + up_to_power(shift - power);
}

exact::WideInterval wide_coordinate(const exact::Fraction& v, int shift) {
  if (sign(v) == 0) return {};
  const int power = exact::power_for_bits(v, exact::WideInterval::kFractionBits + 8);
  return exact::WideInterval::around(rounded_down(v, power), 1, static_cast<long>(shift) - power);
}

exact::WideInterval wide_coordinate(const exact::RootValue& v, int shift) {
  if (v.terms().empty()) return {};
  if (v.at() == nullptr || v.terms().size() == 1) return exact::WideInterval::around(v.terms()[0], 0, shift);
  // Coefficients are hardly larger than the value, as roots are below 1 in a chart: the error is about the last place.
  const exact::RootPoint::Enclosure e = v.at()->enclose(v.terms(), exact::WideInterval::kFractionBits + 8);
  return exact::WideInterval::around(e.value, e.error, shift - static_cast<long>(e.scale));
}

std::vector<std::uint32_t> order_by_position(const std::vector<Point3>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(points[a].x, points[a].y, points[a].z, a) < std::tie(points[b].x, points[b].y, points[b].z, b);
  });
  return order;
}

std::vector<std::uint32_t> first_at_position(const std::vector<Point3>& points) {
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<std::uint32_t> first(points.size()), slots(std::bit_ceil(2 * points.size() + 1), kNone);
  for (std::uint32_t k = 0; k < points.size(); ++k) {
    std::uint64_t mixed = 0;
    // 0 and -0 are one position.
    for (const double c : {points[k].x + 0.0, points[k].y + 0.0, points[k].z + 0.0}) {
      mixed = (mixed ^ base::bit_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15ULL;
      mixed ^= mixed >> 32;
    }
    std::size_t at = mixed & (slots.size() - 1);
    while (slots[at] != kNone && points[slots[at]] != points[k]) at = (at + 1) & (slots.size() - 1);
    if (slots[at] == kNone) slots[at] = k;
    first[k] = slots[at];
  }
  return first;
}

}  // namespace dymsum::spatial
