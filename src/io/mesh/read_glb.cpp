// Binary glTF 2.0: the triangles of the meshes of the scene, each as its nodes place it. glTF's y is up and our z: they
// are turned by a right angle. Coordinates are those of single precision; vertices at exactly the same position are
// merged, since corners of different colours or normals are vertices of their own. Animations and poses at other times
// than rest, materials and textures are not read.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/archive.h"
#include "io/bytes.h"
#include "io/mesh/mesh_files.h"

namespace dymsum::io {

namespace {

using GlbJson = nlohmann::json;

constexpr std::uint32_t kGlb = 0x46546C67, kTextChunk = 0x4E4F534A, kNumberChunk = 0x004E4942;
constexpr int kByteNumbers = 5121, kShortNumbers = 5123, kWordNumbers = 5125, kFloatNumbers = 5126;
constexpr int kTriangles = 4, kStrip = 5, kFan = 6;

/// Numbers of an accessor in the binary chunk.
struct Numbers {
  std::string_view bytes;
  std::size_t count = 0, stride = 0;
  int component = 0;
};

class GlbReader {
 public:
  explicit GlbReader(const Source& source) : source_(source) {}

  MeshData read() {
    split();
    try {
      refuse_extensions();
      const GlbJson& nodes = list("nodes");
      seen_.resize(nodes.size());
      for (const std::size_t root : roots(nodes)) place(nodes, root, kZUp);
      const auto left = std::find(seen_.begin(), seen_.end(), false);
      if (list("scenes").empty() && left != seen_.end())
        fail("node " + std::to_string(left - seen_.begin()) + " is below itself");
    } catch (const GlbJson::exception&) {
      fail("its JSON is not as glTF has it");
    }
    merge_equal_vertices(data_);
    return std::move(data_);
  }

 private:
  static constexpr Transform3 kZUp{{{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}}}};

  [[noreturn]] void fail(std::string message, ErrorCode code = ErrorCode::malformed) const {
    source_.fail_in_bytes(code, std::move(message));
  }

  std::uint32_t word(std::size_t offset) const {
    if (offset + 4 > source_.text.size()) fail("the file ends early", ErrorCode::truncated);
    return from_bytes<std::uint32_t>(source_.text, offset, std::endian::little);
  }

  /// The header and the chunks; those of other kinds are skipped.
  void split() {
    if (word(0) != kGlb) fail("it does not begin with 'glTF'");
    if (word(4) != 2) fail("it is of version " + std::to_string(word(4)) + " of glTF, not 2");
    const std::size_t end = word(8);
    if (end > source_.text.size())
      fail("it announces " + std::to_string(end) + " bytes and has " + std::to_string(source_.text.size()),
           ErrorCode::truncated);
    bool described = false;
    for (std::size_t at = 12; at + 8 <= end;) {
      const std::size_t size = word(at), kind = word(at + 4);
      if (size > end - at - 8) fail("a chunk is longer than the file", ErrorCode::truncated);
      const std::string_view content = source_.text.substr(at + 8, size);
      if (kind == kTextChunk && !described) {
        json_ = GlbJson::parse(content, nullptr, false);
        described = true;
      } else if (kind == kNumberChunk && binary_.empty()) {
        binary_ = content;
      }
      at += 8 + size;
    }
    if (!described) fail("it has no JSON");
    if (!json_.is_object()) fail("its JSON is malformed");
  }

  /// What a file cannot be read without, unless it is about looks alone.
  void refuse_extensions() const {
    for (const GlbJson& name : list("extensionsRequired")) {
      const auto& text = name.get_ref<const std::string&>();
      const auto begins = [&](std::string_view with) { return text.starts_with(with); };
      if (begins("KHR_materials_") || begins("KHR_texture_") || begins("EXT_texture_") || begins("KHR_lights_"))
        continue;
      fail("it needs the extension " + in_quotes(text) + ", which is not read", ErrorCode::unsupported_format);
    }
  }

  const GlbJson& list(const char* name) const { return member(json_, name); }
  static const GlbJson& member(const GlbJson& of, const char* name) {
    static const GlbJson kNone = GlbJson::array();
    const auto found = of.find(name);
    return found == of.end() ? kNone : *found;
  }

  std::vector<std::size_t> roots(const GlbJson& nodes) const {
    const GlbJson& scenes = list("scenes");
    std::vector<std::size_t> found;
    if (!scenes.empty()) {
      const GlbJson& scene = scenes.at(json_.value("scene", std::size_t{0}));
      for (const GlbJson& root : member(scene, "nodes")) found.push_back(root.get<std::size_t>());
      return found;
    }
    std::vector<bool> child(nodes.size());
    for (const GlbJson& node : nodes)
      for (const GlbJson& below : member(node, "children")) child.at(below.get<std::size_t>()) = true;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!child[i]) found.push_back(i);
    return found;
  }

  /// A node and what is below it, without recursion: files may nest as deep as they are long.
  void place(const GlbJson& nodes, std::size_t root, const Transform3& outer) {
    std::vector<std::pair<std::size_t, Transform3>> open = {{root, outer}};
    while (!open.empty()) {
      const auto [index, above] = open.back();
      open.pop_back();
      const GlbJson& node = nodes.at(index);
      if (seen_.at(index)) fail("node " + std::to_string(index) + " stands in two places");
      seen_[index] = true;
      const Transform3 here = above * transform_of(node);
      if (node.contains("skin")) fail("node " + std::to_string(index) + " follows a skeleton");
      if (node.contains("mesh")) add_mesh(list("meshes").at(node["mesh"].get<std::size_t>()), here);
      const GlbJson& below = member(node, "children");
      for (auto child = below.rbegin(); child != below.rend(); ++child)
        open.emplace_back(child->get<std::size_t>(), here);
    }
  }

  template <std::size_t N>
  std::array<double, N> numbers(const GlbJson& node, const char* name, std::array<double, N> otherwise) const {
    if (!node.contains(name)) return otherwise;
    const GlbJson& given = node[name];
    if (given.size() != N) fail(std::string("a node's ") + name + " has " + std::to_string(given.size()) + " numbers");
    for (std::size_t k = 0; k < N; ++k) {
      otherwise[k] = given[k].get<double>();
      if (!std::isfinite(otherwise[k])) fail("a number of a node is not finite", ErrorCode::not_finite);
    }
    return otherwise;
  }

  Transform3 transform_of(const GlbJson& node) const {
    Transform3 all;
    if (node.contains("matrix")) {
      const auto m = numbers<16>(node, "matrix", {});
      for (std::size_t k = 0; k < 12; ++k) all.rows[k % 3][k / 3] = 0;
      for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 3; ++row) all.rows[row][column] = m[4 * column + row];
      return all;
    }
    const auto move = numbers<3>(node, "translation", {0, 0, 0}), scale = numbers<3>(node, "scale", {1, 1, 1});
    const auto [x, y, z, w] = numbers<4>(node, "rotation", {0, 0, 0, 1});
    // Divided by the length's square: right angles are met exactly, though doubles do not hold their quaternions.
    const double n = x * x + y * y + z * z + w * w;
    if (!(n > 0)) fail("a node's rotation is zero");
    all.rows = {{{((w * w + x * x) - (y * y + z * z)) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n, move[0]},
                 {2 * (x * y + w * z) / n, ((w * w + y * y) - (x * x + z * z)) / n, 2 * (y * z - w * x) / n, move[1]},
                 {2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, ((w * w + z * z) - (x * x + y * y)) / n, move[2]}}};
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column) all.rows[row][column] *= scale[column];
    return all;
  }

  void add_mesh(const GlbJson& mesh, const Transform3& transform) {
    for (const GlbJson& primitive : mesh.at("primitives")) {
      const int mode = primitive.value("mode", kTriangles);
      if (mode < kTriangles || mode > kFan) fail("it has points or lines (mode " + std::to_string(mode) + ")");
      if (primitive.contains("targets")) fail("it has shapes that change (morph targets)");
      add_primitive(primitive, mode, transform);
    }
  }

  void add_primitive(const GlbJson& primitive, int mode, const Transform3& transform) {
    const GlbJson& attributes = primitive.at("attributes");
    if (!attributes.contains("POSITION")) return;
    const Numbers positions = accessor(attributes["POSITION"].get<std::size_t>(), "VEC3");
    if (positions.component != kFloatNumbers) fail("positions are no numbers of single precision");
    const std::size_t first = data_.vertices.size();
    if (first + positions.count > most_unpacked(source_.text.size()) / sizeof(Point3))
      fail("what is placed again and again has too many vertices", ErrorCode::out_of_memory);
    for (std::size_t i = 0; i < positions.count; ++i) {
      std::array<double, 3> c{};
      for (std::size_t k = 0; k < 3; ++k) {
        c[k] = from_bytes<float>(positions.bytes, i * positions.stride + 4 * k, std::endian::little);
        if (!std::isfinite(c[k])) fail("a coordinate is not a finite number", ErrorCode::not_finite);
      }
      data_.vertices.push_back(transform({c[0], c[1], c[2]}));
    }
    std::vector<std::uint32_t> corners = corners_of(primitive, positions.count);
    if (data_.faces.size() + corners.size() > most_unpacked(source_.text.size()) / sizeof(Point3))
      fail("what is placed again and again has too many triangles", ErrorCode::out_of_memory);
    for (std::uint32_t& corner : corners) corner += static_cast<std::uint32_t>(first);
    add_faces(corners, mode, transform.mirrors());
  }

  std::vector<std::uint32_t> corners_of(const GlbJson& primitive, std::size_t vertices) const {
    std::vector<std::uint32_t> corners;
    if (!primitive.contains("indices")) {
      for (std::size_t i = 0; i < vertices; ++i) corners.push_back(static_cast<std::uint32_t>(i));
      return corners;
    }
    const Numbers indices = accessor(primitive["indices"].get<std::size_t>(), "SCALAR");
    for (std::size_t i = 0; i < indices.count; ++i) {
      const std::size_t at = i * indices.stride;
      std::uint32_t index = 0;
      if (indices.component == kByteNumbers) index = from_bytes<std::uint8_t>(indices.bytes, at, std::endian::little);
      else if (indices.component == kShortNumbers)
        index = from_bytes<std::uint16_t>(indices.bytes, at, std::endian::little);
      else if (indices.component == kWordNumbers)
        index = from_bytes<std::uint32_t>(indices.bytes, at, std::endian::little);
      else fail("indices are no whole numbers");
      if (index >= vertices)
        fail("a triangle names vertex " + std::to_string(index) + " of " + std::to_string(vertices),
             ErrorCode::bad_index);
      corners.push_back(index);
    }
    return corners;
  }

  void add_faces(const std::vector<std::uint32_t>& corners, int mode, bool turned) {
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      // Strips are led on by triangles without area.
      if (mode != kTriangles && (a == b || b == c || c == a)) return;
      data_.faces.push_back(turned ? Face{a, c, b} : Face{a, b, c});
    };
    if (mode == kTriangles && corners.size() % 3 != 0) fail("the corners of its triangles are no multiple of three");
    const std::size_t step = mode == kTriangles ? 3 : 1;
    for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
      if (mode == kFan) add(corners[0], corners[i + 1], corners[i + 2]);
      else if (mode == kStrip && i % 2 == 1) add(corners[i + 1], corners[i], corners[i + 2]);
      else add(corners[i], corners[i + 1], corners[i + 2]);
    }
  }

  Numbers accessor(std::size_t index, std::string_view type) const {
    const GlbJson& described = json_.at("accessors").at(index);
    if (described.contains("sparse") || !described.contains("bufferView"))
      fail("accessor " + std::to_string(index) + " is sparse, which is not read");
    if (described.at("type").get_ref<const std::string&>() != type)
      fail("accessor " + std::to_string(index) + " is not of type " + std::string(type));
    const int component = described.at("componentType").get<int>();
    const std::size_t width = component == kByteNumbers ? 1 : component == kShortNumbers ? 2 : 4;
    const std::size_t size = (type == "VEC3" ? 3 : 1) * width;
    const GlbJson& view = json_.at("bufferViews").at(described["bufferView"].get<std::size_t>());
    const GlbJson& buffer = json_.at("buffers").at(view.at("buffer").get<std::size_t>());
    if (buffer.contains("uri") || view["buffer"] != 0) fail("its numbers stand in another file");
    const std::string_view bytes = part(binary_, view, view.at("byteLength").get<std::size_t>());
    const std::size_t offset = described.value("byteOffset", std::size_t{0});
    Numbers numbers{{}, described.at("count").get<std::size_t>(), view.value("byteStride", size), component};
    const bool fits = offset <= bytes.size() && numbers.stride >= size &&
                      (numbers.count == 0 || (bytes.size() - offset >= size &&
                                              (bytes.size() - offset - size) / numbers.stride >= numbers.count - 1));
    if (!fits) fail("accessor " + std::to_string(index) + " reaches past its bytes", ErrorCode::truncated);
    numbers.bytes = bytes.substr(offset);
    return numbers;
  }

  std::string_view part(std::string_view bytes, const GlbJson& view, std::size_t size) const {
    const std::size_t offset = view.value("byteOffset", std::size_t{0});
    if (offset > bytes.size() || size > bytes.size() - offset)
      fail("the file ends before its numbers do", ErrorCode::truncated);
    return bytes.substr(offset, size);
  }

  const Source& source_;
  GlbJson json_;
  std::string_view binary_;
  std::vector<bool> seen_;
  MeshData data_;
};

}  // namespace

MeshData read_glb(const Source& source) { return GlbReader(source).read(); }

}  // namespace dymsum::io
