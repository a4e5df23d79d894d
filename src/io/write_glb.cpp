// Meshes as binary glTF 2.0: a header of 12 bytes, a JSON chunk, and a chunk with the numbers that it describes. Every
// triangle has vertices of its own, with its normal, so that faces look flat.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
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

/// The unit normal, (0, 0, 1) for a triangle whose rounded corners are on one line.
Triple unit_normal(const Triple& a, const Triple& b, const Triple& c) {
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
  if (!(length > 0)) return {0, 0, 1};
  return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

class GlbWriter {
 public:
  GlbWriter(const MeshData& data, std::span<const std::pair<std::string, std::string>> notes) : data_(data) {
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "dymsum"}}}, {"scene", 0}};
    json_["scenes"] = Json::array({Json::object()});
    for (const auto& [name, text] : notes) json_["asset"]["extras"][name] = text;
  }

  /// A primitive of these triangles in a material of its own.
  void add(const std::vector<spatial::Triangle>& triangles, const std::array<float, 3>& rgb) {
    if (triangles.empty()) return;
    std::vector<Triple> places, normals;
    for (const spatial::Triangle& t : triangles) {
      const auto corner = [&](std::size_t k) { return rounded(data_.vertices[t[k]]); };
      const Triple a = corner(0), b = corner(1), c = corner(2);
      places.insert(places.end(), {a, b, c});
      normals.insert(normals.end(), 3, unit_normal(a, b, c));
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

std::string write_glb(const MeshData& data, std::span<const FaceColour> colours,
                      std::span<const std::pair<std::string, std::string>> notes) {
  const spatial::Triangles all = spatial::triangulated(data);
  const std::vector<std::size_t> colour_of = colour_of_faces(data, colours);
  std::vector<std::vector<spatial::Triangle>> groups(colours.size() + 1);
  for (std::size_t i = 0; i < all.triangles.size(); ++i) groups[colour_of[all.face[i]]].push_back(all.triangles[i]);
  GlbWriter writer(data, notes);
  for (std::size_t i = 0; i < colours.size(); ++i) writer.add(groups[i], colours[i].rgb);
  writer.add(groups.back(), FaceColour{}.rgb);
  return writer.write();
}

}  // namespace dymsum::io

namespace dymsum {

std::string format_glb(const MeshData& mesh, std::span<const FaceColour> colours,
                       std::span<const std::pair<std::string, std::string>> notes) {
  return io::write_glb(mesh, colours, notes);
}

}  // namespace dymsum
