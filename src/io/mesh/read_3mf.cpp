// 3MF: a .zip whose relationships name an XML file with objects (meshes, or placed components of others) and what is
// built of them. Read are the objects that are built, as they are placed, in the numbers of the file, whatever its
// unit; not those of the types `support`, `surface` and `other`, which are no part of the solid. Materials, colours,
// slices and what belongs to one program are not read.
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include "io/archive.h"
#include "io/mesh/mesh_files.h"
#include "io/source.h"

namespace dymsum::io {

namespace {

/// What stands after the prefix of a namespace.
std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_attribute attribute_of(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_attribute attribute : node.attributes())
    if (local_name(attribute.name()) == name) return attribute;
  return {};
}

/// An XML file of the package.
struct Part {
  std::string name, text;
  pugi::xml_document document;
  std::map<std::string, pugi::xml_node, std::less<>> objects;  ///< by id
};

class ThreeMfReader {
 public:
  explicit ThreeMfReader(const Source& source) : source_(source) {}

  MeshFile read() {
    if (!is_zip(source_.text))
      source_.fail_in_bytes(ErrorCode::malformed, "a .3mf file is a .zip file, and this is none");
    const Part& root = part(start());
    for (const pugi::xml_node node : root.document.document_element().children()) {
      if (local_name(node.name()) != "build") continue;
      for (const pugi::xml_node item : node.children())
        if (local_name(item.name()) == "item") place(root, item, {}, 0);
    }
    return {std::move(data_), unit_of(root)};
  }

 private:
  static constexpr int kMostNested = 64;

  /// Millimetres where the model names no unit.
  static std::string unit_of(const Part& root) {
    static constexpr std::pair<std::string_view, const char*> kUnits[] = {
        {"micron", "um"}, {"millimeter", "mm"}, {"centimeter", "cm"}, {"inch", "in"}, {"foot", "ft"}, {"meter", "m"}};
    const std::string_view unit = root.document.document_element().attribute("unit").value();
    for (const auto& [name, symbol] : kUnits)
      if (unit == name) return symbol;
    return unit.empty() ? "mm" : "";
  }

  /// The name of the entry that has what is built.
  std::string start() {
    const Part& relationships = part("_rels/.rels");
    for (const pugi::xml_node node : relationships.document.document_element().children()) {
      if (std::string_view(node.attribute("Type").value()).ends_with("/3dmodel"))
        return without_slash(node.attribute("Target").value());
    }
    source_.fail_in_bytes(ErrorCode::malformed, "its _rels/.rels names no 3D model");
  }

  static std::string without_slash(std::string_view name) {
    return std::string(name.starts_with('/') ? name.substr(1) : name);
  }

  const Part& part(const std::string& name) {
    std::unique_ptr<Part>& made = parts_[name];
    if (made) return *made;
    Result<std::string> text = zip_entry(source_.text, name, source_.file);
    if (!text) throw ReadFailure{text.error()};
    if (text->empty()) source_.fail_in_bytes(ErrorCode::malformed, "it has no " + in_quotes(name));
    unpacked_ += text->size();
    if (unpacked_ > most_unpacked(source_.text.size()))
      source_.fail_in_bytes(ErrorCode::out_of_memory, "its parts take too much memory");
    made = std::make_unique<Part>();
    made->name = name;
    made->text = std::move(text).value();
    const pugi::xml_parse_result parsed = made->document.load_buffer(made->text.data(), made->text.size());
    if (!parsed) fail(*made, parsed.offset, ErrorCode::malformed, std::string("XML: ") + parsed.description());
    for (const pugi::xml_node node : made->document.document_element().children()) {
      if (local_name(node.name()) != "resources") continue;
      for (const pugi::xml_node object : node.children())
        if (local_name(object.name()) == "object") made->objects.emplace(object.attribute("id").value(), object);
    }
    return *made;
  }

  [[noreturn]] void fail(const Part& in, std::ptrdiff_t offset, ErrorCode code, const std::string& message,
                         Evidence evidence = {}) const {
    const Source text{in.text, {}};
    evidence.file = source_.file;
    throw ReadFailure{Error{
        code,
        message + " (line " + std::to_string(text.line(static_cast<std::size_t>(offset))) + " of its " + in.name + ")",
        std::move(evidence)}};
  }
  [[noreturn]] void fail(const Part& in, const pugi::xml_node& node, const std::string& message) const {
    fail(in, node.offset_debug(), ErrorCode::malformed, message);
  }

  /// An item or a component: an object of this part or of another, and a transform.
  void place(const Part& in, const pugi::xml_node& node, const Transform3& outer, int depth) {
    if (++placed_ > most_unpacked(source_.text.size()) / sizeof(Point3))
      fail(in, node.offset_debug(), ErrorCode::out_of_memory, "too many copies are placed");
    if (depth > kMostNested) fail(in, node, "components lie in each other too deep, or in a circle");
    const pugi::xml_attribute path = attribute_of(node, "path");
    const Part& at = path ? part(without_slash(path.value())) : in;
    const std::string_view id = node.attribute("objectid").value();
    const auto found = at.objects.find(id);
    if (found == at.objects.end()) fail(in, node, "there is no object " + in_quotes(id));
    const pugi::xml_node& object = found->second;
    const std::string_view type = object.attribute("type").value();
    if (type == "support" || type == "surface" || type == "other") return;
    const Transform3 placed = outer * transform_of(in, node);
    for (const pugi::xml_node content : object.children()) {
      if (local_name(content.name()) == "mesh") add_mesh(at, content, placed);
      if (local_name(content.name()) != "components") continue;
      for (const pugi::xml_node component : content.children())
        if (local_name(component.name()) == "component") place(at, component, placed, depth + 1);
    }
  }

  Transform3 transform_of(const Part& in, const pugi::xml_node& node) const {
    Transform3 transform;
    const pugi::xml_attribute text = node.attribute("transform");
    if (!text) return transform;
    std::string_view rest = text.value();
    for (std::size_t k = 0; k < 12; ++k) {
      while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
      const ScannedNumber number = scan_number(rest);
      if (number.length == 0 || !std::isfinite(number.value)) fail(in, node, "a transform has twelve finite numbers");
      rest.remove_prefix(number.length);
      transform.rows[k % 3][k / 3] = number.value;
    }
    while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
    if (!rest.empty()) fail(in, node, "a transform has twelve finite numbers");
    return transform;
  }

  double coordinate(const Part& in, const pugi::xml_node& vertex, const char* name) const {
    const std::string_view text = vertex.attribute(name).value();
    const ScannedNumber number = scan_number(text);
    if (text.empty() || number.length != text.size())
      fail(in, vertex, std::string("a vertex's ") + name + " is " + in_quotes(text) + ", not a number");
    if (!std::isfinite(number.value))
      fail(in, vertex.offset_debug(), ErrorCode::not_finite, "a coordinate is not a finite number");
    return number.value;
  }

  void add_mesh(const Part& in, const pugi::xml_node& mesh, const Transform3& transform) {
    const std::size_t first = data_.vertices.size();
    for (const pugi::xml_node list : mesh.children()) {
      if (local_name(list.name()) != "vertices") continue;
      for (const pugi::xml_node vertex : list.children()) {
        if (local_name(vertex.name()) != "vertex") continue;
        if (data_.vertices.size() >= most_unpacked(source_.text.size()) / sizeof(Point3))
          fail(in, vertex.offset_debug(), ErrorCode::out_of_memory, "the placed copies have too many vertices");
        data_.vertices.push_back(
            transform({coordinate(in, vertex, "x"), coordinate(in, vertex, "y"), coordinate(in, vertex, "z")}));
      }
    }
    const std::size_t count = data_.vertices.size() - first;
    const bool turned = transform.mirrors();
    for (const pugi::xml_node list : mesh.children()) {
      if (local_name(list.name()) != "triangles") continue;
      for (const pugi::xml_node triangle : list.children()) {
        if (local_name(triangle.name()) != "triangle") continue;
        if (data_.faces.size() >= most_unpacked(source_.text.size()) / sizeof(Point3))
          fail(in, triangle.offset_debug(), ErrorCode::out_of_memory, "the placed copies have too many triangles");
        Face& face = data_.faces.emplace_back();
        for (const char* corner : {"v1", turned ? "v3" : "v2", turned ? "v2" : "v3"})
          face.push_back(static_cast<std::uint32_t>(first + index(in, triangle, corner, count)));
      }
    }
  }

  std::size_t index(const Part& in, const pugi::xml_node& triangle, const char* corner, std::size_t count) const {
    const std::string_view text = triangle.attribute(corner).value();
    const ScannedCount number = scan_count(text);
    if (text.empty() || number.length != text.size())
      fail(in, triangle, std::string("a triangle's ") + corner + " is " + in_quotes(text) + ", not an index");
    if (number.value >= count)
      fail(in, triangle.offset_debug(), ErrorCode::bad_index,
           "a triangle names vertex " + std::to_string(number.value) + " of " + std::to_string(count),
           at_face(data_.faces.size() - 1));
    return number.value;
  }

  const Source& source_;
  std::map<std::string, std::unique_ptr<Part>> parts_;
  std::uint64_t unpacked_ = 0, placed_ = 0;
  MeshData data_;
};

}  // namespace

MeshFile read_3mf(const Source& source) { return ThreeMfReader(source).read(); }

}  // namespace dymsum::io
