#include "spatial/sum/grid_error.h"

#include <algorithm>
#include <string>

#include "exact/grid.h"

namespace dymsum::spatial {

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
