#include "planar/tier.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "dymsum/planar_sum.h"
#include "inputs.h"
#include "report.h"

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

/// Points that request the same tier as the region.
Region deciding_points(const Region& region) {
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

  RegionData points;
  points.points = deciding.points();
  return require(Region::create(std::move(points)));
}

/// The grid that solids need together.
class SolidGrid {
 public:
  void see(const Mesh& mesh) {
    for (const Point3& p : mesh.vertices()) {
      for (const double c : {p.x, p.y, p.z}) {
        unit_ = std::min(unit_, lowest_bit(c));
        largest_ = std::max(largest_, std::abs(c));
      }
    }
  }
  int bits() const {
    if (largest_ == 0) return 0;
    int exponent = 0;
    const bool power = std::frexp(largest_, &exponent) == 0.5;
    return std::max(1, exponent - (power ? 1 : 0) - unit_);
  }
  int tier() const { return solid_tier(bits()); }

 private:
  int unit_ = std::numeric_limits<int>::max();
  double largest_ = 0;
};

}  // namespace

int tier_of(const Region& region) {
  RegionData origin;
  origin.points = {Point{0, 0}};
  return tier_of(region, require(Region::create(std::move(origin))));
}

int tier_of(const Region& p, const Region& q) {
  return require(minkowski_sum(deciding_points(p), deciding_points(q))).stats.tier_bits;
}

int grid_bits(const Mesh& mesh) {
  SolidGrid grid;
  grid.see(mesh);
  return grid.bits();
}

int tier_of(const Mesh& mesh) {
  SolidGrid grid;
  grid.see(mesh);
  return grid.tier();
}

int tier_of(const Mesh& p, const Mesh& q) {
  SolidGrid grid;
  grid.see(p);
  grid.see(q);
  return grid.tier();
}

}  // namespace dymsum::cli
