#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "io/region/json_shapes.h"
#include "io/region/ring_order.h"

namespace dymsum::io {

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
