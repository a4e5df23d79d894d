// Files of meshes. Readers return plain data that is not yet validated, so that a caller can choose between
// Mesh::create (refuse) and repair (change and report).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/result.h"

namespace dymsum {

/// off: also its binary-free variants with colours or normals, which are skipped. obj: vertices, faces, lines (as
/// segments) and points; texture and normal indices, groups and materials are skipped; negative indices count from the
/// end. stl: text or binary; vertices at exactly the same position are merged. ply: text or binary of either byte
/// order; edges that are no face's are segments, further elements and properties are skipped. glb: the triangles of the
/// scene where its nodes place them, with z up; vertices at exactly the same position are merged. three_mf: what is
/// built, where it is placed, in the file's numbers whatever its unit. Points and segments are faces with one vertex
/// and with two (Mesh::with_thin_parts).
enum class MeshFormat { off, obj, stl, ply, glb, three_mf };

/// The format a path's extension names.
Result<MeshFormat> mesh_format(std::string_view path);

/// Reads a whole file's bytes. Errors: malformed, truncated, bad_index, not_finite, with file and line (of binary
/// formats: the byte). Memory is bounded by the size of `bytes`, whatever it announces.
Result<MeshData> parse_mesh(std::string_view bytes, MeshFormat format, std::string_view file = {});
/// A file may be compressed (.gz). Errors also: cannot_open, unsupported_format.
Result<MeshData> read_mesh(const std::string& path);

/// A file's lists, and the unit of its coordinates where it says one: of three_mf "mm", "cm", "m", "in", "ft" or "um".
/// (glTF's are metres by definition, which few files keep: nothing is said there.)
struct MeshFile {
  MeshData data;
  std::string unit = {};
};
Result<MeshFile> parse_mesh_file(std::string_view bytes, MeshFormat format, std::string_view file = {});
Result<MeshFile> read_mesh_file(const std::string& path);

/// One coloured group of a picture's faces, red, green and blue from 0 to 1 as screens show them (sRGB); `faces` are
/// indices of faces of the mesh.
struct FaceColour {
  std::array<double, 3> rgb{0.6, 0.75, 0.9};
  std::vector<std::uint32_t> faces;
};
/// The bytes of a file. Text formats and three_mf write coordinates that read back as the same doubles; stl and glb
/// round to single precision. Colours are used by glb, ply and off. Requires: faces name existing vertices. Faces of
/// more than three vertices need not be plane to the last bit, as those of rounded sums.
std::string format_mesh(const MeshData& mesh, MeshFormat format, std::span<const FaceColour> colours = {});
inline std::string format_mesh(const Mesh& mesh, MeshFormat format, std::span<const FaceColour> colours = {}) {
  return format_mesh(mesh.data(), format, colours);
}
/// What a glb file can hold beside the mesh.
struct GlbLook {
  std::span<const FaceColour> colours;
  /// Names and texts, kept in the file as extras of its asset.
  std::span<const std::pair<std::string, std::string>> notes;
  /// A second mesh, in red: what has to be seen through the first one, which is drawn half transparent then.
  const MeshData* marks = nullptr;
};
std::string format_glb(const MeshData& mesh, const GlbLook& look);
/// stl and glb hold single precision.
Precision precision_of(MeshFormat format);
/// Nothing where a file of this format holds the solid: off, obj and ply always do. three_mf holds triangles alone:
/// cannot_write for points and segments, rounding_changed_topology where faces that are not plane to the last bit split
/// into triangles that cross, unsupported_format without zlib and libzip (WebAssembly). Of stl and glb what rounding to
/// single precision did to it: cannot_write for points and segments, and past its range; rounding_changed_topology in
/// stl where the file would not read back as a valid mesh. Of glb as picture_error.
std::optional<Error> rounding_error(const Mesh& mesh, MeshFormat format);
/// Nothing where a glb file shows the mesh, whatever rounding does to parts of it. Else cannot_write where a coordinate
/// is past the range of single precision, rounding_changed_topology where no face would have an area.
std::optional<Error> picture_error(const MeshData& mesh);
/// Replaces the file as a whole. Errors: cannot_write, unsupported_format, and as rounding_error.
Result<std::size_t> write_mesh(const Mesh& mesh, const std::string& path);

}  // namespace dymsum
