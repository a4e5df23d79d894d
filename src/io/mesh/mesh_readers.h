// The readers and writers behind mesh_io.h. Readers throw ReadFailure.
//
// They are our own rather than a library's because every error has to name the line, and because what a file announces
// must never decide how much memory is taken: a reader reserves no more than the rest of the file can fill.
#pragma once

#include <span>
#include <string>

#include "dymsum/mesh_io.h"
#include "io/source.h"

namespace dymsum::io {

MeshData read_off(const Source& source);
MeshData read_obj(const Source& source);
MeshData read_stl(const Source& source);
MeshData read_ply(const Source& source);
MeshData read_glb(const Source& source);
MeshData read_3mf(const Source& source);

/// Vertices at exactly the same position become the first of them, as a mesh without shared vertices needs.
void merge_equal_vertices(MeshData& data);

std::string write_off(const MeshData& data, std::span<const FaceColour> colours);
std::string write_obj(const MeshData& data);
std::string write_stl(const MeshData& data);
std::string write_ply(const MeshData& data, std::span<const FaceColour> colours);
/// Empty without archives (io/archive.h).
std::string write_3mf(const MeshData& data);
std::string write_glb(const MeshData& data, const GlbLook& look);

/// The nearest single-precision number; the largest finite one where the nearest is infinite.
float to_float(double value);
/// Returns per face the index of the last colour that names it, or colours.size().
std::vector<std::size_t> colour_of_faces(const MeshData& data, std::span<const FaceColour> colours);
/// A colour's part as 0..255.
int colour_byte(double part);

}  // namespace dymsum::io
