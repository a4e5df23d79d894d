// Meshes as OFF, OBJ, STL and PLY.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/bytes.h"
#include "io/mesh/mesh_files.h"
#include "io/source.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::io {

namespace {

void append_point(std::string& out, const Point3& p) {
  append_number(out, p.x);
  out += ' ';
  append_number(out, p.y);
  out += ' ';
  append_number(out, p.z);
}

void append_corners(std::string& out, const Face& face, std::uint32_t first) {
  for (const std::uint32_t v : face) out += ' ' + std::to_string(v + first);
}

/// The faces of the two formats that say how many corners follow, and a colour behind them.
void append_faces(std::string& out, const MeshData& data, std::span<const FaceColour> colours) {
  const std::vector<std::size_t> colour_of = colour_of_faces(data, colours);
  const FaceColour plain;
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    out += std::to_string(data.faces[f].size());
    append_corners(out, data.faces[f], 0);
    const FaceColour& colour = colour_of[f] < colours.size() ? colours[colour_of[f]] : plain;
    for (std::size_t i = 0; i < 3 && !colours.empty(); ++i) out += ' ' + std::to_string(colour_byte(colour.rgb[i]));
    out += '\n';
  }
}

}  // namespace

float to_float(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kLargest, kLargest));
}

std::vector<std::size_t> colour_of_faces(const MeshData& data, std::span<const FaceColour> colours) {
  std::vector<std::size_t> colour_of(data.faces.size(), colours.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    for (const std::uint32_t f : colours[i].faces) {
      if (f < colour_of.size()) colour_of[f] = i;
    }
  }
  return colour_of;
}

int colour_byte(double part) { return static_cast<int>(std::lround(255 * std::clamp(part, 0.0, 1.0))); }

std::string write_off(const MeshData& data, std::span<const FaceColour> colours) {
  std::size_t corners = 0;
  for (const Face& face : data.faces) corners += face.size();
  std::string out = "OFF\n" + std::to_string(data.vertices.size()) + ' ' + std::to_string(data.faces.size()) + ' ' +
                    std::to_string(corners / 2) + '\n';
  for (const Point3& p : data.vertices) {
    append_point(out, p);
    out += '\n';
  }
  append_faces(out, data, colours);
  return out;
}

std::string write_obj(const MeshData& data) {
  const bool has_segments =
      std::any_of(data.faces.begin(), data.faces.end(), [](const Face& face) { return face.size() == 2; });
  const FaceEdges known(has_segments ? data.faces : std::vector<Face>{});
  std::string out = data.vertices.empty() ? "# the empty solid\n" : "";  // readers refuse files of nothing
  for (const Point3& p : data.vertices) {
    out += "v ";
    append_point(out, p);
    out += '\n';
  }
  for (const Face& face : data.faces) {
    // A line along a face would not be read back.
    out += face.size() == 1 ? 'p' : face.size() == 2 && !known.has(face) ? 'l' : 'f';
    append_corners(out, face, 1);
    out += '\n';
  }
  return out;
}

std::string write_stl(const MeshData& data) {
  const spatial::Triangles all = spatial::triangulated(data);
  std::string out(80, ' ');
  out.replace(0, 6, "dymsum");
  append_bytes(out, static_cast<std::uint32_t>(all.triangles.size()));
  for (const spatial::Triangle& t : all.triangles) {
    out.append(12, '\0');  // readers take the normal from the vertices
    for (const std::uint32_t v : t) {
      const Point3& p = data.vertices[v];
      for (const double c : {p.x, p.y, p.z}) append_bytes(out, to_float(c));
    }
    out.append(2, '\0');
  }
  return out;
}

std::string write_ply(const MeshData& data, std::span<const FaceColour> colours) {
  std::string out = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(data.vertices.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                    std::to_string(data.faces.size()) + "\nproperty list uint uint vertex_indices\n";
  if (!colours.empty()) out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  out += "end_header\n";
  for (const Point3& p : data.vertices) {
    append_point(out, p);
    out += '\n';
  }
  append_faces(out, data, colours);
  return out;
}

}  // namespace dymsum::io
