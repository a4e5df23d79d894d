// What leads from a path to a mesh and back: format by extension, and the readers and writers behind it.
#include <optional>
#include <utility>

#include "dymsum/mesh_io.h"
#include "dymsum/region_io.h"
#include "io/mesh/mesh_readers.h"
#include "io/plain_text.h"
#include "io/read_file.h"

namespace dymsum {

namespace {

MeshData read_format(const io::Source& source, MeshFormat format) {
  switch (format) {
    case MeshFormat::off:
      return io::read_off({io::PlainText(source.text).view(), source.file});
    case MeshFormat::obj:
      return io::read_obj({io::PlainText(source.text).view(), source.file});
    case MeshFormat::stl:
      return io::read_stl(source);
    case MeshFormat::ply:
      return io::read_ply(source);
    case MeshFormat::three_mf:
      return io::read_3mf(source);
    case MeshFormat::glb:
      break;
  }
  return io::read_glb(source);
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
  try {
    return read_format({bytes, file}, format);
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

Result<MeshData> read_mesh(const std::string& path) {
  const Result<MeshFormat> format = mesh_format(path);
  if (!format && io::is_directory(path)) return io::read_file(path).error();
  if (!format) return format.error();
  const Result<std::string> bytes = io::read_file(path);
  if (!bytes) return bytes.error();
  return parse_mesh(*bytes, *format, path);
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

}  // namespace dymsum
