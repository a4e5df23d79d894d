#include "io/region/drawn_layouts.h"

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <utility>

#include <pugixml.hpp>

#include "dymsum/planar_boolean.h"
#include "dymsum/region_io.h"
#include "io/region/dxf_groups.h"
#include "io/region/read_shapes.h"

namespace dymsum::io {
namespace {

/// What is drawn, as a valid region, and its name.
struct DrawnPart {
  DrawnPart(std::string name, Region region)
      : name(std::move(name)), region(std::move(region)), size(area(this->region)), box(bounds(this->region)) {}
  std::string name;
  Region region;
  double size;  ///< its area
  std::array<double, 4> box;
};

[[noreturn]] void refuse(const Source& source, const std::string& what) { source.fail(ErrorCode::malformed, what, 0); }

Region required_region(const Source& source, RegionData data, const std::string& name) {
  Result<Repaired> made = repair(std::move(data));
  if (made) return std::move(made).value().region;
  throw ReadFailure{
      {made.error().code, std::string(source.file) + ": " + name + ": " + made.error().message, made.error().evidence}};
}

bool lies_in(const DrawnPart& inner, const DrawnPart& outer) {
  const auto &a = inner.box, &b = outer.box;
  if (a[0] < b[0] || a[1] < b[1] || a[2] > b[2] || a[3] > b[3]) return false;
  SumOptions regular;
  regular.semantics = Semantics::regular;
  const Result<PlanarSum> beyond = difference(inner.region, outer.region, regular);
  if (!beyond) throw ReadFailure{beyond.error()};
  return beyond->parts.empty();
}

void refuse_thin(const Source& source, const RegionData& data) {
  if (data.polylines.empty() && data.points.empty()) return;
  refuse(source, "a layout has closed rings alone, and here are " + std::to_string(data.polylines.size()) +
                     " lines that are not closed and " + std::to_string(data.points.size()) + " points");
}

/// The largest one is taken out.
std::optional<DrawnPart> take_largest(std::vector<DrawnPart>& parts) {
  const auto largest = std::max_element(parts.begin(), parts.end(),
                                        [](const DrawnPart& a, const DrawnPart& b) { return a.size < b.size; });
  if (largest == parts.end()) return std::nullopt;
  DrawnPart taken = std::move(*largest);
  parts.erase(largest);
  return taken;
}

Layout layout_of(std::vector<DrawnPart> parts, std::optional<DrawnPart> container) {
  Layout layout;
  for (DrawnPart& part : parts) {
    layout.parts.push_back({std::move(part.name), static_cast<std::uint32_t>(layout.shapes.size()), {}, {}});
    layout.shapes.push_back(std::move(part.region));
  }
  if (container) layout.container = std::move(container->region);
  return layout;
}

/// Rings by what lies in what: one inside an even number of others is a part.
std::vector<DrawnPart> nested(const Source& source, std::vector<DrawnPart> rings) {
  std::stable_sort(rings.begin(), rings.end(), [](const DrawnPart& a, const DrawnPart& b) { return a.size > b.size; });
  std::vector<std::size_t> depth(rings.size()), around(rings.size());
  std::vector<RegionData> data(rings.size());
  for (std::size_t k = 0; k < rings.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j)
      if (rings[j].size > rings[k].size && lies_in(rings[k], rings[j])) ++depth[k], around[k] = j;
    if (depth[k] % 2 == 0) {
      data[k] = rings[k].region.data();
      continue;
    }
    Ring hole = rings[k].region.parts()[0].outer;
    std::reverse(hole.begin(), hole.end());
    data[around[k]].parts[0].holes.push_back(std::move(hole));
  }
  std::vector<DrawnPart> parts;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    if (depth[k] % 2 != 0) continue;
    const std::string name = "part " + std::to_string(parts.size());
    parts.push_back({"", required_region(source, std::move(data[k]), name)});
  }
  return parts;
}

/// The rings of a part, each by itself.
void add_rings(const Source& source, const Part& part, std::vector<DrawnPart>& rings) {
  std::vector<Ring> all{part.outer};
  all.insert(all.end(), part.holes.begin(), part.holes.end());
  for (Ring& ring : all) {
    RegionData data;
    data.parts.push_back({std::move(ring), {}});
    DrawnPart drawn("", required_region(source, std::move(data), "ring " + std::to_string(rings.size())));
    if (!drawn.region.parts().empty()) rings.push_back(std::move(drawn));
  }
}

std::vector<DrawnPart> dxf_rings(const Source& source, std::string_view text) {
  std::vector<DrawnPart> rings;
  for (const NamedShape& shape : read_dxf({text, source.file, source.options})) {
    refuse_thin(source, shape.data);
    for (const Part& part : shape.data.parts) add_rings(source, part, rings);
  }
  return rings;
}

/// The text without the entities of one layer, or with these alone.
std::string layer_of(const Source& source, std::string_view layer, bool alone) {
  const std::vector<DxfGroup> groups = dxf_groups(source);
  std::string text(source.text);
  std::vector<std::pair<std::size_t, std::size_t>> left_out;  // bytes
  std::optional<bool> polyline;                               // whether the one that is open goes
  for (const DxfEntity& entity : dxf_entities(source, groups, "ENTITIES")) {
    const DxfGroup* const name = entity.find(8);
    bool out = (name != nullptr && name->value == layer) != alone;
    if (entity.kind == "VERTEX" || entity.kind == "SEQEND") out = polyline.value_or(out);
    polyline = entity.kind == "POLYLINE" ? std::optional(out) : entity.kind == "SEQEND" ? std::nullopt : polyline;
    if (!out) continue;
    // From its code 0, on the line before the kind, to that of what follows.
    const auto line_before = [&](std::size_t offset) {
      const std::size_t own = text.rfind('\n', offset), code = own == 0 ? own : text.rfind('\n', own - 1);
      return code == std::string::npos ? 0 : code + 1;
    };
    left_out.emplace_back(line_before(entity.offset), line_before(entity.last->offset));
  }
  for (auto it = left_out.rbegin(); it != left_out.rend(); ++it) text.erase(it->first, it->second - it->first);
  return text;
}

class SvgLayouts {
 public:
  SvgLayouts(const Source& source, const LayoutReadOptions& options) : source_(source), options_(options) {}

  std::vector<Layout> read() {
    // What is wrong with the file as a whole, its reader says.
    static_cast<void>(read_svg(source_));
    document_.load_buffer(source_.text.data(), source_.text.size(), pugi::parse_default, pugi::encoding_utf8);
    visit(document_.document_element());
    if (!options_.container.empty() && !largest() && !none() && bins_.empty())
      refuse(source_, "no element has the id " + in_quotes(options_.container));
    if (bins_.empty()) {
      std::vector<DrawnPart> parts;
      for (auto& [node, part] : parts_) parts.push_back(std::move(part));
      std::optional<DrawnPart> container = none() ? std::nullopt : take_largest(parts);
      return {layout_of(std::move(parts), std::move(container))};
    }
    std::vector<std::vector<DrawnPart>> parts(bins_.size());
    for (auto& [node, part] : parts_) parts[bin_around(node)].push_back(std::move(part));
    std::vector<Layout> layouts;
    for (std::size_t k = 0; k < bins_.size(); ++k)
      layouts.push_back(layout_of(std::move(parts[k]), std::move(bins_[k].second)));
    return layouts;
  }

 private:
  using Node = pugi::xml_node;

  bool largest() const { return options_.container == "largest"; }
  bool none() const { return options_.container == "none"; }

  static bool has_class(const Node& node, std::string_view name) {
    std::istringstream words(node.attribute("class").value());
    for (std::string word; words >> word;)
      if (word == name) return true;
    return false;
  }
  static std::string_view local_name(const Node& node) {
    const std::string_view name = node.name();
    return name.starts_with("svg:") ? name.substr(4) : name;
  }
  static bool is_shape(const Node& node) {
    static constexpr std::array<std::string_view, 8> kShapes{"path",    "polygon", "rect", "circle",
                                                             "ellipse", "use",     "line", "polyline"};
    return std::find(kShapes.begin(), kShapes.end(), local_name(node)) != kShapes.end();
  }
  bool is_bin(const Node& node) const {
    if (options_.container.empty()) return has_class(node, "bin");
    return !largest() && !none() && options_.container == node.attribute("id").value();
  }

  void visit(const Node& group) {
    bool holes = false;
    for (const Node& child : group.children()) holes |= is_shape(child) && has_class(child, "hole");
    if (holes) return add(group, group.attribute("id").value(), with_holes(group));
    for (const Node& child : group.children()) {
      const std::string_view name = local_name(child);
      if (is_shape(child)) add(child, child.attribute("id").value(), drawn(child));
      else if (name == "g" || name == "svg" || name == "a" || name == "switch") visit(child);
    }
  }

  void add(const Node& node, const std::string& id, RegionData data) {
    refuse_thin(source_, data);
    Region region = required_region(source_, std::move(data), id.empty() ? "an element" : in_quotes(id));
    if (region.parts().empty()) return;
    (is_bin(node) ? bins_ : parts_).emplace_back(node, DrawnPart(id, std::move(region)));
  }

  /// The rings of a group that is one part.
  RegionData with_holes(const Node& group) const {
    std::vector<DrawnPart> rings;
    for (const Node& child : group.children()) {
      if (!is_shape(child)) continue;
      const RegionData data = drawn(child);
      refuse_thin(source_, data);
      for (const Part& part : data.parts) add_rings(source_, part, rings);
    }
    RegionData all;
    for (const DrawnPart& part : nested(source_, std::move(rings)))
      for (const Part& p : part.region.parts()) all.parts.push_back(p);
    return all;
  }

  /// The bin beside the element, or beside what is around it.
  std::size_t bin_around(const Node& node) const {
    if (bins_.size() == 1) return 0;
    for (Node around = node.parent(); around; around = around.parent())
      for (std::size_t k = 0; k < bins_.size(); ++k)
        if (bins_[k].first.parent() == around) return k;
    refuse(source_, "there are several bins, and an element stands beside none of them");
  }

  /// What an element draws where it stands: the file with this alone.
  RegionData drawn(const Node& node) const {
    std::vector<Node> around;
    for (Node n = node.parent(); n.type() == pugi::node_element; n = n.parent()) around.push_back(n);
    pugi::xml_document alone;
    Node to = alone;
    for (auto it = around.rbegin(); it != around.rend(); ++it) {
      to = to.append_child(it->name());
      for (const pugi::xml_attribute& attribute : it->attributes()) to.append_copy(attribute);
      for (const Node& child : it->children())
        if (local_name(child) == "style" || local_name(child) == "defs") to.append_copy(child);
    }
    to.append_copy(node);
    std::ostringstream text;
    alone.save(text, "", pugi::format_raw | pugi::format_no_declaration);
    const std::string made = text.str();
    std::vector<NamedShape> shapes = read_svg({made, source_.file, source_.options});
    return std::move(shapes.at(0).data);
  }

  const Source& source_;
  const LayoutReadOptions& options_;
  pugi::xml_document document_;
  std::vector<std::pair<Node, DrawnPart>> bins_, parts_;
};

}  // namespace

std::vector<Layout> dxf_layouts(const Source& source, const LayoutReadOptions& options) {
  if (options.container == "none") return {layout_of(nested(source, dxf_rings(source, source.text)), std::nullopt)};
  if (options.container.empty() || options.container == "largest") {
    std::vector<DrawnPart> rings = dxf_rings(source, source.text);
    std::optional<DrawnPart> container = take_largest(rings);
    return {layout_of(nested(source, std::move(rings)), std::move(container))};
  }
  const std::string others = layer_of(source, options.container, false),
                    own = layer_of(source, options.container, true);
  std::vector<DrawnPart> container = nested(source, dxf_rings(source, own));
  if (container.size() != 1)
    refuse(source, "the layer " + in_quotes(options.container) + " has " + std::to_string(container.size()) +
                       " shapes, and a container is one");
  return {layout_of(nested(source, dxf_rings(source, others)), std::move(container[0]))};
}

std::vector<Layout> svg_layouts(const Source& source, const LayoutReadOptions& options) {
  return SvgLayouts(source, options).read();
}

}  // namespace dymsum::io
