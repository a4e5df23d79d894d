// The readers and writers behind mesh_io.h. Readers throw ReadFailure.
//
// They are our own rather than a library's because every error has to name the line, and because what a file announces
// must never decide how much memory is taken: a reader reserves no more than the rest of the file can fill.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/mesh_io.h"
#include "io/source.h"

namespace dymsum::io {

MeshData read_off(const Source& source);
MeshData read_obj(const Source& source);
MeshData read_stl(const Source& source);
MeshData read_ply(const Source& source);
MeshData read_glb(const Source& source);
MeshFile read_3mf(const Source& source);

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

// Maps by which formats place their meshes. They are computed in doubles, as the programs do that write such files:
// exact where a mesh stays where it is, or is turned by right angles, moved and scaled within what doubles hold.

/// x -> (row · (x, 1)) for three rows.
struct Transform3 {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  Point3 operator()(const Point3& p) const {
    const auto of = [&](const std::array<double, 4>& r) { return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3]; };
    return {of(rows[0]), of(rows[1]), of(rows[2])};
  }

  /// First `inner`, then `outer`.
  friend Transform3 operator*(const Transform3& outer, const Transform3& inner) {
    Transform3 both;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        both.rows[i][j] = j == 3 ? outer.rows[i][3] : 0;
        for (std::size_t k = 0; k < 3; ++k) both.rows[i][j] += outer.rows[i][k] * inner.rows[k][j];
      }
    }
    return both;
  }

  /// Whether it turns what is outside to the inside: faces have to run the other way round then.
  bool mirrors() const {
    const auto& [a, b, c] = rows;
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]) <
           0;
  }
};

// Segments that are edges of faces: files list them beside the faces, and they say nothing new.

class FaceEdges {
 public:
  /// The edges of the faces with three and more vertices. O(n log n).
  explicit FaceEdges(const std::vector<Face>& faces);
  /// Whether a face with two vertices is one.
  bool has(const Face& segment) const;

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted_;
};

}  // namespace dymsum::io
