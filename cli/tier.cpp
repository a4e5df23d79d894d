#include "tier.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "dymsum/planar_sum.h"
#include "inputs.h"

namespace dymsum::cli {
namespace {

/// The exponent of the lowest set bit of a double: the finest grid it needs. Zero needs none.
int lowest_bit(double value) {
  if (value == 0) return std::numeric_limits<int>::max();
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  auto digits = static_cast<std::int64_t>(std::ldexp(std::abs(mantissa), 53));
  exponent -= 53;
  for (; digits % 2 == 0; digits /= 2) ++exponent;
  return exponent;
}

/// The vertices that decide the grid and its size: the extreme ones, and those with the finest coordinates.
class Deciding {
 public:
  void see(const Point& p) {
    if (first_ || p.x < low_x_.x) low_x_ = p;
    if (first_ || p.x > high_x_.x) high_x_ = p;
    if (first_ || p.y < low_y_.y) low_y_ = p;
    if (first_ || p.y > high_y_.y) high_y_ = p;
    if (first_ || lowest_bit(p.x) < lowest_bit(fine_x_.x)) fine_x_ = p;
    if (first_ || lowest_bit(p.y) < lowest_bit(fine_y_.y)) fine_y_ = p;
    first_ = false;
  }
  std::vector<Point> points() const {
    if (first_) return {};
    return {low_x_, high_x_, low_y_, high_y_, fine_x_, fine_y_};
  }

 private:
  bool first_ = true;
  Point low_x_, high_x_, low_y_, high_y_, fine_x_, fine_y_;
};

}  // namespace

int tier_of(const Region& region) {
  Deciding deciding;
  const auto see = [&](const std::vector<Point>& points) {
    for (const Point& p : points) deciding.see(p);
  };
  for (const Part& part : region.parts()) {
    see(part.outer);
    for (const Ring& hole : part.holes) see(hole);
  }
  for (const Polyline& line : region.polylines()) see(line);
  see(region.points());

  RegionData points, origin;
  points.points = deciding.points();
  origin.points = {Point{0, 0}};
  const Region p = require(Region::create(points));
  return require(minkowski_sum(p, require(Region::create(origin)))).stats.tier_bits;
}

int grid_bits(const Mesh& mesh) {
  int unit = std::numeric_limits<int>::max();
  double largest = 0;
  for (const Point3& p : mesh.vertices()) {
    for (const double c : {p.x, p.y, p.z}) {
      unit = std::min(unit, lowest_bit(c));
      largest = std::max(largest, std::abs(c));
    }
  }
  if (largest == 0) return 0;
  int exponent = 0;
  const bool power = std::frexp(largest, &exponent) == 0.5;
  return exponent - (power ? 1 : 0) - unit;
}

int tier_of(const Mesh& mesh) {
  const int bits = grid_bits(mesh);
  return bits <= 26 ? 26 : bits <= 54 ? 54 : 0;
}

}  // namespace dymsum::cli
