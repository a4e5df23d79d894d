// SVG: path, polygon, polyline, rect, circle, ellipse, line and use elements, all together one shape, coordinates as
// they stand in the file (SVG's y axis points down; nothing is flipped); of the outermost element no viewBox is
// applied, and nothing is clipped. What is not drawn is not read. Our own files carry data-dymsum attributes and read
// back exactly.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include <pugixml.hpp>

#include "io/region/curves.h"
#include "io/region/read_shapes.h"
#include "io/region/ring_order.h"
#include "io/region/svg_path.h"
#include "io/source.h"

namespace dymsum::io {

namespace {

constexpr const char* kMark = "data-dymsum";

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.starts_with("svg:") ? name.substr(4) : name;
}

class SvgReader {
 public:
  explicit SvgReader(const Source& source) : source_(source) {}

  NamedShape read() {
    // Line ends inside attributes are kept for the evidence: they are not turned into blanks.
    const auto result = document_.load_buffer(source_.text.data(), source_.text.size(),
                                              pugi::parse_default & ~pugi::parse_wconv_attribute, pugi::encoding_utf8);
    if (!result) refuse_document(result);
    const pugi::xml_node root = document_.document_element();
    if (local_name(root) != "svg") fail(root, "the outermost element is " + in_quotes(root.name()) + ", not svg");
    const std::string_view mark = root.attribute(kMark).value();
    if (mark == "trace") fail(root, "this is a picture of a computation's stages, not of one region");
    marked_ = !mark.empty();
    if (!marked_) {
      read_sheets(root);
      refuse_cutting(root);
    }
    if (marked_ || !is_transparent(root)) walk(root, transform_of(root));
    return {"", std::move(data_), unit_of(root), curves_};
  }

 private:
  static constexpr std::size_t kMostNested = 200, kMostUses = 16, kMostElements = 1'000'000;

  /// A unit of length that a coordinate is one of: where the picture is as many of it wide as its viewBox.
  static std::string unit_of(const pugi::xml_node& root) {
    const std::string_view width = root.attribute("width").value(), box = root.attribute("viewBox").value();
    const ScannedNumber wide = scan_number(width);
    const std::string_view unit = width.substr(std::min(wide.length, width.size()));
    if (unit != "mm" && unit != "cm" && unit != "in") return "";
    std::string_view rest = box;
    double numbers[3] = {};
    for (double& number : numbers) {
      rest.remove_prefix(std::min(rest.find_first_not_of(" ,\t\r\n"), rest.size()));
      const ScannedNumber one = scan_number(rest);
      number = one.value;
      rest.remove_prefix(one.length);
    }
    return numbers[2] == wide.value ? std::string(unit) : "";
  }

  [[noreturn]] void refuse_document(const pugi::xml_parse_result& result) const {
    const auto offset = static_cast<std::size_t>(result.offset);
    const bool ended = source_.text.find('>', offset) == std::string_view::npos;
    source_.fail(ended ? ErrorCode::truncated : ErrorCode::malformed, std::string("XML: ") + result.description(),
                 offset);
  }

  [[noreturn]] void fail(const pugi::xml_node& node, std::string message) const {
    source_.fail(ErrorCode::malformed, std::move(message), offset_of(node));
  }

  static std::size_t offset_of(const pugi::xml_node& node) {
    return node.offset_debug() > 0 ? static_cast<std::size_t>(node.offset_debug()) : 0;
  }

  /// What is in an element, depth first without recursion; transforms_[k] holds at depth k.
  void walk(const pugi::xml_node& root, const PlaneTransform& placement) {
    const std::vector<PlaneTransform> outer = std::exchange(transforms_, {placement});
    walk_children(root);
    transforms_ = outer;
  }
  void walk_children(const pugi::xml_node& root) {
    pugi::xml_node node = root.first_child();
    while (node) {
      const bool enter = visit(node) && node.first_child();
      if (enter) {
        if (transforms_.size() == kMostNested) fail(node, "elements nested deeper than " + std::to_string(kMostNested));
        transforms_.push_back(transforms_.back().after(transform_of(node)));
        node = node.first_child();
        continue;
      }
      while (node && node != root && !node.next_sibling()) {
        node = node.parent();
        transforms_.pop_back();
      }
      if (!node || node == root) return;
      node = node.next_sibling();
    }
  }

  /// Takes an element's shape; returns true when its children are drawn too.
  bool visit(const pugi::xml_node& node) {
    if (node.type() != pugi::node_element) return false;
    const std::string_view name = local_name(node);
    if (++elements_ > kMostElements) fail(node, "it draws more than 1000000 elements");
    if (!marked_ && (property(node, "display") == "none" || is_transparent(node))) return false;
    if (!marked_) refuse_placing(node);
    if (!marked_ && name == "svg" && draws_nothing(node)) return false;
    if (name == "g" || name == "svg" || name == "a" || name == "switch") return true;
    if (marked_) {
      if (name == "path" && node.attribute(kMark)) take_marked(node);
      return false;
    }
    if (is_hidden(node)) return false;
    current_ = transforms_.back().after(transform_of(node));
    try {
      take_shape(node, name);
    } catch (const CurveFailure& failure) {
      source_.fail(failure.trouble == CurveTrouble::not_finite ? ErrorCode::not_finite : ErrorCode::malformed,
                   io::text_of(failure), offset_of(node));
    }
    return false;
  }

  void take_shape(const pugi::xml_node& node, std::string_view name) {
    if (name == "path") take_path(node);
    if (name == "polygon") take_ring(node, parse_points(source_, text_of(node, "points")));
    if (name == "polyline") take_polyline(node, parse_points(source_, text_of(node, "points")));
    if (name == "rect") take_rectangle(node);
    if (name == "line") {
      const Point from{length(node, "x1"), length(node, "y1")}, to{length(node, "x2"), length(node, "y2")};
      take_polyline(node, {from, to});
    }
    if (name == "circle") take_ellipse(node, {size(node, "r"), size(node, "r")});
    if (name == "ellipse") take_ellipse(node, {size(node, "rx"), size(node, "ry")});
    if (name == "use") take_use(node);
    if (name == "image" || name == "foreignObject") fail(node, "the element " + in_quotes(name) + " cannot be read");
  }

  /// What an element names, drawn where it is placed.
  void take_use(const pugi::xml_node& use) {
    const pugi::xml_attribute plain = use.attribute("href"), linked = use.attribute("xlink:href");
    const std::string_view href = (plain ? plain : linked).value();
    if (!href.starts_with('#')) fail(use, "what a use element draws has to be an element of this file");
    const pugi::xml_node target = element_named(href.substr(1));
    if (!target) fail(use, "a use element draws " + in_quotes(href) + ", which there is none of");
    if (uses_.size() == kMostUses) fail(use, "use elements draw each other in a circle, or too deep");
    const PlaneTransform placement = current_.after({1, 0, 0, 1, length(use, "x"), length(use, "y")});
    uses_.push_back({target, use});
    const std::vector<PlaneTransform> outer = std::exchange(transforms_, {placement});
    if (local_name(target) == "symbol") {
      walk(target, placement.after(symbol_viewport(target, use)));
    } else if (visit(target)) {
      walk(target, placement.after(transform_of(target)));
    }
    transforms_ = outer;
    uses_.pop_back();
  }

  pugi::xml_node element_named(std::string_view id) {
    if (ids_.empty()) {
      document_.document_element().find_node([this](const pugi::xml_node& node) {
        if (node.attribute("id")) ids_.emplace(node.attribute("id").value(), node);
        return false;
      });
    }
    const auto found = ids_.find(id);
    return found == ids_.end() ? pugi::xml_node() : found->second;
  }

  PlaneTransform symbol_viewport(const pugi::xml_node& symbol, const pugi::xml_node& use) const {
    if (!symbol.attribute("viewBox")) return {};
    if (!use.attribute("width") || !use.attribute("height"))
      fail(use, "a symbol with a viewBox needs width and height of the element that draws it");
    return parse_view_box(source_, text_of(symbol, "viewBox"), {0, 0, size(use, "width"), size(use, "height")},
                          symbol.attribute("preserveAspectRatio").value());
  }

  void take_ellipse(const pugi::xml_node& node, Point radii) {
    if (radii.x == 0 || radii.y == 0) return;  // draws nothing
    const Point centre = current_.apply({length(node, "cx"), length(node, "cy")});
    take_chain(node, ellipse_ring(centre, current_.apply_vector({radii.x, 0}), current_.apply_vector({0, radii.y}),
                                  source_.options.curves));
  }

  void take_marked(const pugi::xml_node& node) {
    const std::string_view kind = node.attribute(kMark).value();
    std::vector<Subpath> paths = parse_path(source_, text_of(node, "d"), {});
    for (const Subpath& path : paths)
      if (path.chain.curves > 0) fail(node, "a path of a region of our own has curves");
    if (kind == "part") {
      Part part;
      for (std::size_t k = 0; k < paths.size(); ++k) {
        if (!paths[k].closed) fail(node, "a ring of a part is not closed");
        (k == 0 ? part.outer : part.holes.emplace_back()) = std::move(paths[k].chain.on);
      }
      data_.parts.push_back(std::move(part));
    } else if (kind == "polylines") {
      for (Subpath& path : paths) data_.polylines.push_back(std::move(path.chain.on));
    } else if (kind == "points") {
      for (const Subpath& path : paths) data_.points.push_back(path.chain.front());
    } else {
      fail(node, std::string("unknown ") + kMark + " " + in_quotes(kind));
    }
  }

  void take_path(const pugi::xml_node& node) {
    std::vector<ChordChain> chains;
    for (Subpath& path : parse_path(source_, text_of(node, "d"), current_)) {
      require_finite(node, path.chain.on);
      curves_ += path.chain.curves;
      if (path.closed) chains.push_back(std::move(path.chain));
      else data_.polylines.push_back(std::move(path.chain.on));
    }
    const FillRule rule = fill_rule(node);
    if (chains.size() > 1 && sheet_fills_) refuse_unknown_rule(node, chains);
    if (!nest_chains(std::move(chains), data_.parts, source_.options.curves.bound, rule)) fail_crowded(node);
  }

  [[noreturn]] void fail_crowded(const pugi::xml_node& node) const {
    fail(node, "too many rings around one another in one path");
  }

  /// A style sheet may say how a path is filled: it is read only where that makes no difference.
  void refuse_unknown_rule(const pugi::xml_node& node, const std::vector<ChordChain>& chains) const {
    std::vector<Ring> rings;
    for (const ChordChain& chain : chains) rings.push_back(chain.on);
    std::vector<Part> even_odd, nonzero;
    if (!nest_rings(rings, even_odd, FillRule::even_odd) || !nest_rings(rings, nonzero, FillRule::nonzero))
      fail_crowded(node);
    if (even_odd != nonzero)
      fail(node, "how this path is filled depends on a style sheet, and style sheets cannot be read");
  }

  /// The rule of what is filled is SVG's own default too; what is not filled is an outline, and its rings nest.
  FillRule fill_rule(const pugi::xml_node& node) const {
    if (inherited(node, "fill") == "none") return FillRule::even_odd;
    return inherited(node, "fill-rule") == "evenodd" ? FillRule::even_odd : FillRule::nonzero;
  }

  void take_ring(const pugi::xml_node& node, std::vector<Point> vertices) {
    transform(node, vertices);
    if (vertices.size() > 1 && vertices.front() == vertices.back()) vertices.pop_back();
    if (vertices.empty()) return;
    data_.parts.push_back({std::move(vertices), {}});
    orient_rings(data_.parts.back());
  }

  void take_polyline(const pugi::xml_node& node, std::vector<Point> vertices) {
    transform(node, vertices);
    if (!vertices.empty()) data_.polylines.push_back(std::move(vertices));
  }

  /// A closed chain that is a part by itself.
  void take_chain(const pugi::xml_node& node, ChordChain chain) {
    require_finite(node, chain.on);
    curves_ += chain.curves;
    data_.parts.push_back(part_of_chains({std::move(chain)}, source_.options.curves.bound));
  }

  void take_rectangle(const pugi::xml_node& node) {
    const double x0 = length(node, "x"), y0 = length(node, "y"), width = size(node, "width"),
                 height = size(node, "height");
    const double x1 = x0 + width, y1 = y0 + height;
    double rx = size(node, node.attribute("rx") ? "rx" : "ry"), ry = size(node, node.attribute("ry") ? "ry" : "rx");
    rx = std::min(rx, width / 2);
    ry = std::min(ry, height / 2);
    if (rx == 0 || ry == 0) return take_ring(node, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
    // Its sides, each with the quarter of an ellipse that follows it: half axes to the quarter's ends from its centre.
    const Point right{rx, 0}, down{0, ry}, left{-rx, 0}, up{0, -ry};
    const std::pair<Point, std::pair<Point, Point>> corners[] = {{{x1 - rx, y0 + ry}, {up, right}},
                                                                 {{x1 - rx, y1 - ry}, {right, down}},
                                                                 {{x0 + rx, y1 - ry}, {down, left}},
                                                                 {{x0 + rx, y0 + ry}, {left, up}}};
    ChordChain chain;
    for (const auto& [centre, axes] : corners) {
      const auto& [from, to] = axes;
      const Point start = current_.apply({centre.x + from.x, centre.y + from.y});
      if (chain.empty() || chain.back() != start) chain.add(start);
      const EllipseArc quarter{start, current_.apply_vector(from), current_.apply_vector(to), std::numbers::pi / 2};
      append_arc(chain, quarter, current_.apply({centre.x + to.x, centre.y + to.y}), source_.options.curves);
    }
    if (chain.front() == chain.back()) chain.pop_back();
    take_chain(node, std::move(chain));
  }

  void transform(const pugi::xml_node& node, std::vector<Point>& vertices) const {
    for (Point& p : vertices) p = current_.apply(p);
    require_finite(node, vertices);
  }

  void require_finite(const pugi::xml_node& node, const std::vector<Point>& vertices) const {
    for (const Point p : vertices)
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        source_.fail(ErrorCode::not_finite, "a coordinate leaves the double range", offset_of(node));
  }

  double length(const pugi::xml_node& node, const char* name) const {
    return node.attribute(name) ? parse_length(source_, text_of(node, name)) : 0;
  }

  /// A length that must not be negative.
  double size(const pugi::xml_node& node, const char* name) const {
    const double value = length(node, name);
    if (value < 0) fail(node, "the element " + in_quotes(local_name(node)) + " has a negative " + name);
    return value;
  }

  PlaneTransform transform_of(const pugi::xml_node& node) const {
    if (marked_) return {};
    PlaneTransform own;
    if (node.attribute("transform")) own = parse_transform(source_, text_of(node, "transform"));
    const bool nested = local_name(node) == "svg" && node != document_.document_element();
    return nested ? own.after(viewport_of(node)) : own;
  }

  /// The map by which a nested svg element places what is in it.
  PlaneTransform viewport_of(const pugi::xml_node& node) const {
    SvgViewport viewport{length(node, "x"), length(node, "y"), size(node, "width"), size(node, "height")};
    if (!node.attribute("viewBox")) return {1, 0, 0, 1, viewport.x, viewport.y};
    if (!node.attribute("width") || !node.attribute("height"))
      fail(node, "a nested svg element with a viewBox needs its width and height as numbers");
    return parse_view_box(source_, text_of(node, "viewBox"), viewport, node.attribute("preserveAspectRatio").value());
  }

  /// A presentation attribute, or what the element's own style says of it.
  static std::string_view property(const pugi::xml_node& node, std::string_view name) {
    return svg_property(node.attribute("style").value(), name, node.attribute(std::string(name).c_str()).value());
  }

  /// The innermost element that sets a property decides; empty where none does.
  std::string_view inherited(pugi::xml_node node, std::string_view name) const {
    std::size_t uses = uses_.size();  // what is drawn by a use element inherits from that
    while (node.type() == pugi::node_element) {
      const std::string_view value = property(node, name);
      if (!value.empty() && value != "inherit") return value;
      node = uses > 0 && node == uses_[uses - 1].target ? uses_[--uses].use : node.parent();
    }
    return "";
  }

  bool is_hidden(const pugi::xml_node& node) const {
    const std::string_view visibility = inherited(node, "visibility");
    return visibility == "hidden" || visibility == "collapse";
  }

  /// Nothing of it is seen, nor of what is in it.
  static bool is_transparent(const pugi::xml_node& node) { return is_zero(property(node, "opacity")); }
  /// A fraction, which may be in percent, that is not above zero.
  static bool is_zero(std::string_view fraction) {
    const ScannedNumber number = scan_number(fraction);
    return number.length > 0 && number.value <= 0 &&
           fraction.substr(number.length).find_first_not_of("% \t\r\n") == std::string_view::npos;
  }

  /// Styles may place and shape elements as attributes do, and are not read for that.
  void refuse_placing(const pugi::xml_node& node) const {
    const std::string_view style = node.attribute("style").value();
    if (style.find("/*") != std::string_view::npos) fail(node, "a style with comments cannot be read");
    for (const char* name : {"transform", "transform-origin", "translate", "rotate", "scale", "x", "y", "width",
                             "height", "rx", "ry", "d", "offset-path"}) {
      if (!svg_property(style, name, "").empty())
        fail(node, std::string("a style sets ") + name + ", which is read from attributes only");
    }
    if (node.attribute("transform-origin")) fail(node, "transform-origin cannot be read");
    refuse_cutting(node);
  }

  /// What shows a part of an element only.
  void refuse_cutting(const pugi::xml_node& node) const {
    for (const char* name : {"clip-path", "mask", "mask-image"}) {
      const std::string_view cut = property(node, name);
      if (!cut.empty() && cut != "none") fail(node, std::string(name) + " shows a part only, and cannot be read");
    }
  }

  /// An svg element inside another one without width or height.
  bool draws_nothing(const pugi::xml_node& node) const {
    const auto is_zero = [&](const char* name) { return node.attribute(name) && size(node, name) == 0; };
    return is_zero("width") || is_zero("height");
  }

  /// Reads the style sheets of the whole file: they stand in `defs`, too.
  void read_sheets(const pugi::xml_node& root) {
    root.find_node([this](const pugi::xml_node& node) {
      if (local_name(node) != "style") return false;
      refuse_hiding(node);
      sheet_fills_ |= fills(sheet_of(node));
      return false;
    });
  }

  static std::string sheet_of(const pugi::xml_node& node) {
    std::string sheet = node.child_value();
    for (char& c : sheet) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return sheet;
  }
  static bool fills(const std::string& sheet) {
    const std::vector<std::string> fill = values_in(sheet, "fill");
    return !values_in(sheet, "fill-rule").empty() ||
           std::any_of(fill.begin(), fill.end(), [](const std::string& value) { return value.starts_with("none"); });
  }

  void refuse_hiding(const pugi::xml_node& node) const {
    const std::string sheet = sheet_of(node);
    for (const char* name : {"display", "visibility", "transform", "translate", "rotate", "scale"}) {
      if (sheet.find(name) != std::string::npos) refuse_sheet(node, name);
    }
    for (const char* name : {"clip-path", "mask", "mask-image"})
      if (!values_in(sheet, name).empty()) refuse_sheet(node, name);
    for (const std::string& value : values_in(sheet, "opacity"))
      if (is_zero(value)) refuse_sheet(node, "opacity");
  }
  [[noreturn]] void refuse_sheet(const pugi::xml_node& node, const char* name) const {
    fail(node, std::string("a style sheet that sets ") + name + ", and style sheets cannot be read");
  }

  /// What a style sheet says of a property, wherever it does.
  static std::vector<std::string> values_in(const std::string& sheet, const std::string& name) {
    std::vector<std::string> values;
    for (std::size_t at = sheet.find(name); at != std::string::npos; at = sheet.find(name, at + 1)) {
      const std::size_t colon = sheet.find_first_not_of(" \t\r\n", at + name.size());
      if (colon == std::string::npos || sheet[colon] != ':') continue;
      if (at > 0 && (is_letter(sheet[at - 1]) || sheet[at - 1] == '-')) continue;
      const std::size_t begin = sheet.find_first_not_of(" \t\r\n", colon + 1);
      if (begin != std::string::npos) values.push_back(sheet.substr(begin, sheet.find_first_of(";}", begin) - begin));
    }
    return values;
  }

  static SvgText text_of(const pugi::xml_node& node, const char* name) {
    return {node.attribute(name).value(), name, offset_of(node)};
  }

  const Source& source_;
  pugi::xml_document document_;
  bool marked_ = false;
  bool sheet_fills_ = false;  ///< a style sheet says how something is filled
  /// An element that a use element draws.
  struct Use {
    pugi::xml_node target, use;
  };
  std::vector<Use> uses_;  ///< those that are drawn
  std::map<std::string, pugi::xml_node, std::less<>> ids_;
  std::size_t elements_ = 0, curves_ = 0;
  std::vector<PlaneTransform> transforms_;
  PlaneTransform current_;
  RegionData data_;
};

}  // namespace

std::vector<NamedShape> read_svg(const Source& source) { return {SvgReader(source).read()}; }

}  // namespace dymsum::io
