#include "coordinate_kinds.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "oracles/coordinate_kinds.h"

namespace dymsum::bench {
namespace {

constexpr double kLarger = 1 + 1 / 3000.0;

CoordinateKind of_the_tests(Coordinates kind) {
  switch (kind) {
    case Coordinates::grid:
      return CoordinateKind::grid;
    case Coordinates::decimals:
      return CoordinateKind::decimals;
    case Coordinates::single:
      return CoordinateKind::single_precision;
    case Coordinates::noise:
      return CoordinateKind::noise;
    case Coordinates::turned:
      return CoordinateKind::turned;
  }
  return CoordinateKind::grid;
}

Point times(double f, Point p) { return {f * p.x, f * p.y}; }
Point3 times(double f, Point3 p) { return {f * p.x, f * p.y, f * p.z}; }
template <class F>
Point each(Point p, F&& f) {
  return {f(p.x), f(p.y)};
}
template <class F>
Point3 each(Point3 p, F&& f) {
  return {f(p.x), f(p.y), f(p.z)};
}
double size_of(Point p) { return std::max(std::abs(p.x), std::abs(p.y)); }
double size_of(Point3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// Rounds the points of one shape.
class Rounding {
 public:
  /// The largest coordinate of a shape reports how many decimals it has: five digits that differ at least.
  Rounding(Coordinates kind, double size) : kind_(kind) {
    for (; size > 0 && size < 1 && units_ < 1e15; size *= 10) units_ *= 10;
  }
  template <class P>
  void operator()(P& p) {
    if (kind_ == Coordinates::decimals) {
      p = each(times(kLarger, p), [&](double v) { return std::nearbyint(v * units_) / units_; });
    } else {
      // The tests' shapes become a third as large.
      const bool shrinks = kind_ == Coordinates::single || kind_ == Coordinates::noise;
      p = of_kind(shrinks ? times(3 * kLarger, p) : p, of_the_tests(kind_), random_);
    }
  }

 private:
  Coordinates kind_;
  double units_ = 1e4;
  std::mt19937_64 random_{1};  // the same for every shape: equal ones stay equal
};

/// Every vertex of a region.
template <class Visit>
void visit(RegionData& data, Visit&& visit_point) {
  for (Part& part : data.parts) {
    for (Point& p : part.outer) visit_point(p);
    for (Ring& hole : part.holes)
      for (Point& p : hole) visit_point(p);
  }
  for (Polyline& line : data.polylines)
    for (Point& p : line) visit_point(p);
  for (Point& p : data.points) visit_point(p);
}

std::vector<Point3> rounded(std::vector<Point3> points, Coordinates kind) {
  double size = 0;
  for (const Point3& p : points) size = std::max(size, size_of(p));
  Rounding round(kind, size);
  for (Point3& p : points) round(p);
  return points;
}

}  // namespace

std::string name(Coordinates kind) {
  constexpr std::array kNames{"grid", "decimals", "single", "noise", "turned"};
  return kNames[static_cast<std::size_t>(kind)];
}

Result<Region> with_coordinates(const Region& region, Kind kind) {
  if (!kind) return region;
  RegionData data = region.data();
  double size = 0;
  visit(data, [&](const Point& p) { size = std::max(size, size_of(p)); });
  visit(data, Rounding(*kind, size));
  return Region::create(std::move(data));
}

Result<Mesh> with_coordinates(const Mesh& mesh, Kind kind) {
  if (!kind) return mesh;
  MeshData data = triangulated(mesh).mesh.data();
  data.vertices = rounded(std::move(data.vertices), *kind);
  return Mesh::create(std::move(data));
}

Result<Mesh> hull_with_coordinates(const Mesh& mesh, Kind kind) {
  return kind ? convex_hull(rounded(mesh.vertices(), *kind)) : mesh;
}

const char* const kKindUsage =
    "  --coordinates KIND|all\n"
    "                 the whole of it on shapes of that kind: grid, decimals, single, noise, turned; results go into\n"
    "                 a folder of that name in DIR\n"
    "  --off-grid     nothing but the table \"Off the grid\", the end of the default run; results: off-the-grid.md\n";

bool KindOptions::take(int argc, char** argv, int& i) {
  const std::string word = argv[i];
  if (word == "--off-grid") return off_grid = true;
  if (word != "--coordinates" || i + 1 == argc) return false;
  const std::string wanted = argv[++i];
  kinds.clear();
  for (const Coordinates kind : kCoordinates)
    if (wanted == "all" || wanted == name(kind)) kinds.push_back(kind);
  if (kinds.empty()) throw std::invalid_argument("no such coordinates: " + wanted + "\n" + kKindUsage);
  return true;
}

std::string KindOptions::folder(const std::string& results, Kind kind) {
  return results.empty() || !kind ? results : results + "/" + name(*kind);
}

}  // namespace dymsum::bench
