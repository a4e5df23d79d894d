#include "planar/operand/fraction_points.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "exact/grid.h"
#include "planar/operand/lattice_build.h"

namespace dymsum::planar {
namespace {

using exact::BigInteger;
using exact::HomogeneousPoint;

// num 2^shift / den, rounded once; of a nonzero one that underflows the smallest number of its sign.
double rounded(const BigInteger& num, const BigInteger& den, int shift) {
  const double nearest = shift == 0  ? exact::round_to_double(num, den)
                         : shift > 0 ? exact::round_to_double(BigInteger(num << shift), den)
                                     : exact::round_to_double(num, BigInteger(den << -shift));
  return with_sign_of(num.sign(), nearest);
}

// The largest double that is no larger than num / den.
double rounded_down(const BigInteger& num, const BigInteger& den) {
  const double nearest = exact::round_to_double(num, den);
  if (!std::isfinite(nearest)) return nearest;
  const exact::Dyadic d = exact::to_dyadic(nearest);
  const BigInteger product = BigInteger(d.mantissa) * den;
  const bool above =
      d.exponent >= 0 ? BigInteger(product << d.exponent) > num : product > BigInteger(num << -d.exponent);
  return above ? std::nextafter(nearest, -INFINITY) : nearest;
}

// num / den - offset in units of 2^unit, rounded once.
double coordinate(const BigInteger& num, const BigInteger& den, double offset, int unit) {
  const exact::Dyadic d = exact::to_dyadic(offset);
  const BigInteger product = BigInteger(d.mantissa) * den;
  if (d.exponent >= 0) return rounded(BigInteger(num - (product << d.exponent)), den, -unit);
  return rounded(BigInteger((num << -d.exponent) - product), BigInteger(den << -d.exponent), -unit);
}

// The exponent of a coordinate over a power of two; nothing for other fractions and for zero.
std::optional<int> exponent_of(const BigInteger& num, const BigInteger& den) {
  if (num.is_zero() || msb(den) != lsb(den)) return std::nullopt;
  return static_cast<int>(lsb(abs(num))) - static_cast<int>(lsb(den));
}

}  // namespace

HomogeneousPoint FractionPoints::difference(std::uint32_t from, std::uint32_t to) const {
  const HomogeneousPoint &a = at[from], &b = at[to];
  if (a.w == b.w) return {b.x - a.x, b.y - a.y, a.w};
  return {b.x * a.w - a.x * b.w, b.y * a.w - a.y * b.w, a.w * b.w};
}

Point FractionPoints::vector(std::uint32_t from, std::uint32_t to, int unit) const {
  const HomogeneousPoint d = difference(from, to);
  return {rounded(d.x, d.w, -unit), rounded(d.y, d.w, -unit)};
}

Point FractionPoints::direction(std::uint32_t from, std::uint32_t to) const {
  const HomogeneousPoint d = difference(from, to);
  const auto top = [](const BigInteger& v) { return v.is_zero() ? 0 : msb(BigInteger(abs(v))); };
  const auto longer = std::max(top(d.x), top(d.y)), shift = longer > 61 ? longer - 61 : 0;
  const auto leading = [&](const BigInteger& v) {
    const auto bits = static_cast<std::int64_t>(static_cast<std::uint64_t>(BigInteger(abs(v)) >> shift));
    return with_sign_of(v.sign(), static_cast<double>(v.sign() < 0 ? -bits : bits));
  };
  return {leading(d.x), leading(d.y)};
}

int FractionPoints::compare(std::uint32_t i, std::uint32_t j, int axis) const {
  const Point &p = nearest[i], &q = nearest[j];
  if (const double gap = axis == 0 ? p.x - q.x : p.y - q.y; gap != 0) return gap > 0 ? 1 : -1;
  const HomogeneousPoint &a = at[i], &b = at[j];
  const BigInteger &u = axis == 0 ? a.x : a.y, &v = axis == 0 ? b.x : b.y;
  const int order = a.w == b.w ? u.compare(v) : BigInteger(u * b.w).compare(BigInteger(v * a.w));
  return (order > 0) - (order < 0);
}

int FractionPoints::cross(const Edge& d, const Edge& e) const {
  const HomogeneousPoint a = difference(d.from, d.to), b = difference(e.from, e.to);
  return BigInteger(a.x * b.y - a.y * b.x).sign();
}

int FractionPoints::dot(const Edge& d, const Edge& e) const {
  const HomogeneousPoint a = difference(d.from, d.to), b = difference(e.from, e.to);
  return BigInteger(a.x * b.x + a.y * b.y).sign();
}

void fractions_in_units(PlacedPoints& points, int unit) {
  points.unit = unit;
  points.x.clear();
  points.y.clear();
  points.width = points.height = 0;
  for (const HomogeneousPoint& v : points.fractions->at) {
    points.x.push_back(coordinate(v.x, v.w, points.offset.x, unit));
    points.y.push_back(coordinate(v.y, v.w, points.offset.y, unit));
    points.width = std::max(points.width, points.x.back());
    points.height = std::max(points.height, points.y.back());
  }
}

std::shared_ptr<const PlacedPoints> fractions_as_points(std::vector<HomogeneousPoint> at) {
  auto points = std::make_shared<PlacedPoints>();
  auto fractions = std::make_shared<FractionPoints>(FractionPoints{std::move(at), {}});
  for (const HomogeneousPoint& v : fractions->at)
    points->input.push_back({exact::round_to_double(v.x, v.w), exact::round_to_double(v.y, v.w)});
  fractions->nearest = points->input;
  std::uint32_t min_x = 0, min_y = 0;
  std::optional<int> exponent;
  for (std::uint32_t i = 0; i < fractions->at.size(); ++i) {
    const HomogeneousPoint& v = fractions->at[i];
    if (fractions->compare(i, min_x, 0) < 0) min_x = i;
    if (fractions->compare(i, min_y, 1) < 0) min_y = i;
    for (const BigInteger* num : {&v.x, &v.y})
      if (const std::optional<int> own = exponent_of(*num, v.w)) exponent = std::min(*own, exponent.value_or(*own));
  }
  points->offset = {rounded_down(fractions->at[min_x].x, fractions->at[min_x].w),
                    rounded_down(fractions->at[min_y].y, fractions->at[min_y].w)};
  points->fractions = std::move(fractions);
  points->exponent = exponent.value_or(0);
  fractions_in_units(*points, 0);
  points->extent = std::max(points->width, points->height);
  points->top = top_of(points->extent);
  if (!points->moderate()) fractions_in_units(*points, unit_for(points->extent, points->exponent, kNarrowBits));
  return points;
}

Point LatticeDoubles::fraction_vector(const PlacedPoints& points, const Edge& e) {
  return points.fractions->vector(e.from, e.to, points.unit);
}

Point LatticeDoubles::fraction_direction(const PlacedPoints& points, const Edge& e) {
  return points.fractions->direction(e.from, e.to);
}

}  // namespace dymsum::planar
