// What single precision does to a solid.
#include <algorithm>
#include <cmath>
#include <utility>

#include "dymsum/mesh_io.h"
#include "io/mesh/mesh_readers.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/six_volume.h"

namespace dymsum {
namespace {

/// The triangles that a file would hold, or the vertex that is past the range.
Result<MeshData> in_singles(const Mesh& mesh) {
  MeshData data = triangulated(mesh).mesh.data();
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

std::optional<Error> vanished_shell(const MeshData& data) {
  const spatial::Shells shells = spatial::find_shells(spatial::half_edges(data.faces));
  const std::vector<int> signs = spatial::shell_signs(data, shells);
  if (std::all_of(signs.begin(), signs.end(), [](int s) { return s > 0; })) return std::nullopt;
  return changed("a shell encloses no volume", {});
}

}  // namespace

Precision precision_of(MeshFormat format) {
  return format == MeshFormat::stl || format == MeshFormat::glb ? Precision::singles : Precision::doubles;
}

std::optional<Error> rounding_error(const Mesh& mesh, MeshFormat format) {
  if (precision_of(format) == Precision::doubles) return std::nullopt;
  const Result<MeshData> data = in_singles(mesh);
  if (!data) return data.error();
  if (format == MeshFormat::glb) return vanished_shell(*data);
  // As the reader does: vertices at one place are one, and what no longer is a solid is refused.
  const Result<Mesh> back = Mesh::create(*data);
  if (back) return std::nullopt;
  Evidence evidence = back.error().evidence;
  evidence.face.reset();  // of the triangles, not of the mesh's faces
  evidence.other_face.reset();
  return changed(back.error().message, std::move(evidence));
}

}  // namespace dymsum
