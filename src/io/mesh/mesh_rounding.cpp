// What single precision does to a solid.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/doubles.h"
#include "dymsum/mesh_io.h"
#include "exact/orient.h"
#include "io/archive.h"
#include "io/mesh/mesh_readers.h"

namespace dymsum {
namespace {

/// The mesh in single precision, or the vertex that is past the range.
Result<MeshData> in_singles(MeshData data) {
  for (std::size_t v = 0; v < data.vertices.size(); ++v) {
    Point3& p = data.vertices[v];
    for (double* c : {&p.x, &p.y, &p.z}) {
      *c = base::in_single(*c);
      if (std::isfinite(*c)) continue;
      Error error{ErrorCode::cannot_write, "a coordinate is past the range of single precision", {}};
      error.evidence.vertex = static_cast<std::int64_t>(v);
      return error;
    }
  }
  return data;
}

Error changed(Precision precision, const std::string& what, Evidence evidence) {
  const char* const where = precision == Precision::singles ? "in single precision, " : "split into triangles, ";
  return {ErrorCode::rounding_changed_topology, where + what, std::move(evidence)};
}

/// Vertices at one position are one, as the reader of .stl has it.
Result<Mesh> read_back(const Mesh& mesh, MeshData data) {
  return mesh.has_thin_parts() ? Mesh::with_thin_parts(std::move(data)) : Mesh::create(std::move(data));
}

/// Whether its corners are on no line.
bool has_area(const Face& face, const std::vector<Point3>& at) {
  const auto second = std::find_if(face.begin(), face.end(), [&](std::uint32_t v) { return at[v] != at[face[0]]; });
  return std::any_of(second, face.end(),
                     [&](std::uint32_t v) { return !exact::collinear(at[face[0]], at[*second], at[v]); });
}

}  // namespace

Precision precision_of(MeshFormat format) {
  return format == MeshFormat::stl || format == MeshFormat::glb ? Precision::singles : Precision::doubles;
}

std::optional<Error> rounding_error(const Mesh& mesh, MeshFormat format) {
  const Precision precision = precision_of(format);
  if (precision == Precision::doubles && format != MeshFormat::three_mf) return std::nullopt;
  if (format == MeshFormat::three_mf && !io::has_archives())
    return Error{ErrorCode::unsupported_format, "compressed files are written by the native program only", {}};
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    if (mesh.faces()[f].size() >= 3) continue;
    Error error{ErrorCode::cannot_write, "files of this format hold no points and no segments", {}};
    error.evidence.face = static_cast<std::int64_t>(f);
    return error;
  }
  if (format == MeshFormat::glb) return picture_error(mesh.data());
  MeshData triangles = triangulated(mesh).mesh.data();  // what a file would hold
  Result<MeshData> data = precision == Precision::singles ? in_singles(std::move(triangles)) : std::move(triangles);
  if (!data) return data.error();
  if (data->faces == mesh.faces() && data->vertices == mesh.vertices())
    return std::nullopt;  // the file holds the mesh itself
  const Result<Mesh> back = read_back(mesh, std::move(data).value());
  if (back) return std::nullopt;
  Evidence evidence = back.error().evidence;
  evidence.face.reset();  // of the triangles, not of the mesh's faces
  evidence.other_face.reset();
  return changed(precision, back.error().message, std::move(evidence));
}

std::optional<Error> picture_error(const MeshData& mesh) {
  const Result<MeshData> data = in_singles(mesh);
  if (!data) return data.error();
  const auto shows = [&](const Face& face) { return has_area(face, data->vertices); };
  if (data->faces.empty() || std::any_of(data->faces.begin(), data->faces.end(), shows)) return std::nullopt;
  return changed(Precision::singles, "no face has an area", {});
}

}  // namespace dymsum
