// Solids bounded by polygons.
#include "dymsum/mesh.h"

#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/volume_text.h"
#include "enumeration.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

[[noreturn]] void raise_index(std::size_t face, const char* message) {
  Evidence evidence;
  evidence.face = static_cast<std::int64_t>(face);
  throw ErrorRaised({ErrorCode::bad_index, message, evidence});
}

std::uint32_t index_of(std::int64_t index, std::size_t face) {
  if (index < 0 || index > 0xffffffff) raise_index(face, "a face names a vertex that does not exist");
  return static_cast<std::uint32_t>(index);
}

std::uint32_t index_of(nb::handle item, std::size_t face) {
  if (!PyIndex_Check(item.ptr())) raise_index(face, "an index of a face is no integer");
  const nb::object number = nb::steal(PyNumber_Index(item.ptr()));
  if (!number.is_valid()) throw nb::python_error();
  int far = 0;
  const long long index = PyLong_AsLongLongAndOverflow(number.ptr(), &far);
  return index_of(far ? -1 : static_cast<std::int64_t>(index), face);
}

std::vector<Face> faces_of_lists(nb::handle faces) {
  std::vector<Face> all;
  const auto add = [&](nb::handle item) {
    all.back().push_back(index_of(item, all.size() - 1));
    return true;
  };
  const auto read = [&](nb::handle face) {
    all.emplace_back();
    return each_item(face, add);
  };
  if (!each_item(faces, read)) throw nb::type_error("faces are sequences of indices, and no text");
  return all;
}

/// Faces of one size from an array of shape (n, k), or a list of lists of indices.
std::vector<Face> faces_of(nb::handle faces) {
  nb::ndarray<nb::ro, nb::device::cpu> any;
  nb::ndarray<const std::int64_t, nb::ndim<2>, nb::device::cpu> array;
  const bool is_array = nb::ndarray_check(faces) && nb::try_cast(faces, any, false) && nb::try_cast(faces, array, true);
  if (!is_array) return faces_of_lists(faces);
  const auto code = static_cast<nb::dlpack::dtype_code>(any.dtype().code);
  if (any.size() && code != nb::dlpack::dtype_code::Int && code != nb::dlpack::dtype_code::UInt) {
    raise_index(0, "an index of a face is no integer");
  }
  const auto at = array.view();
  std::vector<Face> all(array.shape(0), Face(array.shape(1)));
  for (std::size_t f = 0; f < array.shape(0); ++f) {
    for (std::size_t k = 0; k < array.shape(1); ++k) all[f][k] = index_of(at(f, k), f);
  }
  return all;
}

MeshData mesh_data_of(const Rows<3>& vertices, nb::handle faces) {
  static_assert(sizeof(Point3) == 3 * sizeof(double));
  const auto* first = reinterpret_cast<const Point3*>(vertices.data);
  return {{first, first + vertices.size}, faces_of(faces)};
}

/// The triangles of a mesh, shape (n, 3).
Array<std::uint32_t> triangles_of(const Mesh& mesh) {
  std::vector<std::uint32_t> indices;
  const TriangulatedMesh split = triangulated(mesh);
  for (const Face& face : split.mesh.faces()) {
    if (face.size() == 3) indices.insert(indices.end(), face.begin(), face.end());
  }
  return array_of(std::move(indices), 3);
}

template <class T>
Points3View vertices_view(nb::handle_t<T> self, const std::vector<Point3>& vertices) {
  return view_of<3>(std::span<const Point3>(vertices), self);
}

void bind_mesh_data(nb::module_& m) {
  nb::class_<MeshData> data(m, "MeshData", "The plain lists that a mesh is made from, not yet validated.");
  data.def(
          "__init__",
          [](MeshData* self, const Rows<3>& vertices, const nb::object& faces) {
            new (self) MeshData(mesh_data_of(vertices, faces));
          },
          "vertices"_a, "faces"_a, "From shape (n, 3), and shape (m, k) or lists of indices.")
      .def_prop_ro(
          "vertices",
          [](nb::handle_t<MeshData> self) { return vertices_view(self, nb::inst_ptr<MeshData>(self)->vertices); },
          "A view of shape (n, 3).")
      .def_ro("faces", &MeshData::faces, "Lists of vertex indices.")
      .def(
          "__eq__", [](const MeshData& a, const MeshData& b) { return a == b; }, nb::is_operator())
      .def("__repr__",
           [](const MeshData& self) {
             return "<MeshData: " + std::to_string(self.vertices.size()) + " vertices, " +
                    std::to_string(self.faces.size()) + " faces>";
           })
      .def("__reduce__", [](nb::handle_t<MeshData> self) {
        return nb::make_tuple(self.type(), nb::make_tuple(self.attr("vertices"), self.attr("faces")));
      });
  data.attr("__hash__") = nb::none();
}

void bind_mesh_reading(nb::class_<Mesh>& mesh) {
  mesh.def_prop_ro("data", &Mesh::data, nb::rv_policy::reference_internal)
      .def_prop_ro(
          "vertices", [](nb::handle_t<Mesh> self) { return vertices_view(self, nb::inst_ptr<Mesh>(self)->vertices()); },
          "A view of shape (n, 3).")
      .def_prop_ro(
          "faces", [](const Mesh& self) { return self.faces(); },
          "Lists of vertex indices, counter-clockwise from outside.")
      .def_prop_ro("triangles", &triangles_of, "The faces as triangles, shape (m, 3).")
      .def("empty", &Mesh::empty)
      .def(
          "volume", [](const Mesh& self) { return volume(self); }, "As the function of this name.")
      .def(
          "area", [](const Mesh& self) { return surface_area(self); }, "Of the surface, as surface_area.")
      .def(
          "bounds", [](const Mesh& self) { return bounds(self); }, "As the function of this name.")
      .def("shell_count", &Mesh::shell_count)
      .def("thin_faces", &Mesh::thin_faces)
      .def("has_thin_parts", &Mesh::has_thin_parts)
      .def("edge_count", &Mesh::edge_count)
      .def("triangle_count", &Mesh::triangle_count)
      .def("canonical", &Mesh::canonical, "The same solid written in one way.");
}

void bind_mesh_class(nb::module_& m) {
  nb::class_<Mesh> mesh(m, "Mesh", nb::dynamic_attr(),
                        R"doc(A valid mesh: the boundary of a closed solid, perhaps empty, perhaps with thin parts.

A mesh is made from a pair (vertices, faces) of shapes (n, 3) and (m, k), or lists of lists; from a trimesh object, or
anything with `vertices` and `faces`; from MeshData. Raises Error: not_finite, bad_index, too_few_vertices,
repeated_vertex, no_area, not_planar, self_crossing, not_closed, not_manifold, wrong_orientation, faces_cross, with face,
vertex and a position.

>>> from dymsum import Mesh, volume
>>> tetrahedron = Mesh(([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]))
>>> volume(tetrahedron) * 6
1.0
>>> tetrahedron.vertices.shape, tetrahedron.triangles.shape
((4, 3), (4, 3))
)doc");
  mesh.def(
          "__init__", [](Mesh* self, const MeshArgument& source) { new (self) Mesh(*source); }, "source"_a)
      .def(nb::init<>())
      .def_static(
          "create", [](MeshData data) { return take(Mesh::create(std::move(data))); }, "data"_a)
      .def_static(
          "with_thin_parts", [](MeshData data) { return take(Mesh::with_thin_parts(std::move(data))); }, "data"_a,
          "The union of a solid and points, segments, polygons and open surfaces.")
      .def(
          "__eq__", [](const Mesh& a, const Mesh& b) { return a == b; }, nb::is_operator(),
          "Equality of canonical forms.")
      .def("__bool__", [](const Mesh& self) { return !self.empty(); })
      .def("__repr__",
           [](const Mesh& self) {
             return "<Mesh: " + std::to_string(self.vertices().size()) + " vertices, " +
                    std::to_string(self.faces().size()) + " faces, " + std::to_string(self.shell_count()) + " shells>";
           })
      .def("__reduce__",
           [](nb::handle_t<Mesh> self) {
             const char* how = nb::inst_ptr<Mesh>(self)->has_thin_parts() ? "with_thin_parts" : "create";
             return nb::make_tuple(self.type().attr(how), nb::make_tuple(self.attr("data")));
           })
      .def(
          "to_trimesh",
          [](nb::handle_t<Mesh> self) { return nb::module_::import_("dymsum._convert").attr("to_trimesh")(self); },
          "The triangles as a trimesh object (needs trimesh).")
      .def(
          "to_glb",
          [](nb::handle_t<Mesh> self) { return nb::module_::import_("dymsum._display").attr("solid_glb")(self); },
          nb::sig("def to_glb(self) -> bytes"), "The bytes of a .glb file.")
      .def("_repr_svg_",
           [](nb::handle_t<Mesh> self) { return nb::module_::import_("dymsum._display").attr("solid_svg")(self); });
  mesh.attr("__hash__") = nb::none();
  bind_mesh_reading(mesh);
}

void bind_mesh_repair(nb::module_& m) {
  Record<MeshRepairReport>(m, "MeshRepairReport", "What repair changed, as counts.")
      .field("duplicate_vertices", &MeshRepairReport::duplicate_vertices)
      .field("unused_vertices", &MeshRepairReport::unused_vertices)
      .field("degenerate_faces", &MeshRepairReport::degenerate_faces)
      .field("needles", &MeshRepairReport::needles)
      .field("split_edges", &MeshRepairReport::split_edges)
      .field("largest_gap", &MeshRepairReport::largest_gap, "how far a vertex was from the edge that was split at it")
      .field("cracks", &MeshRepairReport::cracks, "vertices of open edges that became one that was next to them")
      .field("largest_crack", &MeshRepairReport::largest_crack)
      .field("holes", &MeshRepairReport::holes, "small loops of open edges that got triangles")
      .field("split_faces", &MeshRepairReport::split_faces)
      .field("reversed_shells", &MeshRepairReport::reversed_shells)
      .field("cavities", &MeshRepairReport::cavities)
      .field("reversed_faces", &MeshRepairReport::reversed_faces)
      .field("membranes", &MeshRepairReport::membranes)
      .field("united", &MeshRepairReport::united, "whether faces crossed or touched, and what they bound was united")
      .field("united_crossings", &MeshRepairReport::united_crossings)
      .field("united_distance", &MeshRepairReport::united_distance,
             "how far points moved where rounding needed merging")
      .def("changed", &MeshRepairReport::changed)
      .def("to_string", &MeshRepairReport::to_string);
  Record<RepairedMesh>(m, "RepairedMesh", "A repaired mesh and what was changed.")
      .field("mesh", &RepairedMesh::mesh)
      .field("report", &RepairedMesh::report);
  m.def(
      "repair", [](const MeshDataArgument& data) { return take(repair(*data)); }, "data"_a,
      "The named repair: merges vertices, drops unused ones and faces without area, splits edges at vertices of their "
      "neighbours and faces that are not plane, orients.");
  m.def(
      "repair_with_thin_parts", [](const MeshDataArgument& data) { return take(repair_with_thin_parts(*data)); },
      "data"_a, "The same for Mesh.with_thin_parts: points, segments and open surfaces stay.");
  m.def(
      "convexity_error", [](const MeshArgument& mesh) { return convexity_error(*mesh); }, "mesh"_a,
      "None for a convex solid, else the Error not_convex with the reflex edge.");
}

void bind_hulls(nb::module_& m) {
  Record<HullReport>(m, "HullReport", "What taking the hull changed.")
      .field("vertices", &HullReport::vertices)
      .field("inside_vertices", &HullReport::inside_vertices)
      .field("unused_vertices", &HullReport::unused_vertices)
      .field("deviation", &HullReport::deviation, "no point of the old surface is further below the hull's")
      .def("to_string", &HullReport::to_string);
  Record<HulledMesh>(m, "HulledMesh", "A hull and how far the solid was from it.")
      .field("mesh", &HulledMesh::mesh)
      .field("report", &HulledMesh::report);
  m.def(
      "convex_hull",
      [](const Rows<3>& points) {
        const auto* first = reinterpret_cast<const Point3*>(points.data);
        return take(without_gil([&] { return convex_hull({first, points.size}); }));
      },
      "points"_a,
      R"doc(The exact hull of points, shape (n, 3). Raises Error: not_finite; no_area when all lie in one plane.

>>> from dymsum import convex_hull
>>> convex_hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0.1, 0.1, 0.1)])
<Mesh: 4 vertices, 4 faces, 1 shells>
)doc");
  m.def(
      "hulled", [](const MeshDataArgument& data) { return take(hulled(*data)); }, "data"_a,
      "The exact hull of a solid that is convex but for rounding, and how far it was from it.");
  m.def(
      "translated_hull",
      [](const MeshArgument& mesh, double dx, double dy, double dz) {
        return take(translated_hull(*mesh, dx, dy, dz));
      },
      "mesh"_a, "dx"_a, "dy"_a, "dz"_a, "A convex solid moved, convex wherever it goes.");
}

void bind_mesh_functions(nb::module_& m) {
  Record<TriangulatedMesh>(m, "TriangulatedMesh", "Faces split into triangles of their own vertices.")
      .field("mesh", &TriangulatedMesh::mesh)
      .field("face", &TriangulatedMesh::face, "of every triangle the face that it is part of");
  m.def(
      "triangulated", [](const MeshArgument& mesh) { return triangulated(*mesh); }, "mesh"_a);
  enumeration<Precision>(m, "Precision", "How exactly a file holds coordinates.");
  m.def(
      "volume", [](const MeshArgument& mesh) { return volume(*mesh); }, "mesh"_a, R"doc(The exact volume, rounded once.

>>> from dymsum import solids, volume
>>> volume(solids.box(0, 0, 0, 1, 2, 3))
6.0
)doc");
  m.def(
      "surface_area", [](const MeshArgument& mesh) { return surface_area(*mesh); }, "mesh"_a);
  m.def(
      "volume_text", [](const MeshArgument& mesh) { return volume_text(*mesh); }, "mesh"_a);
  m.def(
      "surface_text", [](const MeshArgument& mesh) { return surface_text(*mesh); }, "mesh"_a);
  m.def(
      "bounds", [](const MeshArgument& mesh) { return bounds(*mesh); }, "mesh"_a,
      "[min x, min y, min z, max x, max y, max z]; zeros for the empty mesh.");
  m.def(
      "negated", [](const MeshArgument& mesh) { return negated(*mesh); }, "mesh"_a, "-mesh. Exact.");
  m.def(
      "translated",
      [](const MeshArgument& mesh, double dx, double dy, double dz) { return take(translated(*mesh, dx, dy, dz)); },
      "mesh"_a, "dx"_a, "dy"_a, "dz"_a, "mesh + (dx, dy, dz), each coordinate rounded once.");
  m.def(
      "scaled",
      [](const MeshArgument& mesh, double sx, double sy, double sz) { return take(scaled(*mesh, sx, sy, sz)); },
      "mesh"_a, "sx"_a, "sy"_a, "sz"_a, "diag(sx, sy, sz) mesh, each coordinate rounded once.");
}

}  // namespace

void bind_mesh(nb::module_& m) {
  bind_mesh_data(m);
  bind_mesh_class(m);
  bind_mesh_repair(m);
  bind_hulls(m);
  bind_mesh_functions(m);
}

}  // namespace dymsum::python
