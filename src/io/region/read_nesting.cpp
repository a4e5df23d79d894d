// Nesting instances as jagua-rs reads them: items[].shape {type, data} with the types simple_polygon, polygon (outer,
// inner), multi_polygon, rectangle; besides, of our own: region (parts, polylines, points).
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "dymsum/layout_check.h"
#include "dymsum/nesting.h"
#include "dymsum/region_io.h"
#include "io/read_file.h"
#include "io/region/drawn_layouts.h"
#include "io/region/json_shapes.h"
#include "io/source.h"

namespace dymsum {

// The whole of a nesting instance: what read_nesting leaves out.

namespace {

using io::JsonKind;
using io::JsonValue;

class InstanceReader {
 public:
  explicit InstanceReader(const io::Source& source) : source_(source) {}

  NestingInstance read(const JsonValue& root) const {
    NestingInstance instance;
    io::visit_array(source_, io::require_member(source_, root, "items"), "items",
                    [&](const JsonValue& item) { instance.items.push_back(read_item(item)); });
    if (const auto name = root.find("name")) instance.name = io::name_of(*name).value_or("");
    if (const auto bins = root.find("bins")) {
      io::visit_array(source_, *bins, "bins", [&](const JsonValue& bin) { instance.bins.push_back(read_bin(bin)); });
    }
    if (const auto height = root.find("strip_height"); height && height->kind() != JsonKind::null) {
      instance.strip_height = number(*height, "'strip_height'");
      if (!(*instance.strip_height > 0)) fail("'strip_height' has to be positive", *height);
    }
    name_all(instance.items, "items", root);
    name_all(instance.bins, "bins", root);
    return instance;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const JsonValue& at) const {
    source_.fail_on_line(ErrorCode::malformed, what, at.line());
  }

  double number(const JsonValue& value, const std::string& what) const {
    if (value.kind() != JsonKind::number) fail("expected a number as " + what, value);
    return value.number();
  }

  NestingItem read_item(const JsonValue& json) const {
    NamedShape shape = io::read_nesting_shape(source_, json);
    NestingItem item{std::move(shape.name), std::move(shape.data), 1, std::nullopt};
    if (const auto demand = json.find("demand")) {
      const double count = number(*demand, "'demand'");
      constexpr double kMost = 0x1p53;
      if (!(count >= 0 && count <= kMost && count == std::floor(count))) fail("'demand' has to be a count", *demand);
      item.demand = static_cast<std::uint64_t>(count);
    }
    if (const auto allowed = json.find("allowed_orientations"); allowed && allowed->kind() != JsonKind::null)
      item.degrees = read_degrees(*allowed);
    return item;
  }

  std::vector<Rational> read_degrees(const JsonValue& list) const {
    std::vector<Rational> degrees;
    const auto add = [&](double value) {
      std::string text;
      io::append_number(text, value);
      degrees.push_back(Rational::parse(text).value());
    };
    if (list.kind() == JsonKind::pair) {
      add(list.pair().x);
      add(list.pair().y);
      return degrees;
    }
    io::visit_array(source_, list, "orientations",
                    [&](const JsonValue& one) { add(number(one, "an orientation in degrees")); });
    if (degrees.empty()) fail("the item is allowed no orientation", list);
    return degrees;
  }

  NestingBin read_bin(const JsonValue& json) const {
    NamedShape shape = io::read_nesting_shape(source_, json);
    if (const auto zones = json.find("zones"); zones && zones->kind() != JsonKind::null) {
      io::visit_array(source_, *zones, "zones", [&](const JsonValue& zone) {
        fail("zones of other quality are not supported: cut them out of the bin as holes", zone);
      });
    }
    return {std::move(shape.name), std::move(shape.data)};
  }

  /// Names by its index what has no name. Rows of a table are distinguished by names.
  template <class T>
  void name_all(std::vector<T>& all, const std::string& what, const JsonValue& root) const {
    std::set<std::string> names;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].name.empty()) all[i].name = std::to_string(i);
      if (!names.insert(all[i].name).second) fail("two " + what + " are named " + io::in_quotes(all[i].name), root);
    }
  }

  const io::Source& source_;
};

}  // namespace

Result<NestingInstance> parse_nesting_instance(std::string_view text, std::string_view name_for_errors) {
  const io::PlainText plain(text);
  const io::Source source{plain.view(), name_for_errors};
  try {
    const io::JsonTape tape(source);
    return InstanceReader(source).read(tape.root());
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

Result<NestingInstance> read_nesting_instance(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  return parse_nesting_instance(*text, path);
}

}  // namespace dymsum

namespace dymsum::io {

// Nesting instances as jagua-rs reads them: items[].shape {type, data} with the types simple_polygon, polygon (outer,
// inner), multi_polygon, rectangle; besides, of our own: region (parts, polylines, points).

namespace {

class ShapeReader {
 public:
  explicit ShapeReader(const Source& source) : source_(source) {}

  RegionData read(const JsonValue& shape) const {
    const std::string& type = require_text(source_, require_member(source_, shape, "type"), "'type'");
    RegionData data;
    if (type == "simple_polygon") {
      data.parts.push_back({read_ring(require_member(source_, shape, "data")), {}});
    } else if (type == "polygon") {
      const auto inner = shape.find("data");
      data.parts.push_back(read_polygon(inner ? *inner : shape));
    } else if (type == "multi_polygon") {
      data.parts = read_parts(require_member(source_, shape, "data"));
    } else if (type == "rectangle") {
      data.parts.push_back(read_rectangle(require_member(source_, shape, "data")));
    } else if (type == "region") {
      data = read_region(require_member(source_, shape, "data"));
    } else {
      source_.fail_on_line(ErrorCode::malformed, "unknown shape type " + in_quotes(type), shape.line());
    }
    return data;
  }

 private:
  /// Real files name the first vertex once more at the end.
  Ring read_ring(const JsonValue& value) const {
    Ring ring = require_positions(source_, value);
    if (ring.size() > 3 && ring.front() == ring.back()) ring.pop_back();
    return ring;
  }

  Part read_polygon(const JsonValue& value) const {
    Part part{read_ring(require_member(source_, value, "outer")), {}};
    if (const auto inner = value.find("inner"); inner && inner->kind() != JsonKind::null) {
      visit_array(source_, *inner, "holes", [&](const JsonValue& hole) {
        if (!is_empty_array(hole)) part.holes.push_back(read_ring(hole));
      });
    }
    return part;
  }

  std::vector<Part> read_parts(const JsonValue& value) const {
    std::vector<Part> parts;
    visit_array(source_, value, "polygons", [&](const JsonValue& polygon) { parts.push_back(read_polygon(polygon)); });
    return parts;
  }

  double read_number(const JsonValue& object, std::string_view key) const {
    const JsonValue value = require_member(source_, object, key);
    if (value.kind() != JsonKind::number) {
      source_.fail_on_line(ErrorCode::malformed, "expected a number as '" + std::string(key) + "'", value.line());
    }
    return value.number();
  }

  Part read_rectangle(const JsonValue& value) const {
    const double x0 = read_number(value, "x_min"), y0 = read_number(value, "y_min");
    const double x1 = x0 + read_number(value, "width"), y1 = y0 + read_number(value, "height");
    if (!std::isfinite(x1) || !std::isfinite(y1)) {
      source_.fail_on_line(ErrorCode::not_finite, "the rectangle leaves the double range", value.line());
    }
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
  }

  RegionData read_region(const JsonValue& value) const {
    RegionData data;
    data.parts = read_parts(require_member(source_, value, "parts"));
    visit_array(source_, require_member(source_, value, "polylines"), "polylines",
                [&](const JsonValue& line) { data.polylines.push_back(require_positions(source_, line)); });
    data.points = require_positions(source_, require_member(source_, value, "points"));
    return data;
  }

  const Source& source_;
};

}  // namespace

NamedShape read_nesting_shape(const Source& source, const JsonValue& item) {
  NamedShape shape;
  shape.data = ShapeReader(source).read(require_member(source, item, "shape"));
  if (const auto id = item.find("id")) shape.name = name_of(*id).value_or("");
  return shape;
}

std::vector<NamedShape> read_nesting(const Source& source, const JsonValue& root) {
  std::vector<NamedShape> shapes;
  visit_array(source, require_member(source, root, "items"), "items",
              [&](const JsonValue& item) { shapes.push_back(read_nesting_shape(source, item)); });
  return shapes;
}

}  // namespace dymsum::io

namespace dymsum {

// Layouts as jagua-rs and sparrow write them: an instance and the items that are placed.

namespace {

class LayoutReader {
 public:
  LayoutReader(const io::Source& source, bool repair) : source_(source), repair_(repair) {}

  std::vector<Layout> read(const JsonValue& root) {
    const JsonValue instance = root.find("instance").value_or(root);
    const JsonValue solution = root.find("solution").value_or(root);
    io::visit_array(source_, io::require_member(source_, instance, "items"), "items",
                    [&](const JsonValue& item) { add_shape(item, item_ids_, shapes_, "item"); });
    if (const auto bins = instance.find("bins"))
      io::visit_array(source_, *bins, "bins",
                      [&](const JsonValue& bin) { add_shape(bin, bin_ids_, containers_, "bin"); });
    std::vector<Layout> layouts;
    if (const auto one = solution.find("layout")) layouts.push_back(layout(*one, strip(instance, solution)));
    else
      io::visit_array(source_, io::require_member(source_, solution, "layouts"), "layouts",
                      [&](const JsonValue& json) { layouts.push_back(layout(json, bin_of(json))); });
    return layouts;
  }

 private:
  using Ids = std::map<std::string, std::uint32_t>;

  [[noreturn]] void fail(const std::string& what, const JsonValue& at) const {
    source_.fail_on_line(ErrorCode::malformed, what, at.line());
  }

  void add_shape(const JsonValue& json, Ids& ids, std::vector<Region>& to, const std::string& what) {
    NamedShape shape = io::read_nesting_shape(source_, json);
    if (shape.name.empty()) shape.name = std::to_string(to.size());
    Result<Region> region = region_of(std::move(shape.data), what + " " + io::in_quotes(shape.name));
    if (!region)
      throw io::ReadFailure{{region.error().code,
                             what + " " + io::in_quotes(shape.name) + ": " + region.error().message,
                             region.error().evidence}};
    if (!ids.try_emplace(shape.name, static_cast<std::uint32_t>(to.size())).second)
      fail("two " + what + "s are named " + io::in_quotes(shape.name), json);
    to.push_back(*std::move(region));
  }

  Result<Region> region_of(RegionData data, const std::string& name) {
    if (!repair_) return Region::create(std::move(data));
    Result<Repaired> repaired = dymsum::repair(std::move(data));
    if (!repaired) return repaired.error();
    if (repaired->report.changed()) notes_.push_back(name + ": " + repaired->report.to_string());
    return std::move(repaired).value().region;
  }

  double number(const JsonValue& object, std::string_view key) const {
    const JsonValue value = io::require_member(source_, object, key);
    if (value.kind() != JsonKind::number) fail("expected a number as '" + std::string(key) + "'", value);
    return value.number();
  }

  std::optional<Region> strip(const JsonValue& instance, const JsonValue& solution) const {
    if (!instance.find("strip_height")) return std::nullopt;
    const double height = number(instance, "strip_height"), width = number(solution, "strip_width");
    if (!(height > 0 && width > 0)) fail("the strip has to have a positive height and width", solution);
    return Region::create({{{{{0, 0}, {width, 0}, {width, height}, {0, height}}, {}}}, {}, {}}).value();
  }

  std::optional<Region> bin_of(const JsonValue& layout) const {
    return containers_[index(layout, "container_id", bin_ids_, "bin")];
  }

  std::uint32_t index(const JsonValue& object, std::string_view key, const Ids& ids, const std::string& what) const {
    const JsonValue value = io::require_member(source_, object, key);
    const auto it = ids.find(io::name_of(value).value_or(""));
    if (it == ids.end()) fail("there is no " + what + " with this '" + std::string(key) + "'", value);
    return it->second;
  }

  Layout layout(const JsonValue& json, std::optional<Region> container) const {
    Layout layout;
    layout.shapes = shapes_;
    layout.container = std::move(container);
    layout.notes = notes_;
    io::visit_array(source_, io::require_member(source_, json, "placed_items"), "placed items",
                    [&](const JsonValue& item) { layout.parts.push_back(part(item)); });
    return layout;
  }

  LayoutPart part(const JsonValue& item) const {
    LayoutPart part;
    part.shape = index(item, "item_id", item_ids_, "item");
    part.name = io::name_of(io::require_member(source_, item, "item_id")).value_or("");
    const JsonValue move = io::require_member(source_, item, "transformation");
    const double radians = reduced_degrees(Rational::of(number(move, "rotation")).value());
    part.orientation = Orientation::nearest(radians).value();
    part.at = position(io::require_member(source_, move, "translation"));
    return part;
  }

  // Numbers, or texts that are fractions.
  RationalPoint position(const JsonValue& value) const {
    if (value.kind() == JsonKind::pair)
      return {Rational::of(value.pair().x).value(), Rational::of(value.pair().y).value()};
    std::vector<Rational> both;
    io::visit_array(source_, value, "two coordinates", [&](const JsonValue& one) {
      if (one.kind() == JsonKind::number) return both.push_back(Rational::of(one.number()).value());
      Result<Rational> r = Rational::parse(io::require_text(source_, one, "a coordinate as a number or a fraction"));
      if (!r) fail(r.error().message, one);
      both.push_back(*std::move(r));
    });
    if (both.size() != 2) fail("expected two coordinates", value);
    return {both[0], both[1]};
  }

  const io::Source& source_;
  bool repair_;
  std::vector<std::string> notes_;
  std::vector<Region> shapes_, containers_;
  Ids item_ids_, bin_ids_;
};

}  // namespace

Result<std::vector<Layout>> parse_layouts(std::string_view text, std::string_view name_for_errors,
                                          const LayoutReadOptions& options, LayoutFormat format) {
  const io::PlainText plain(text);
  const io::Source source{plain.view(), name_for_errors};
  try {
    if (format == LayoutFormat::dxf) return io::dxf_layouts(source, options);
    if (format == LayoutFormat::svg) return io::svg_layouts(source, options);
    if (!options.container.empty())
      return io::file_error(ErrorCode::unsupported_operand,
                            "a container is chosen in drawings (.dxf, .svg), not in JSON", name_for_errors);
    const io::JsonTape tape(source);
    return LayoutReader(source, options.repair).read(tape.root());
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

Result<std::vector<Layout>> read_layouts(const std::string& path, const LayoutReadOptions& options) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  const std::string extension = io::extension(path);
  const bool dxf = path == "-" ? begins_like_dxf(*text) : extension == ".dxf";
  const bool svg = path == "-" ? text->find_first_not_of(" \t\r\n") == text->find('<') && !dxf : extension == ".svg";
  return parse_layouts(*text, path == "-" ? "standard input" : path, options,
                       dxf   ? LayoutFormat::dxf
                       : svg ? LayoutFormat::svg
                             : LayoutFormat::json);
}

}  // namespace dymsum
