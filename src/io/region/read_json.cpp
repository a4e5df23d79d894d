#include <cmath>

#include "io/number_text.h"
#include "io/region/json_shapes.h"
#include "io/region/readers.h"
#include "io/region/ring_order.h"

namespace dymsum::io {

JsonValue require_member(const Source& source, const JsonValue& object, std::string_view key) {
  if (!object.is_object()) {
    source.fail_on_line(ErrorCode::malformed, "expected an object with '" + std::string(key) + "'", object.line());
  }
  const auto value = object.find(key);
  if (!value) source.fail_on_line(ErrorCode::malformed, "the object has no '" + std::string(key) + "'", object.line());
  return *value;
}

const std::string& require_text(const Source& source, const JsonValue& value, std::string_view what) {
  if (value.kind() != JsonKind::string) {
    source.fail_on_line(ErrorCode::malformed, "expected " + std::string(what) + " as a string", value.line());
  }
  return value.text();
}

Point require_position(const Source& source, const JsonValue& value) {
  if (value.kind() == JsonKind::array && source.drops_third()) {
    std::vector<double> numbers;
    bool only_numbers = true;
    value.each([&](const JsonValue& v) {
      only_numbers &= v.kind() == JsonKind::number;
      if (v.kind() == JsonKind::number && numbers.size() < 4) numbers.push_back(v.number());
    });
    if (only_numbers && numbers.size() > 2) return {numbers[0], numbers[1]};
  }
  if (value.kind() != JsonKind::pair) {
    source.fail_on_line(ErrorCode::malformed, "expected a position of two numbers, [x, y]; others are not planar",
                        value.line());
  }
  return value.pair();
}

std::vector<Point> require_positions(const Source& source, const JsonValue& value) {
  std::vector<Point> points;
  visit_array(source, value, "positions", [&](const JsonValue& p) { points.push_back(require_position(source, p)); });
  return points;
}

bool is_empty_array(const JsonValue& value) {
  bool any = false;
  value.each([&](const JsonValue&) { any = true; });
  return value.kind() == JsonKind::array && !any;
}

std::optional<std::string> name_of(const JsonValue& value) {
  if (value.kind() == JsonKind::string) return value.text();
  if (value.kind() != JsonKind::number) return std::nullopt;
  std::string text;
  append_number(text, value.number());
  return text;
}

/// [[x, y], ...], as footprints of robots are written: one ring, either way round, closed or not.
std::vector<NamedShape> read_footprint(const Source& source, const JsonValue& value) {
  Ring ring = require_positions(source, value);
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  std::vector<NamedShape> shapes(1);
  shapes[0].data.parts = {{std::move(ring), {}}};
  orient_rings(shapes[0].data.parts[0]);
  return shapes;
}

std::vector<NamedShape> read_json(const Source& source) {
  const JsonTape tape(source);
  const JsonValue root = tape.root();
  if (root.kind() == JsonKind::array) return read_footprint(source, root);
  if (const auto footprint = root.find("footprint")) return read_footprint(source, *footprint);
  if (root.find("items")) return read_nesting(source, root);
  if (root.find("type")) return read_geojson(source, root);
  source.fail_on_line(
      ErrorCode::malformed,
      "expected an object with 'items' (nesting instance), 'type' (GeoJSON) or 'footprint', or an array of positions",
      root.line());
}

}  // namespace dymsum::io
