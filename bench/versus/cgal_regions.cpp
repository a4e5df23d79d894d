// CGAL's Boolean operations of regions with exact constructions (Polygon_set_2, what Boolean_set_operations_2 calls),
// of files with one polygon a line, "x y x y ...": prints the least milliseconds of the runs and the area. All polygons
// of the files are united, or those of the second are intersected with, or taken from, that of the first. cgal_regions
// A B union|intersect|subtract RUNS
#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;
using PolygonWithHoles = CGAL::Polygon_with_holes_2<Kernel>;
using Set = CGAL::Polygon_set_2<Kernel>;

namespace {

std::vector<Polygon> polygons_of(const char* path) {
  std::vector<Polygon> polygons;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream numbers(line);
    Polygon polygon;
    for (double x = 0, y = 0; numbers >> x >> y;) polygon.push_back({x, y});
    if (polygon.is_empty()) continue;
    if (polygon.orientation() == CGAL::CLOCKWISE) polygon.reverse_orientation();
    polygons.push_back(polygon);
  }
  return polygons;
}

std::vector<PolygonWithHoles> run(const std::string& operation, const std::vector<Polygon>& a,
                                  const std::vector<Polygon>& b) {
  Set set;
  if (operation == "union") {
    std::vector<Polygon> all = a;
    all.insert(all.end(), b.begin(), b.end());
    set.join(all.begin(), all.end());
  } else {
    set.insert(a[0]);
    if (operation == "intersect") set.intersection(b[0]);
    else set.difference(b[0]);
  }
  std::vector<PolygonWithHoles> made;
  set.polygons_with_holes(std::back_inserter(made));
  for (const PolygonWithHoles& polygon : made) {  // constructions are lazy
    for (const auto& v : polygon.outer_boundary().container()) v.exact();
    for (const Polygon& hole : polygon.holes())
      for (const auto& v : hole.container()) v.exact();
  }
  return made;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 5) return 1;
  const std::vector<Polygon> a = polygons_of(arguments[1]), b = polygons_of(arguments[2]);
  if (a.empty()) return 2;
  double least = std::numeric_limits<double>::infinity(), area = 0;
  for (int runs = std::atoi(arguments[4]); runs > 0; --runs) {
    const auto start = std::chrono::steady_clock::now();
    const std::vector<PolygonWithHoles> made = run(arguments[3], a, b);
    least =
        std::min(least, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    area = 0;
    for (const PolygonWithHoles& polygon : made) {
      area += CGAL::to_double(polygon.outer_boundary().area());
      for (const Polygon& hole : polygon.holes()) area += CGAL::to_double(hole.area());
    }
  }
  std::printf("%.6f %.17g\n", least, area);
}
