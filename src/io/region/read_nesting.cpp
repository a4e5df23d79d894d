// Nesting instances as jagua-rs reads them: items[].shape {type, data} with the types simple_polygon, polygon (outer,
// inner), multi_polygon, rectangle; besides, of our own: region (parts, polylines, points).
#include <cmath>
#include <utility>

#include "io/region/json_shapes.h"

namespace dymsum::io {

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
