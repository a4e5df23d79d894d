// The boundary of an obstacle as triangles.
#include "dymsum/obstacle_mesh.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_mesh_options(nb::module_& m) {
  Record<ObstacleMeshOptions> options(m, "ObstacleMeshOptions", "Options of obstacle_mesh.");
  options.def(
      "__init__",
      [](ObstacleMeshOptions* self, double tolerance, Progress progress) {
        new (self) ObstacleMeshOptions{tolerance, std::move(progress)};
      },
      "tolerance"_a = 1e-3, "progress"_a = nb::none());
  options.option("tolerance", &ObstacleMeshOptions::tolerance, "largest distance, as a share of the extent")
      .option("progress", &ObstacleMeshOptions::progress);
}

void bind_triangles(nb::module_& m) {
  Record<ObstacleTriangle>(m, "ObstacleTriangle", "A triangle, counter-clockwise seen from the free side.")
      .field("vertices", &ObstacleTriangle::vertices)
      .field("patch", &ObstacleTriangle::patch)
      .field("closing", &ObstacleTriangle::closing);
  Record<ObstacleMesh>(m, "ObstacleMesh", "Triangles from theta = -pi to pi.")
      .field("vertices", &ObstacleMesh::vertices)
      .field("triangles", &ObstacleMesh::triangles)
      .field("seam", &ObstacleMesh::seam, "(at -pi, at pi): the same position")
      .field("extent", &ObstacleMesh::extent)
      .field("tolerance", &ObstacleMesh::tolerance)
      .def_prop_ro(
          "configurations",
          [](nb::handle_t<ObstacleMesh> self) {
            return view_of<3>(std::span<const Configuration>(nb::inst_ptr<ObstacleMesh>(self)->vertices), self);
          },
          "The vertices as a view of shape (n, 3): x, y, theta.");
  Record<MeshClosure>(m, "MeshClosure", "How far a mesh is closed.")
      .field("edges", &MeshClosure::edges)
      .field("open", &MeshClosure::open)
      .field("crowded", &MeshClosure::crowded)
      .field("closing_area", &MeshClosure::closing_area)
      .def("watertight", &MeshClosure::watertight);
}

}  // namespace

void bind_obstacle_mesh(nb::module_& m) {
  bind_mesh_options(m);
  bind_triangles(m);
  m.def(
      "obstacle_mesh",
      [](const CspaceObstacle& obstacle, const ObstacleMeshOptions& options) {
        return run_with(options, [&](const ObstacleMeshOptions& own) { return obstacle_mesh(obstacle, own); });
      },
      "obstacle"_a, "options"_a = ObstacleMeshOptions(),
      R"doc(A closed mesh of the obstacle's boundary. Raises Error: out_of_range for the tolerance; cancelled.

>>> from dymsum import CspaceObstacle, closure, obstacle_mesh, shapes
>>> obstacle = CspaceObstacle(shapes.rectangle(-1, -0.25, 1, 0.25), shapes.rectangle(0, 0, 4, 4))
>>> closure(obstacle_mesh(obstacle)).watertight()
True
)doc");
  m.def("closure", &closure, "mesh"_a);
  m.def("enclosed_volume", &enclosed_volume, "mesh"_a, "The integral over theta of the area of the slices.");
  m.def("mesh_data", &mesh_data, "mesh"_a, "For files: z is theta times extent / (2 pi).");
  m.def("capped_mesh_data", &capped_mesh_data, "mesh"_a, "The same as a closed surface in space.");
}

}  // namespace dymsum::python
