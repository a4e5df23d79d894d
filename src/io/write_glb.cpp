// Meshes as binary glTF 2.0: a header of 12 bytes, a JSON chunk, and a chunk with the numbers that it describes. Every
// triangle has vertices of its own, with normals, so that faces look flat, or smooth among those of one number.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/bytes.h"
#include "io/mesh_readers.h"
#include "spatial/triangulate.h"

namespace dymsum::io {

namespace {

using Json = nlohmann::ordered_json;
using Triple = std::array<float, 3>;

// glTF's names for its numbers.
constexpr int kFloat = 5126, kArrayBuffer = 34962;
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

Triple rounded(const Point3& p) { return {to_float(p.x), to_float(p.y), to_float(p.z)}; }

/// The unit normal; nothing for a triangle whose rounded corners are on one line.
std::optional<Triple> normal_of(const Triple& a, const Triple& b, const Triple& c) {
  std::array<double, 3> u, v;
  double scale = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = static_cast<double>(b[i]) - static_cast<double>(a[i]);
    v[i] = static_cast<double>(c[i]) - static_cast<double>(a[i]);
    scale = std::max({scale, std::abs(u[i]), std::abs(v[i])});
  }
  for (std::size_t i = 0; i < 3 && scale > 0; ++i) {
    u[i] /= scale;
    v[i] /= scale;
  }
  const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
  const double length = std::hypot(x, y, z);
  if (!(length > 0)) return std::nullopt;
  return Triple{static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

/// The angle at the first of three corners.
double angle_at(const Triple& a, const Triple& b, const Triple& c) {
  double dot = 0, uu = 0, vv = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double u = static_cast<double>(b[i]) - static_cast<double>(a[i]);
    const double v = static_cast<double>(c[i]) - static_cast<double>(a[i]);
    dot += u * v;
    uu += u * u;
    vv += v * v;
  }
  const double length = std::sqrt(uu) * std::sqrt(vv);
  return length > 0 && std::isfinite(length) ? std::acos(std::clamp(dot / length, -1.0, 1.0)) : 0;
}

/// Normals at the corners of triangles: each its own, or by vertex and smooth number the mean of all triangles there,
/// weighed by their angles. Triangles without area have no say.
class Normals {
 public:
  Normals(const MeshData& data, const spatial::Triangles& all, std::span<const std::uint32_t> smooth)
      : data_(data), smooth_(smooth) {
    if (smooth.empty()) return;
    for (std::size_t i = 0; i < all.triangles.size(); ++i) {
      const spatial::Triangle& t = all.triangles[i];
      for (std::size_t k = 0; k < 3; ++k) add(t, k, all.face[i]);
    }
  }

  Triple at(const spatial::Triangle& t, std::size_t k, std::uint32_t face) const {
    const Triple own = normal_of(corner(t, 0), corner(t, 1), corner(t, 2)).value_or(Triple{0, 0, 1});
    if (smooth_.empty()) return own;
    const auto sum = sums_.find(key(t[k], face));
    if (sum == sums_.end()) return own;
    const auto& [x, y, z] = sum->second;
    const double length = std::hypot(x, y, z);
    if (!(length > 0)) return own;
    return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
  }

 private:
  Triple corner(const spatial::Triangle& t, std::size_t k) const { return rounded(data_.vertices[t[k % 3]]); }
  std::uint64_t key(std::uint32_t vertex, std::uint32_t face) const {
    return (static_cast<std::uint64_t>(vertex) << 32) | smooth_[face];
  }
  void add(const spatial::Triangle& t, std::size_t k, std::uint32_t face) {
    const Triple a = corner(t, k), b = corner(t, k + 1), c = corner(t, k + 2);
    const std::optional<Triple> normal = normal_of(a, b, c);
    if (!normal) return;
    const double angle = angle_at(a, b, c);
    auto& sum = sums_[key(t[k], face)];
    for (std::size_t i = 0; i < 3; ++i) sum[i] += angle * static_cast<double>((*normal)[i]);
  }

  const MeshData& data_;
  std::span<const std::uint32_t> smooth_;
  std::unordered_map<std::uint64_t, std::array<double, 3>> sums_;
};

class GlbWriter {
 public:
  GlbWriter(const MeshData& data, std::span<const std::pair<std::string, std::string>> notes) : data_(data) {
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "dymsum"}}}, {"scene", 0}};
    json_["scenes"] = Json::array({Json::object()});
    for (const auto& [name, text] : notes) json_["asset"]["extras"][name] = text;
  }

  /// A primitive of these triangles in a material of its own.
  void add(const spatial::Triangles& group, const std::array<float, 3>& rgb, const Normals& normals_at) {
    if (group.triangles.empty()) return;
    std::vector<Triple> places, normals;
    for (std::size_t i = 0; i < group.triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        places.push_back(rounded(data_.vertices[group.triangles[i][k]]));
        normals.push_back(normals_at.at(group.triangles[i], k, group.face[i]));
      }
    }
    const std::size_t material = json_["materials"].size();
    json_["materials"].push_back({{"pbrMetallicRoughness",
                                   {{"baseColorFactor", {rgb[0], rgb[1], rgb[2], 1}},
                                    {"metallicFactor", 0},
                                    {"roughnessFactor", 0.8}}}});
    const std::size_t position = add_accessor(places, true), normal = add_accessor(normals, false);
    primitives_.push_back({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"material", material}});
  }

  std::string write() {
    if (!primitives_.empty()) {
      json_["meshes"] = {{{"primitives", primitives_}}};
      // z is up in our files and y in glTF: a quarter turn about x
      const double half = std::sqrt(0.5);
      json_["nodes"] = {{{"mesh", 0}, {"rotation", {-half, 0.0, 0.0, half}}}};
      json_["scenes"][0]["nodes"] = {0};
      json_["buffers"] = {{{"byteLength", bytes_.size()}}};
    }
    std::string text = json_.dump();
    text.append((4 - text.size() % 4) % 4, ' ');
    std::string out;
    append_bytes(out, kMagic);
    append_bytes(out, kVersion);
    const std::size_t chunks = bytes_.empty() ? 8 + text.size() : 16 + text.size() + bytes_.size();
    append_bytes(out, static_cast<std::uint32_t>(12 + chunks));
    append_chunk(out, kJsonChunk, text);
    if (!bytes_.empty()) append_chunk(out, kBinaryChunk, bytes_);
    return out;
  }

 private:
  static void append_chunk(std::string& out, std::uint32_t kind, const std::string& content) {
    append_bytes(out, static_cast<std::uint32_t>(content.size()));
    append_bytes(out, kind);
    out += content;
  }

  std::size_t add_accessor(const std::vector<Triple>& values, bool with_bounds) {
    const std::size_t start = bytes_.size();
    Triple low = values[0], high = values[0];
    for (const Triple& value : values) {
      for (std::size_t i = 0; i < 3; ++i) {
        append_bytes(bytes_, value[i]);
        low[i] = std::min(low[i], value[i]);
        high[i] = std::max(high[i], value[i]);
      }
    }
    const std::size_t view = json_["bufferViews"].size(), accessor = json_["accessors"].size();
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", start}, {"byteLength", bytes_.size() - start}, {"target", kArrayBuffer}});
    json_["accessors"].push_back(
        {{"bufferView", view}, {"componentType", kFloat}, {"count", values.size()}, {"type", "VEC3"}});
    if (with_bounds) json_["accessors"].back().update({{"min", low}, {"max", high}});
    return accessor;
  }

  const MeshData& data_;
  Json json_;
  Json primitives_ = Json::array();
  std::string bytes_;
};

}  // namespace

std::string write_glb(const MeshData& data, const GlbLook& look) {
  const spatial::Triangles all = spatial::triangulated(data);
  const std::vector<std::size_t> colour_of = colour_of_faces(data, look.colours);
  std::vector<spatial::Triangles> groups(look.colours.size() + 1);
  for (std::size_t i = 0; i < all.triangles.size(); ++i) {
    spatial::Triangles& group = groups[colour_of[all.face[i]]];
    group.triangles.push_back(all.triangles[i]);
    group.face.push_back(all.face[i]);
  }
  const Normals normals(data, all, look.smooth);
  GlbWriter writer(data, look.notes);
  for (std::size_t i = 0; i < look.colours.size(); ++i) writer.add(groups[i], look.colours[i].rgb, normals);
  writer.add(groups.back(), FaceColour{}.rgb, normals);
  return writer.write();
}

}  // namespace dymsum::io

namespace dymsum {

std::string format_glb(const MeshData& mesh, const GlbLook& look) { return io::write_glb(mesh, look); }

}  // namespace dymsum
