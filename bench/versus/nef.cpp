// CGAL's Nef_polyhedron_3 Minkowski sum, exact, of closed operands.
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

Nef nef_of(const MeshData& mesh) {
  Surface surface;
  for (const Point3& v : mesh.vertices) surface.add_vertex(Kernel::Point_3(v.x, v.y, v.z));
  for (const Face& f : mesh.faces) {
    std::vector<Surface::Vertex_index> corners;
    for (const std::uint32_t v : f) corners.push_back(Surface::Vertex_index(v));
    surface.add_face(corners);
  }
  return Nef(surface);
}

NefAnswer sum_of(Nef a, Nef b) {
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

}  // namespace

NefAnswer cgal_nef_sum(const std::vector<Point3>& p, const std::vector<Point3>& q) {
  return sum_of(nef_of(p), nef_of(q));
}
NefAnswer cgal_nef_sum_of_solids(const MeshData& p, const MeshData& q) { return sum_of(nef_of(p), nef_of(q)); }

}  // namespace dymsum::bench
