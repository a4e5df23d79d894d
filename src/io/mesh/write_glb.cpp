// Meshes as binary glTF 2.0: a header of 12 bytes, a JSON chunk, and a chunk with the numbers that it describes. All
// triangles are one primitive, whose vertices have colours and are shared by triangles of one colour. Without normals
// faces look flat, and programs that merge vertices at one position get a surface that is closed where the mesh is.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes.h"
#include "io/mesh/mesh_files.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::io {

namespace {

using Json = nlohmann::ordered_json;
using Triple = std::array<float, 3>;

// glTF's names for its numbers.
constexpr int kFloat = 5126, kUnsigned = 5125, kVertices = 34962, kIndices = 34963;
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

constexpr std::array<double, 3> kMarkColour{0.85, 0.12, 0.20};

Triple rounded(const Point3& p) { return {to_float(p.x), to_float(p.y), to_float(p.z)}; }

/// glTF's colours are amounts of light, and ours what a screen is told.
Triple light_of(const std::array<double, 3>& rgb) {
  Triple light{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::clamp(rgb[i], 0.0, 1.0);
    light[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return light;
}

class GlbWriter {
 public:
  explicit GlbWriter(std::span<const std::pair<std::string, std::string>> notes) {
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "dymsum"}}}, {"scene", 0}};
    json_["scenes"] = Json::array({Json::object()});
    for (const auto& [name, text] : notes) json_["asset"]["extras"][name] = text;
  }

  /// A triangle with two corners at one position is left out: its other edges become one.
  void add(const MeshData& data, const spatial::Triangle& triangle, std::size_t colour, const Triple& light) {
    const auto at = [&](std::size_t k) { return rounded(data.vertices[triangle[k]]); };
    if (at(0) == at(1) || at(1) == at(2) || at(2) == at(0)) return;
    for (const std::uint32_t vertex : triangle) {
      const auto [known, fresh] = number_.try_emplace({vertex, colour}, static_cast<std::uint32_t>(positions_.size()));
      if (fresh) {
        positions_.push_back(rounded(data.vertices[vertex]));
        lights_.push_back(light);
      }
      corners_.push_back(known->second);
    }
  }

  /// What was added since the last mesh becomes one, of its own node and material; less than opaque, what lies behind
  /// shows.
  void end_mesh(double opacity) {
    if (corners_.empty()) return;
    const Json attributes = {{"POSITION", add_triples(positions_)}, {"COLOR_0", add_triples(lights_)}};
    add_bounds(attributes["POSITION"]);
    const std::size_t index = json_["meshes"].size();
    const Json primitive = {{"attributes", attributes}, {"indices", add_corners()}, {"material", index}};
    Json material = {{"doubleSided", true},
                     {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.8}}}};
    if (opacity < 1) {
      material["alphaMode"] = "BLEND";
      material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, opacity};
    }
    json_["materials"].push_back(std::move(material));
    json_["meshes"].push_back({{"primitives", Json::array({primitive})}});
    // z is up in our files and y in glTF: a quarter turn about x
    const double half = std::sqrt(0.5);
    json_["nodes"].push_back({{"mesh", index}, {"rotation", {-half, 0.0, 0.0, half}}});
    json_["scenes"][0]["nodes"].push_back(index);
    positions_.clear(), lights_.clear(), corners_.clear(), number_.clear();
  }

  std::string write() {
    if (!bytes_.empty()) json_["buffers"] = {{{"byteLength", bytes_.size()}}};
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

  std::size_t add_accessor(std::size_t start, int target, int component, std::size_t count, const char* type) {
    const std::size_t view = json_["bufferViews"].size(), accessor = json_["accessors"].size();
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", start}, {"byteLength", bytes_.size() - start}, {"target", target}});
    json_["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return accessor;
  }

  std::size_t add_triples(const std::vector<Triple>& values) {
    const std::size_t start = bytes_.size();
    for (const Triple& value : values)
      for (const float part : value) append_bytes(bytes_, part);
    return add_accessor(start, kVertices, kFloat, values.size(), "VEC3");
  }

  std::size_t add_corners() {
    const std::size_t start = bytes_.size();
    for (const std::uint32_t corner : corners_) append_bytes(bytes_, corner);
    return add_accessor(start, kIndices, kUnsigned, corners_.size(), "SCALAR");
  }

  void add_bounds(std::size_t accessor) {
    Triple low = positions_[0], high = positions_[0];
    for (const Triple& position : positions_) {
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], position[i]);
        high[i] = std::max(high[i], position[i]);
      }
    }
    json_["accessors"][accessor].update({{"min", low}, {"max", high}});
  }

  Json json_;
  std::vector<Triple> positions_, lights_;
  std::vector<std::uint32_t> corners_;
  std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> number_;  ///< of a vertex in a colour
  std::string bytes_;
};

}  // namespace

std::string write_glb(const MeshData& data, const GlbLook& look) {
  const spatial::Triangles all = spatial::triangulated(data);
  const std::vector<std::size_t> colour_of = colour_of_faces(data, look.colours);
  std::vector<Triple> lights;
  for (const FaceColour& colour : look.colours) lights.push_back(light_of(colour.rgb));
  lights.push_back(light_of(FaceColour{}.rgb));
  GlbWriter writer(look.notes);
  for (std::size_t i = 0; i < all.triangles.size(); ++i) {
    const std::size_t colour = colour_of[all.face[i]];
    writer.add(data, all.triangles[i], colour, lights[colour]);
  }
  const bool marked = look.marks && !look.marks->faces.empty();
  writer.end_mesh(marked ? 0.4 : 1);
  if (marked) {
    const spatial::Triangles marks = spatial::triangulated(*look.marks);
    for (const spatial::Triangle& triangle : marks.triangles)
      writer.add(*look.marks, triangle, 0, light_of(kMarkColour));
    writer.end_mesh(1);
  }
  return writer.write();
}

}  // namespace dymsum::io

namespace dymsum {

std::string format_glb(const MeshData& mesh, const GlbLook& look) { return io::write_glb(mesh, look); }

}  // namespace dymsum
