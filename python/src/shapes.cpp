// Generators of planar shapes and of solids: the modules dymsum.shapes and dymsum.solids.
#include "dymsum/shapes.h"

#include "arguments.h"
#include "bind.h"
#include "dymsum/solids.h"
#include "record.h"

namespace dymsum::python {

using namespace nb::literals;

void bind_shapes(nb::module_& m) {
  nb::module_ s = m.def_submodule("_shapes", "Generators of planar test and demo shapes.");
  s.def("rectangle", &shapes::rectangle, "x0"_a, "y0"_a, "x1"_a, "y1"_a);
  s.def("demo_snap", &shapes::demo_snap, "size"_a,
        "A `snap` for shapes with coordinates up to this size: these have at most 24 bits.");
  s.def(
      "disc", &shapes::disc, "vertices"_a, "radius"_a, "snap"_a = 0.0,
      R"doc(A convex polygon on a circle. Its points are doubles within a few units of the last place. Of this and all round
shapes here `snap`, a power of two, rounds coordinates to its nearest multiples.

>>> from dymsum import shapes
>>> shapes.disc(8, 1, snap=1/8).parts[0].outer.tolist()[1]
[0.75, 0.75])doc");
  s.def("gear", &shapes::gear, "teeth"_a, "inner"_a, "outer"_a, "snap"_a = 0.0, "4 vertices a tooth.");
  s.def("grate", &shapes::grate, "bars"_a, "pitch"_a, "bar"_a, "length"_a,
        "A frame with `bars` - 1 rectangular holes.");
  s.def("comb", &shapes::comb, "teeth"_a, "pitch"_a, "tooth"_a, "length"_a);
  s.def("star", &shapes::star, "points"_a, "inner"_a, "outer"_a, "snap"_a = 0.0);
  s.def("noisy_star", &shapes::noisy_star, "vertices"_a, "noise"_a, "seed"_a);
  s.def("spiral", &shapes::spiral, "turns"_a, "vertices_per_turn"_a, "pitch"_a, "width"_a, "snap"_a = 0.0);
  s.def("letter_u", &shapes::letter_u, "width"_a, "height"_a, "thickness"_a);
  s.def("letter_l", &shapes::letter_l, "width"_a, "height"_a, "thickness"_a);
  s.def("pockets", &shapes::pockets, "holes"_a, "size"_a, "snap"_a = 0.0, "A plate with square holes of growing size.");
  s.def("random_polygon", &shapes::random_polygon, "vertices"_a, "holes"_a, "seed"_a);
}

void bind_solids(nb::module_& m) {
  nb::module_ s = m.def_submodule("_solids", "Generators of solid test and demo shapes.");
  s.attr("kDemoSnap") = solids::kDemoSnap;
  s.def("box", &solids::box, "x0"_a, "y0"_a, "z0"_a, "x1"_a, "y1"_a, "z1"_a, "snap"_a = 0.0,
        R"doc(6 quadrangles, with these very coordinates. Of this and all solids here `snap`, a power of two, rounds
coordinates to its nearest multiples.

>>> from dymsum import solids
>>> solids.box(0, 0, 0, 0.1, 1, 2).vertices[7].tolist()
[0.1, 1.0, 2.0]
>>> solids.box(0, 0, 0, 0.1, 1, 2, snap=1/8).vertices[7].tolist()
[0.125, 1.0, 2.0]
)doc");
  s.def("prism", &solids::prism, "base"_a, "height"_a, "snap"_a = 0.0,
        R"doc(Over a simple counter-clockwise ring, from z = 0.

>>> from dymsum import solids, volume
>>> volume(solids.prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 2))
10.0
)doc");
  s.def("tessellated_cube", &solids::tessellated_cube, "size"_a, "k"_a, "snap"_a = 0.0,
        "A cube about the origin, every face split into k x k squares of two triangles.");
  s.def("cone", &solids::cone, "sides"_a, "radius"_a, "height"_a, "snap"_a = 0.0, "2 sides - 2 triangles.");
  s.def("cylinder", &solids::cylinder, "sides"_a, "radius"_a, "height"_a, "snap"_a = 0.0, "4 sides - 4 triangles.");
  s.def("dipyramid", &solids::dipyramid, "sides"_a, "radius"_a, "height"_a, "snap"_a = 0.0, "2 sides triangles.");
  s.def("pyramid", &solids::pyramid, "sides"_a, "radius"_a, "height"_a, "snap"_a = 0.0, "2 sides - 2 triangles.");
  s.def("geodesic_sphere", &solids::geodesic_sphere, "frequency"_a, "radius"_a, "snap"_a = 0.0,
        R"doc(An icosahedron with every face split into frequency^2 triangles.

>>> from dymsum import solids
>>> solids.geodesic_sphere(2, 1)
<Mesh: 42 vertices, 80 faces, 1 shells>
)doc");
  s.def("ellipsoid", &solids::ellipsoid, "slices"_a, "stacks"_a, "rx"_a, "ry"_a, "rz"_a, "snap"_a = 0.0,
        "2 slices (stacks - 1) triangles.");
  s.def("triakis_icosahedron", &solids::triakis_icosahedron, "radius"_a, "snap"_a = 0.0, "60 triangles.");
  s.def("truncated_icosidodecahedron", &solids::truncated_icosidodecahedron, "radius"_a, "snap"_a = 0.0,
        "236 triangles.");
  s.def("rod", &solids::rod, "slices"_a, "stacks"_a, "radius"_a, "length"_a, "snap"_a = 0.0,
        "A capsule of 2 slices (stacks - 1) triangles; stacks are odd.");
  Record<solids::NamedMesh>(s, "NamedMesh", "A named mesh.")
      .field("name", &solids::NamedMesh::name)
      .field("mesh", &solids::NamedMesh::mesh);
  s.def("thesis_models", &solids::thesis_models, "Their coordinates are multiples of kDemoSnap.");
}

}  // namespace dymsum::python
