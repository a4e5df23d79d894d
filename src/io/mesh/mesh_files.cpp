#include "io/mesh/mesh_files.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/doubles.h"
#include "dymsum/mesh_io.h"
#include "dymsum/region_io.h"
#include "exact/orient.h"
#include "io/archive.h"
#include "io/read_file.h"

namespace dymsum::io {

FaceEdges::FaceEdges(const std::vector<Face>& faces) {
  for (const Face& face : faces) {
    for (std::size_t k = 0; face.size() >= 3 && k < face.size(); ++k)
      sorted_.push_back(std::minmax(face[k], face[(k + 1) % face.size()]));
  }
  std::sort(sorted_.begin(), sorted_.end());
}

bool FaceEdges::has(const Face& segment) const {
  const std::pair<std::uint32_t, std::uint32_t> ends = std::minmax(segment[0], segment[1]);
  return std::binary_search(sorted_.begin(), sorted_.end(), ends);
}

}  // namespace dymsum::io

namespace dymsum {

// What leads from a path to a mesh and back: format by extension, and the readers and writers behind it.

namespace {

MeshFile read_format(const io::Source& source, MeshFormat format) {
  switch (format) {
    case MeshFormat::off:
      return {io::read_off({io::PlainText(source.text).view(), source.file})};
    case MeshFormat::obj:
      return {io::read_obj({io::PlainText(source.text).view(), source.file})};
    case MeshFormat::stl:
      return {io::read_stl(source)};
    case MeshFormat::ply:
      return {io::read_ply(source)};
    case MeshFormat::three_mf:
      return io::read_3mf(source);
    case MeshFormat::glb:
      break;
  }
  return {io::read_glb(source)};
}

}  // namespace

Result<MeshFormat> mesh_format(std::string_view path) {
  const std::string text = io::extension(path);
  if (text == ".off") return MeshFormat::off;
  if (text == ".obj") return MeshFormat::obj;
  if (text == ".stl") return MeshFormat::stl;
  if (text == ".ply") return MeshFormat::ply;
  if (text == ".glb") return MeshFormat::glb;
  if (text == ".3mf") return MeshFormat::three_mf;
  return io::file_error(ErrorCode::unsupported_format, "the extension is none of .off, .obj, .stl, .ply, .glb, .3mf",
                        path);
}

Result<MeshData> parse_mesh(std::string_view bytes, MeshFormat format, std::string_view file) {
  Result<MeshFile> parsed = parse_mesh_file(bytes, format, file);
  if (!parsed) return parsed.error();
  return std::move(parsed).value().data;
}

Result<MeshData> read_mesh(const std::string& path) {
  Result<MeshFile> read = read_mesh_file(path);
  if (!read) return read.error();
  return std::move(read).value().data;
}

Result<MeshFile> parse_mesh_file(std::string_view bytes, MeshFormat format, std::string_view file) {
  try {
    return read_format({bytes, file}, format);
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

Result<MeshFile> read_mesh_file(const std::string& path) {
  const Result<MeshFormat> format = mesh_format(path);
  if (!format && io::is_directory(path)) return io::read_file(path).error();
  if (!format) return format.error();
  const Result<std::string> bytes = io::read_file(path);
  if (!bytes) return bytes.error();
  return parse_mesh_file(*bytes, *format, path);
}

std::string format_mesh(const MeshData& mesh, MeshFormat format, std::span<const FaceColour> colours) {
  switch (format) {
    case MeshFormat::off:
      return io::write_off(mesh, colours);
    case MeshFormat::obj:
      return io::write_obj(mesh);
    case MeshFormat::stl:
      return io::write_stl(mesh);
    case MeshFormat::ply:
      return io::write_ply(mesh, colours);
    case MeshFormat::three_mf:
      return io::write_3mf(mesh);
    case MeshFormat::glb:
      break;
  }
  return io::write_glb(mesh, {colours, {}});
}

Result<std::size_t> write_mesh(const Mesh& mesh, const std::string& path) {
  const Result<MeshFormat> format = mesh_format(path);
  if (!format) return format.error();
  if (std::optional<Error> error = rounding_error(mesh, *format)) {
    error->evidence.file = path;
    return *std::move(error);
  }
  const std::string bytes = format_mesh(mesh, *format);
  const Result<void> written = write_file(path, bytes);
  if (!written) return written.error();
  return bytes.size();
}

// What single precision does to a solid.

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
