// What single precision does to a solid.
#include <algorithm>
#include <cmath>
#include <utility>

#include "dymsum/mesh_io.h"
#include "io/mesh/mesh_readers.h"
#include "spatial/mesh/edge_order.h"
#include "spatial/mesh/six_volume.h"

namespace dymsum {
namespace {

/// In single precision, or the vertex that is past the range.
Result<MeshData> in_singles(MeshData data) {
  for (std::size_t v = 0; v < data.vertices.size(); ++v) {
    Point3& p = data.vertices[v];
    for (double* c : {&p.x, &p.y, &p.z}) {
      *c = static_cast<double>(static_cast<float>(*c));
      if (std::isfinite(*c)) continue;
      Error error{ErrorCode::cannot_write, "a coordinate is past the range of single precision", {}};
      error.evidence.vertex = static_cast<std::int64_t>(v);
      return error;
    }
  }
  return data;
}

Error changed(std::string what, Evidence evidence) {
  return {ErrorCode::rounding_changed_topology, "in single precision, " + std::move(what), std::move(evidence)};
}

/// Requires the same faces.
std::optional<Error> vanished_shell(const Mesh& mesh, const MeshData& rounded) {
  if (mesh.has_thin_parts()) return std::nullopt;  // a picture
  const MeshData& exact = mesh.data();
  const spatial::Shells shells = spatial::find_shells(spatial::half_edges(exact));
  if (spatial::shell_signs(exact, shells) == spatial::shell_signs(rounded, shells)) return std::nullopt;
  return changed("a shell encloses no volume", {});
}

}  // namespace

Precision precision_of(MeshFormat format) {
  return format == MeshFormat::stl || format == MeshFormat::glb ? Precision::singles : Precision::doubles;
}

std::optional<Error> rounding_error(const Mesh& mesh, MeshFormat format) {
  if (precision_of(format) == Precision::doubles) return std::nullopt;
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    if (mesh.faces()[f].size() >= 3) continue;
    Error error{ErrorCode::cannot_write, "files of this format hold no points and no segments", {}};
    error.evidence.face = static_cast<std::int64_t>(f);
    return error;
  }
  const Mesh split = triangulated(mesh).mesh;
  const MeshData& triangles = split.data();  // what a file would hold
  const Result<MeshData> data = in_singles(triangles);
  if (!data) return data.error();
  if (format == MeshFormat::glb) return vanished_shell(split, *data);
  // As the reader does: vertices at one place are one, and what no longer is a solid is refused.
  const Result<Mesh> back = mesh.has_thin_parts() ? Mesh::with_thin_parts(*data) : Mesh::create(*data);
  if (back) return std::nullopt;
  Evidence evidence = back.error().evidence;
  evidence.face.reset();  // of the triangles, not of the mesh's faces
  evidence.other_face.reset();
  return changed(back.error().message, std::move(evidence));
}

}  // namespace dymsum
