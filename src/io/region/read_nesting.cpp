// Nesting instances as jagua-rs reads them: items[].shape {type, data} with the types simple_polygon, polygon (outer,
// inner), multi_polygon, rectangle; besides, of our own: region (parts, polylines, points).
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "dymsum/nesting.h"
#include "dymsum/region_io.h"
#include "io/read_file.h"
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
