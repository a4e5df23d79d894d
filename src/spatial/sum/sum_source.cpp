#include "spatial/sum/sum_source.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "exact/grid.h"

namespace dymsum::spatial {

using exact::BigInteger;

namespace {

/// The position in the form of SpatialPositions::homogeneous.
std::array<BigInteger, 4> homogeneous_of(const ConvexPositions& positions, std::size_t vertex,
                                         const BigInteger& scale) {
  const BigVector at = positions.numerators(vertex);
  const BigInteger unit = numerator(positions.unit());
  return {at[0] * unit, at[1] * unit, at[2] * unit, denominator(positions.unit()) * scale};
}

}  // namespace

ExactPosition SpatialPositions::at(std::size_t vertex) const {
  if (convex || !space) {
    const std::array<BigInteger, 4> h = homogeneous(vertex);
    return {exact::BigRational(h[0], h[3]), exact::BigRational(h[1], h[3]), exact::BigRational(h[2], h[3])};
  }
  const auto coordinate = [&](int axis) { return space->world_coordinate(vertices[vertex], axis); };
  ExactPosition at{coordinate(0), coordinate(1), coordinate(2)};
  if (scale != 1)
    for (exact::BigRational& c : at) c = c * (BigInteger(1) << shift) / scale;
  return at;
}

// The nearest doubles, without at(), whose fractions in lowest terms cost more than all else of writing a sum.
Point3 SpatialPositions::rounded(std::size_t vertex) const {
  double result[3];
  if (convex || !space) {
    const std::array<BigInteger, 4> h = homogeneous(vertex);
    for (std::size_t i = 0; i < 3; ++i) result[i] = exact::round_to_double(h[i], h[3]);
    return {result[0], result[1], result[2]};
  }
  const std::array<BigInteger, 4> h = space->homogeneous(vertices[vertex]);
  for (int axis = 0; axis < 3; ++axis) {
    const SumSpace::Line line = space->line(axis);
    const exact::Dyadic p = exact::to_dyadic(line.p_offset), q = exact::to_dyadic(line.q_offset);
    // All in units of the smallest power of two that occurs.
    int unit = line.exponent;
    for (const exact::Dyadic& d : {p, q})
      if (d.mantissa != 0) unit = std::min(unit, d.exponent);
    BigInteger num = h[static_cast<std::size_t>(axis)] << (line.exponent - unit), den = h[3] * scale;
    for (const exact::Dyadic& d : {p, q})
      if (d.mantissa != 0) num += (BigInteger(d.mantissa) << (d.exponent - unit)) * h[3];
    unit += shift;
    if (unit >= 0) num <<= unit;
    else den <<= -unit;
    result[axis] = exact::round_to_double(num, den);
  }
  return {result[0], result[1], result[2]};
}

std::array<BigInteger, 4> SpatialPositions::homogeneous(std::size_t vertex) const {
  if (convex) return homogeneous_of(*convex, vertex, scale);
  std::array<BigInteger, 4> h = space ? space->homogeneous(vertices[vertex]) : listed[vertex];
  if (scale == 1) return h;
  for (std::size_t axis = 0; axis < 3; ++axis) h[axis] <<= shift;
  h[3] *= scale;
  return h;
}

std::array<int, 3> SpatialPositions::unit_exponents() const {
  if (!space) return {0, 0, 0};
  return {space->line(0).exponent, space->line(1).exponent, space->line(2).exponent};
}

std::array<BigInteger, 3> SpatialPositions::multiples(std::size_t vertex, const std::array<int, 3>& shift,
                                                      bool& exact) const {
  const std::array<BigInteger, 4> h = homogeneous(vertex);
  const std::array<int, 3> unit = unit_exponents();
  std::array<BigInteger, 3> result;
  for (int axis = 0; axis < 3; ++axis) {
    const int power = shift[axis] + unit[axis];
    BigInteger rest;
    if (power >= 0) divide_qr(BigInteger(h[axis] << power), h[3], result[axis], rest);
    else divide_qr(h[axis], BigInteger(h[3] << -power), result[axis], rest);
    exact = exact && rest.is_zero();
    if (rest.sign() < 0) result[axis] -= 1;  // down, not towards zero
  }
  return result;
}

void SpatialPositions::grow(std::size_t vertex, std::array<int, 3>& exponents) const {
  const std::array<BigInteger, 4> h = homogeneous(vertex);
  const std::array<int, 3> unit = unit_exponents();
  for (int axis = 0; axis < 3; ++axis) {
    if (h[axis].is_zero()) continue;
    const int size = static_cast<int>(msb(abs(h[axis]))) - static_cast<int>(msb(h[3])) + 1 + unit[axis];
    exponents[axis] = std::max(exponents[axis], size);
  }
}

void unscale(SpatialSum& sum, const BigInteger& scale, int shift) {
  if (scale == 1 || sum.vertices.empty()) return;
  const double by = exact::round_to_double(scale, BigInteger(1) << shift);
  auto positions = std::make_shared<SpatialPositions>(SpatialSumInternals::positions(sum));
  positions->scale = scale, positions->shift = shift;
  SpatialSumInternals::set_positions(sum, std::move(positions));
  double largest = 0;
  const auto divide = [&](Point3& p) {
    p = {p.x / by, p.y / by, p.z / by};
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  };
  for (Point3& v : sum.vertices) divide(v);
  sum.at_error = sum.at_error / by * (1 + 0x1p-50) + largest * 0x1p-52;
  if (!sum.trace) return;
  for (SpatialTrace::Facet& facet : sum.trace->facets)
    for (Point3& p : facet.corners) divide(p);
  for (auto& piece : sum.trace->pieces)
    for (Point3& p : piece) divide(p);
}

namespace {

struct Axis {
  char name;
  double Point3::*coordinate;
};

/// The vertex with the smallest unit along an axis, of either list.
struct Finest {
  int exponent = 2000;
  std::size_t vertex = 0;
  Point3 at;

  void look(const std::vector<Point3>& vertices, double Point3::*axis) {
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const exact::Dyadic v = exact::to_dyadic(vertices[k].*axis);
      if (v.mantissa == 0 || v.exponent >= exponent) continue;
      exponent = v.exponent, vertex = k, at = vertices[k];
    }
  }
};

/// The bits of coordinates in units of 2^exponent.
int bits_of(const std::vector<Point3>& vertices, double Point3::*axis, int exponent) {
  const auto [low, high] = std::minmax_element(vertices.begin(), vertices.end(),
                                               [&](const Point3& a, const Point3& b) { return a.*axis < b.*axis; });
  const double a = (*low).*axis, b = (*high).*axis;
  return exact::bits_needed(a, b, exact::grid_center(a, b, exponent), exponent);
}

}  // namespace

GridNeed grid_need(const std::vector<Point3>& p, const std::vector<Point3>& q) {
  GridNeed most;
  for (const Axis& axis : {Axis{'x', &Point3::x}, Axis{'y', &Point3::y}, Axis{'z', &Point3::z}}) {
    Finest finest;
    finest.look(p, axis.coordinate);
    finest.look(q, axis.coordinate);
    if (finest.exponent == 2000) continue;
    const int bits =
        std::max(bits_of(p, axis.coordinate, finest.exponent), bits_of(q, axis.coordinate, finest.exponent));
    if (bits > most.bits) most = {bits, axis.name, finest.vertex, finest.at};
  }
  return most;
}

std::optional<Error> grid_error(const std::vector<Point3>& p, const std::vector<Point3>& q) {
  const GridNeed need = grid_need(p, q);
  if (need.bits <= kMostGridBits) return std::nullopt;
  Error error{ErrorCode::unsupported_operand,
              "coordinates of more than " + std::to_string(kMostGridBits) +
                  " bits on the operands' common grid: " + std::to_string(need.bits) + " along " + need.axis +
                  ", where this vertex has the smallest digit and others are far away",
              {}};
  error.evidence.vertex = static_cast<std::int64_t>(need.vertex);
  error.evidence.x = need.at.x, error.evidence.y = need.at.y, error.evidence.z = need.at.z;
  return error;
}

}  // namespace dymsum::spatial
