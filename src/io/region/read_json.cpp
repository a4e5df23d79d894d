#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "io/region/json_shapes.h"
#include "io/region/read_shapes.h"
#include "io/region/ring_order.h"
#include "io/source.h"

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

namespace {

class GeoJsonReader {
 public:
  explicit GeoJsonReader(const Source& source) : source_(source) {}

  std::vector<NamedShape> read(const JsonValue& root) {
    std::vector<NamedShape> shapes;
    if (type_of(root) != "FeatureCollection") {
      shapes.push_back(read_shape(root));
      return shapes;
    }
    visit_array(source_, require_member(source_, root, "features"), "features", [&](const JsonValue& feature) {
      if (type_of(feature) != "Feature")
        source_.fail_on_line(ErrorCode::malformed, "expected a Feature", feature.line());
      shapes.push_back(read_shape(feature));
    });
    return shapes;
  }

 private:
  const std::string& type_of(const JsonValue& value) const {
    return require_text(source_, require_member(source_, value, "type"), "'type'");
  }

  NamedShape read_shape(const JsonValue& value) const {
    NamedShape shape;
    if (type_of(value) != "Feature") {
      read_geometry(value, shape.data);
      return shape;
    }
    const JsonValue geometry = require_member(source_, value, "geometry");
    if (geometry.kind() != JsonKind::null) read_geometry(geometry, shape.data);
    const auto properties = value.find("properties");
    for (const auto& label : {value.find("id"), properties ? properties->find("name") : std::nullopt}) {
      if (shape.name.empty() && label) shape.name = name_of(*label).value_or("");
    }
    return shape;
  }

  Ring read_ring(const JsonValue& value) const {
    Ring ring = require_positions(source_, value);
    if (ring.empty() || ring.front() != ring.back()) {
      source_.fail_on_line(ErrorCode::malformed, "the ring is not closed: its last position differs from its first",
                           value.line());
    }
    if (ring.size() > 1) ring.pop_back();
    return ring;
  }

  void read_polygon(const JsonValue& value, RegionData& data) const {
    Part part;
    bool first = true;
    visit_array(source_, value, "rings", [&](const JsonValue& ring) {
      if (!first && is_empty_array(ring)) return;  // no hole
      (first ? part.outer : part.holes.emplace_back()) = read_ring(ring);
      first = false;
    });
    if (first) return;
    orient_rings(part);
    data.parts.push_back(std::move(part));
  }

  /// Nested collections recurse no deeper than the tape allows.
  void read_geometry(const JsonValue& value, RegionData& data) const {
    const std::string& type = type_of(value);
    if (type == "GeometryCollection") {
      visit_array(source_, require_member(source_, value, "geometries"), "geometries",
                  [&](const JsonValue& g) { read_geometry(g, data); });
      return;
    }
    static constexpr std::string_view kKnown[] = {"Point",           "MultiPoint", "LineString",
                                                  "MultiLineString", "Polygon",    "MultiPolygon"};
    if (std::find(std::begin(kKnown), std::end(kKnown), type) == std::end(kKnown)) {
      source_.fail_on_line(ErrorCode::malformed, "unknown GeoJSON type " + in_quotes(type), value.line());
    }
    const JsonValue coordinates = require_member(source_, value, "coordinates");
    if (type == "Point") {
      data.points.push_back(require_position(source_, coordinates));
    } else if (type == "MultiPoint") {
      const std::vector<Point> points = require_positions(source_, coordinates);
      data.points.insert(data.points.end(), points.begin(), points.end());
    } else if (type == "LineString") {
      data.polylines.push_back(require_positions(source_, coordinates));
    } else if (type == "MultiLineString") {
      visit_array(source_, coordinates, "lines",
                  [&](const JsonValue& line) { data.polylines.push_back(require_positions(source_, line)); });
    } else if (type == "Polygon") {
      read_polygon(coordinates, data);
    } else {
      visit_array(source_, coordinates, "polygons", [&](const JsonValue& polygon) { read_polygon(polygon, data); });
    }
  }

  const Source& source_;
};

}  // namespace

std::vector<NamedShape> read_geojson(const Source& source, const JsonValue& root) {
  return GeoJsonReader(source).read(root);
}

}  // namespace dymsum::io
