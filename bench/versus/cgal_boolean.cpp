// CGAL's Boolean operations of solids by corefinement with exact constructions, of two OFF files of triangles: prints
// the least milliseconds of the runs and the volume. cgal_boolean P.off Q.off union|intersect|subtract RUNS
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/OFF.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Solid = CGAL::Surface_mesh<Kernel::Point_3>;

namespace {

Solid solid_of(const char* path) {
  std::ifstream file(path);
  Solid solid;
  if (!CGAL::IO::read_OFF(file, solid)) std::exit(2);
  return solid;
}

bool run(const std::string& operation, Solid& p, Solid& q, Solid& to) {
  if (operation == "union") return pmp::corefine_and_compute_union(p, q, to);
  if (operation == "intersect") return pmp::corefine_and_compute_intersection(p, q, to);
  return pmp::corefine_and_compute_difference(p, q, to);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 5) return 1;
  const Solid first = solid_of(arguments[1]), second = solid_of(arguments[2]);
  double least = std::numeric_limits<double>::infinity(), volume = 0;
  for (int runs = std::atoi(arguments[4]); runs > 0; --runs) {
    Solid p = first, q = second, made;  // they are changed
    const auto start = std::chrono::steady_clock::now();
    if (!run(arguments[3], p, q, made)) return 3;
    for (const auto v : made.vertices()) made.point(v).exact();  // constructions are lazy
    least =
        std::min(least, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    volume = CGAL::to_double(pmp::volume(made));
  }
  std::printf("%.6f %.17g\n", least, volume);
}
