// Files of meshes.
#include "dymsum/mesh_io.h"

#include <nanobind/stl/pair.h>

#include <algorithm>

#include "arguments.h"
#include "bind.h"
#include "enumeration.h"
#include "paths.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

/// GlbLook, owning what it shows.
struct Look {
  std::vector<FaceColour> colours;
  std::vector<std::pair<std::string, std::string>> notes;
  std::optional<MeshData> marks;
};

nb::bytes bytes_of(const std::string& text) { return nb::bytes(text.data(), text.size()); }

/// Faces of MeshData are not validated yet; writers and colours rely on them.
void require_indices(const MeshData& mesh, const std::vector<FaceColour>& colours) {
  const auto bad = [&](const Face& face) {
    return std::any_of(face.begin(), face.end(), [&](std::uint32_t v) { return v >= mesh.vertices.size(); });
  };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces[f].empty() || bad(mesh.faces[f]))
      throw nb::index_error("a face without vertices, or that names one that does not exist");
  }
  for (const FaceColour& colour : colours) {
    for (const std::uint32_t f : colour.faces) {
      if (f >= mesh.faces.size()) throw nb::index_error("a colour names a face that does not exist");
    }
  }
}

void bind_mesh_readers(nb::module_& m) {
  enumeration<MeshFormat>(m, "MeshFormat", "A format of mesh files; three_mf is .3mf.");
  m.def(
      "mesh_format", [](const PathArgument& path) { return take(mesh_format(path.text)); }, "path"_a);
  m.def(
      "parse_mesh",
      [](const nb::bytes& bytes, MeshFormat format, const std::string& file) {
        return take(parse_mesh({bytes.c_str(), bytes.size()}, format, file));
      },
      "bytes"_a, "format"_a, "file"_a = "", "A whole file's bytes. Raises Error with line, or byte of binary formats.");
  m.def(
      "read_mesh", [](const PathArgument& path) { return take(read_mesh(path.text)); }, "path"_a,
      "MeshData of a file, not yet validated: for Mesh.create or repair.");
  Record<MeshFile>(m, "MeshFile", "A file's lists, and their unit.")
      .field("data", &MeshFile::data)
      .field("unit", &MeshFile::unit, "of its coordinates, where the file says it");
  m.def(
      "parse_mesh_file",
      [](const nb::bytes& bytes, MeshFormat format, const std::string& file) {
        return take(parse_mesh_file({bytes.c_str(), bytes.size()}, format, file));
      },
      "bytes"_a, "format"_a, "file"_a = "", "As parse_mesh, with the unit.");
  m.def(
      "read_mesh_file", [](const PathArgument& path) { return take(read_mesh_file(path.text)); }, "path"_a,
      "As read_mesh, with the unit.");
  m.def("precision_of", &precision_of, "format"_a);
}

void bind_mesh_writers(nb::module_& m) {
  Record<FaceColour>(m, "FaceColour", "One coloured group of faces: rgb from 0 to 1, indices of faces.")
      .constructible()
      .field("rgb", &FaceColour::rgb)
      .field("faces", &FaceColour::faces);
  const auto format_data = [](const MeshData& data, MeshFormat format, const std::vector<FaceColour>& colours) {
    require_indices(data, colours);
    return bytes_of(format_mesh(data, format, colours));
  };
  m.def("format_mesh", format_data, "mesh"_a, "format"_a, "colours"_a = nb::list());
  m.def(
      "format_mesh",
      [format_data](const MeshArgument& mesh, MeshFormat format, const std::vector<FaceColour>& colours) {
        return format_data(mesh->data(), format, colours);
      },
      "mesh"_a, "format"_a, "colours"_a = nb::list(), "The bytes of a file.");
  Record<Look>(m, "GlbLook", "What a .glb file can hold beside the mesh.")
      .constructible()
      .field("colours", &Look::colours)
      .field("notes", &Look::notes, "names and texts")
      .field("marks", &Look::marks, "a second mesh, MeshData, in red");
  m.def(
      "format_glb",
      [](const MeshDataArgument& mesh, const Look& look) {
        require_indices(*mesh, look.colours);
        if (look.marks) require_indices(*look.marks, {});
        return bytes_of(format_glb(*mesh, {look.colours, look.notes, look.marks ? &*look.marks : nullptr}));
      },
      "mesh"_a, "look"_a, "The bytes of a .glb file with colours, notes and marks.");
  m.def(
      "rounding_error", [](const MeshArgument& mesh, MeshFormat format) { return rounding_error(*mesh, format); },
      "mesh"_a, "format"_a,
      "None where a file of this format holds the solid, else the Error that tells what rounding did.");
  m.def(
      "picture_error",
      [](const MeshData& mesh) {
        require_indices(mesh, {});
        return picture_error(mesh);
      },
      "mesh"_a, "None where a .glb file shows the mesh, else an Error.");
  m.def(
      "write_mesh",
      [](const MeshArgument& mesh, const PathArgument& path) { return take(write_mesh(*mesh, path.text)); }, "mesh"_a,
      "path"_a,
      "Replaces a file as a whole and returns its size. Raises Error: cannot_write, rounding_changed_topology.");
}

}  // namespace

void bind_mesh_io(nb::module_& m) {
  bind_mesh_readers(m);
  bind_mesh_writers(m);
}

}  // namespace dymsum::python
