// CGAL's Nef_polyhedron_3 Minkowski sum, exact, as a witness for small pairs.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/minkowski_sum_3.h>

#include "versus/rival.h"
#include "versus/solid_rivals.h"

namespace dymsum::bench {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

/// Convex: the hull of the vertices, whose faces are then plane.
Nef nef_of(const std::vector<Point3>& vertices) {
  std::vector<Kernel::Point_3> points;
  for (const Point3& v : vertices) points.emplace_back(v.x, v.y, v.z);
  Surface hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  return Nef(hull);
}

}  // namespace

NefAnswer cgal_nef_sum(const std::vector<Point3>& p, const std::vector<Point3>& q) {
  Nef a = nef_of(p), b = nef_of(q);
  const double start = cpu_ms();
  const Nef sum = CGAL::minkowski_sum_3(a, b);
  NefAnswer answer;
  answer.ms = cpu_ms() - start;
  answer.vertices = sum.number_of_vertices();
  Surface mesh;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(sum, mesh, true);
  answer.volume = CGAL::to_double(CGAL::Polygon_mesh_processing::volume(mesh));
  return answer;
}

}  // namespace dymsum::bench
