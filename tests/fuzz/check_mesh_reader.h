// What must hold for every file of a mesh that a reader is given, whatever it contains.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "dymsum/mesh_io.h"
#include "fuzz/text_lines.h"

namespace dymsum::fuzz {

/// A file of a format without lines after its header.
inline bool is_binary_file(std::string_view bytes, MeshFormat format) {
  return format == MeshFormat::stl || (format == MeshFormat::ply && bytes.find("binary") != std::string_view::npos);
}

/// Empty when all is well: an error has a file, a line inside the text (or a byte, where the file is binary) and a
/// sentence; what was read names existing vertices; valid meshes come back from the exact formats as they were.
inline std::string check_mesh_reader(std::string_view bytes, MeshFormat format) {
  const auto data = parse_mesh(bytes, format, "fuzzed");
  if (!data) {
    const Error& error = data.error();
    if (error.evidence.file != "fuzzed" || error.message.empty()) return "an error without file or sentence";
    const bool line = error.evidence.line && *error.evidence.line >= 1 && *error.evidence.line <= most_lines(bytes);
    const bool byte = is_binary_file(bytes, format) && error.message.find("(byte ") != std::string::npos;
    if (!line && !byte) return "an error without a line or a byte of the file";
    if (error.code != ErrorCode::malformed && error.code != ErrorCode::truncated &&
        error.code != ErrorCode::not_finite && error.code != ErrorCode::bad_index)
      return "an error of another room";
    return "";
  }
  for (const Face& face : data->faces) {
    for (const std::uint32_t v : face) {
      if (v >= data->vertices.size()) return "a vertex that does not exist";
    }
  }
  const auto repaired = repair(*data);
  if (repaired && !Mesh::create(repaired->mesh.data())) return "a repaired mesh is not valid";
  const auto mesh = Mesh::with_thin_parts(*data);
  if (!mesh) return Mesh::create(*data) ? "a solid is refused where it may have parts without volume" : "";
  if (!Mesh::create(*data) && !mesh->has_thin_parts()) return "a set without thin parts is no solid";
  if (!Mesh::with_thin_parts(mesh->canonical().data())) return "a valid mesh is not when it is sorted";
  if (triangulated(*mesh).mesh.has_thin_parts() != mesh->has_thin_parts()) return "triangles lose thin parts";
  for (const MeshFormat other : {MeshFormat::off, MeshFormat::obj, MeshFormat::ply}) {
    const auto again = parse_mesh(format_mesh(*mesh, other), other, "again");
    if (!again) return "our own text is refused: " + again.error().to_string();
    if (*again != mesh->data()) return "a mesh changed on its way through a file";
  }
  return "";
}

/// For fuzz targets: aborts with the problem on standard error.
inline int require_good_mesh_reader(const unsigned char* data, std::size_t size, MeshFormat format) {
  const std::string problem = check_mesh_reader({reinterpret_cast<const char*>(data), size}, format);
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}

}  // namespace dymsum::fuzz
