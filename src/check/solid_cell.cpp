#include "check/solid_cell.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "exact/rounding_bound.h"

namespace dymsum::check {
namespace {

using exact::BigRational;

/// The same ratios in lowest terms as integers, the first that is not zero positive.
void make_primitive(std::array<BigInteger, 4>& form) {
  BigInteger common = 0;
  for (const BigInteger& v : form) common = gcd(common, v);
  for (int k = 0; k < 3; ++k) {
    if (form[k] == 0) continue;
    if (form[k] < 0) common = -common;
    break;
  }
  if (common == 1) return;
  for (BigInteger& v : form) v /= common;
}

std::array<BigInteger, 4> homogeneous_of(const RationalVector& p) {
  std::array<BigInteger, 4> h;
  h[3] = lcm(BigInteger(denominator(p[0])), lcm(BigInteger(denominator(p[1])), BigInteger(denominator(p[2]))));
  for (int k = 0; k < 3; ++k) h[k] = numerator(p[k]) * (h[3] / denominator(p[k]));
  return h;
}

/// Of three rows, the determinant of three columns.
BigInteger minor_of(const std::array<BigInteger, 4>& a, const std::array<BigInteger, 4>& b,
                    const std::array<BigInteger, 4>& c, int i, int j, int k) {
  return a[i] * (b[j] * c[k] - b[k] * c[j]) - a[j] * (b[i] * c[k] - b[k] * c[i]) + a[k] * (b[i] * c[j] - b[j] * c[i]);
}

std::vector<std::uint32_t> common_planes(const SpacePoint& a, const SpacePoint& b) {
  std::vector<std::uint32_t> common;
  std::set_intersection(a.planes.begin(), a.planes.end(), b.planes.begin(), b.planes.end(), std::back_inserter(common));
  return common;
}

void add_plane(SpacePoint& p, std::uint32_t plane) {
  const auto at = std::lower_bound(p.planes.begin(), p.planes.end(), plane);
  if (at == p.planes.end() || *at != plane) p.planes.insert(at, plane);
}

bool is_same(const SpacePoint& a, const SpacePoint& b) {
  if (a.near.x != b.near.x || a.near.y != b.near.y || a.near.z != b.near.z) return false;
  for (int k = 0; k < 3; ++k)
    if (a.exact[k] * b.exact[3] != b.exact[k] * a.exact[3]) return false;
  return true;
}

/// Where edges go through the plane, once each.
std::vector<SpacePointRef> crossings(const SolidCell& cell, const std::vector<int>& side, std::uint32_t plane,
                                     const PlaneTable& planes) {
  std::vector<SpacePointRef> found;
  for (std::size_t i = 0; i < side.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (side[i] * side[j] >= 0) continue;
      std::vector<std::uint32_t> on = common_planes(*cell.vertices[i], *cell.vertices[j]);
      if (on.size() < 2) continue;
      const SpacePointRef p = planes.meeting_of(on[0], on[1], plane);
      const auto known =
          std::find_if(found.begin(), found.end(), [&](const SpacePointRef& q) { return is_same(*p, *q); });
      SpacePoint& at = known == found.end() ? *found.emplace_back(p) : **known;
      for (const std::uint32_t k : on) add_plane(at, k);
      add_plane(at, plane);
    }
  return found;
}

/// Without the planes that no longer have a facet.
void drop_facets(SolidCell& cell) {
  std::erase_if(cell.facets, [&](const SolidCell::Facet& facet) {
    return std::count_if(cell.vertices.begin(), cell.vertices.end(), [&](const SpacePointRef& v) {
             return std::binary_search(v->planes.begin(), v->planes.end(), facet.plane);
           }) < 3;
  });
}

}  // namespace

SpacePoint::SpacePoint(std::array<BigInteger, 4> homogeneous) : exact(std::move(homogeneous)) {
  near = {exact::round_to_double(exact[0], exact[3]), exact::round_to_double(exact[1], exact[3]),
          exact::round_to_double(exact[2], exact[3])};
}
SpacePoint::SpacePoint(const RationalVector& p) : SpacePoint(homogeneous_of(p)) {}

RationalVector SpacePoint::rational() const {
  return {BigRational(exact[0], exact[3]), BigRational(exact[1], exact[3]), BigRational(exact[2], exact[3])};
}

RationalVector exactly(const Vec3& v) {
  return {exact::exact_value(v.x), exact::exact_value(v.y), exact::exact_value(v.z)};
}

int side_of(const Plane& plane, const SpacePoint& p) {
  // The coordinates, the coefficients, products and sums are rounded: no more than 3 + 3 roundings for each product.
  constexpr double kSlack = exact::rounding_bound(8, 40);
  const double x = plane.near[0] * p.near.x, y = plane.near[1] * p.near.y, z = plane.near[2] * p.near.z;
  const double value = x + y + z + plane.near[3];
  const double slack = kSlack * (std::abs(x) + std::abs(y) + std::abs(z) + std::abs(plane.near[3])) + 0x1p-1000;
  if (value > slack && std::isfinite(slack)) return 1;
  if (value < -slack && std::isfinite(slack)) return -1;
  const auto &f = plane.exact, &h = p.exact;
  return BigInteger(f[0] * h[0] + f[1] * h[1] + f[2] * h[2] + f[3] * h[3]).sign();
}

std::uint32_t PlaneTable::add(std::array<BigInteger, 4> form) {
  make_primitive(form);
  const auto [it, added] = index_.try_emplace(form, static_cast<std::uint32_t>(planes_.size()));
  if (!added) return it->second;
  Plane plane{std::move(form), {}};
  const BigInteger most =
      std::max({BigInteger(abs(plane.exact[0])), BigInteger(abs(plane.exact[1])), BigInteger(abs(plane.exact[2]))});
  for (int k = 0; k < 4; ++k) plane.near[k] = exact::round_to_double(plane.exact[k], most);
  planes_.push_back(std::move(plane));
  return it->second;
}

std::uint32_t PlaneTable::add(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  const auto &p = a.exact, &q = b.exact, &r = c.exact;
  return add({minor_of(p, q, r, 3, 1, 2), minor_of(p, q, r, 0, 3, 2), minor_of(p, q, r, 0, 1, 3),
              -minor_of(p, q, r, 0, 1, 2)});
}

std::uint32_t PlaneTable::add(const RationalVector& n, const RationalVector& p) {
  const BigRational d = -(n[0] * p[0] + n[1] * p[1] + n[2] * p[2]);
  BigInteger unit = denominator(d);
  for (const BigRational& v : n) unit = lcm(unit, BigInteger(denominator(v)));
  const auto integer = [&](const BigRational& v) { return BigInteger(numerator(v) * (unit / denominator(v))); };
  return add({integer(n[0]), integer(n[1]), integer(n[2]), integer(d)});
}

SpacePointRef PlaneTable::meeting_of(std::uint32_t p, std::uint32_t q, std::uint32_t r) const {
  const auto &a = planes_[p].exact, &b = planes_[q].exact, &c = planes_[r].exact;
  std::array<BigInteger, 4> h{-minor_of(a, b, c, 3, 1, 2), -minor_of(a, b, c, 0, 3, 2), -minor_of(a, b, c, 0, 1, 3),
                              minor_of(a, b, c, 0, 1, 2)};
  if (h[3] < 0)
    for (BigInteger& v : h) v = -v;
  return std::make_shared<SpacePoint>(std::move(h));
}

SolidCell box_cell(const Vec3& low, const Vec3& high, PlaneTable& planes) {
  std::array<std::array<std::uint32_t, 2>, 3> of{};
  SolidCell cell;
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      const Vec3& at = end == 0 ? low : high;
      const BigRational v = exact::exact_value(axis == 0 ? at.x : axis == 1 ? at.y : at.z);
      std::array<BigInteger, 4> form;
      form[axis] = denominator(v);
      form[3] = -numerator(v);
      of[axis][end] = planes.add(std::move(form));
      cell.facets.push_back({of[axis][end], end == 0 ? 1 : -1});
    }
  for (int corner = 0; corner < 8; ++corner) {
    const std::uint32_t x = of[0][corner & 1], y = of[1][(corner >> 1) & 1], z = of[2][corner >> 2];
    const SpacePointRef p = cell.vertices.emplace_back(planes.meeting_of(x, y, z));
    for (const std::uint32_t plane : {x, y, z}) add_plane(*p, plane);
  }
  return cell;
}

std::optional<HalvedSolidCell> halved(const SolidCell& cell, std::uint32_t plane, const PlaneTable& planes) {
  std::vector<int> side;
  bool negative = false, positive = false;
  for (const SpacePointRef& v : cell.vertices) {
    side.push_back(side_of(planes[plane], *v));
    negative |= side.back() < 0;
    positive |= side.back() > 0;
  }
  if (!negative || !positive) return std::nullopt;
  HalvedSolidCell halves{{{}, cell.facets}, {{}, cell.facets}};
  for (std::size_t k = 0; k < side.size(); ++k) {
    const SpacePointRef& v = cell.vertices[k];
    if (side[k] == 0) add_plane(*v, plane);
    if (side[k] <= 0) halves.negative.vertices.push_back(v);
    if (side[k] >= 0) halves.positive.vertices.push_back(v);
  }
  for (const SpacePointRef& v : crossings(cell, side, plane, planes)) {
    halves.negative.vertices.push_back(v);
    halves.positive.vertices.push_back(v);
  }
  halves.negative.facets.push_back({plane, -1});
  halves.positive.facets.push_back({plane, 1});
  drop_facets(halves.negative);
  drop_facets(halves.positive);
  return halves;
}

}  // namespace dymsum::check
