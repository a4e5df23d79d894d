// Regions as text in every format but SVG, which is drawn, and GeoPackage, which is no text.
#include <cstddef>
#include <string>
#include <string_view>

#include "dymsum/region_io.h"
#include "io/region/dxf_groups.h"
#include "io/region/gpkg.h"
#include "io/region/read_shapes.h"
#include "io/region/sum_json.h"
#include "io/source.h"

namespace dymsum {

// Regions as text in every format but SVG.

namespace io {
namespace {

/// Ends a comma-separated item; nothing in front of the first.
void comma(std::string& out, bool& first) {
  if (!first) out += ',';
  first = false;
}

void append_chain(std::string& out, const std::vector<Point>& vertices, std::string_view kind) {
  out += std::to_string(vertices.size());
  out += ' ';
  out += kind;
  out += '\n';
  for (const Point p : vertices) {
    append_number(out, p.x);
    out += ' ';
    append_number(out, p.y);
    out += '\n';
  }
  for (std::size_t i = 1; i <= vertices.size(); ++i) {
    out += std::to_string(i);
    out += i < vertices.size() ? ' ' : '\n';
  }
}

/// How a format brackets coordinates.
struct Style {
  std::string_view open, close;              ///< around a list
  std::string_view open_point, close_point;  ///< around a point
  std::string_view between;                  ///< x and y
  bool closed;                               ///< rings repeat their first vertex
};
constexpr Style kWkt = {"(", ")", "", "", " ", true};
constexpr Style kGeoJson = {"[", "]", "[", "]", ",", true};
constexpr Style kNesting = {"[", "]", "[", "]", ",", false};

void append_point(std::string& out, Point p, const Style& style) {
  out += style.open_point;
  append_number(out, p.x);
  out += style.between;
  append_number(out, p.y);
  out += style.close_point;
}

void append_points(std::string& out, const std::vector<Point>& points, const Style& style, bool ring = false) {
  out += style.open;
  bool first = true;
  for (const Point p : points) {
    comma(out, first);
    append_point(out, p, style);
  }
  if (ring && style.closed && !points.empty()) {
    comma(out, first);
    append_point(out, points.front(), style);
  }
  out += style.close;
}

void append_polygon(std::string& out, const Part& part, const Style& style) {
  out += style.open;
  append_points(out, part.outer, style, true);
  for (const Ring& hole : part.holes) {
    out += ',';
    append_points(out, hole, style, true);
  }
  out += style.close;
}

template <class List, class Append>
void append_list(std::string& out, const List& list, const Style& style, Append append) {
  out += style.open;
  bool first = true;
  for (const auto& item : list) {
    comma(out, first);
    append(item);
  }
  out += style.close;
}

/// Parts, polylines and points as one geometry each, in the format's own words; `emit(name, write_coordinates)`.
template <class Emit>
void each_geometry(std::string& out, const RegionData& data, const Style& style, Emit emit) {
  if (data.parts.size() == 1) {
    emit("Polygon", [&] { append_polygon(out, data.parts[0], style); });
  } else if (!data.parts.empty()) {
    emit("MultiPolygon",
         [&] { append_list(out, data.parts, style, [&](const Part& part) { append_polygon(out, part, style); }); });
  }
  if (data.polylines.size() == 1) {
    emit("LineString", [&] { append_points(out, data.polylines[0], style); });
  } else if (!data.polylines.empty()) {
    emit("MultiLineString", [&] {
      append_list(out, data.polylines, style, [&](const Polyline& line) { append_points(out, line, style); });
    });
  }
  if (!data.points.empty()) emit("MultiPoint", [&] { append_points(out, data.points, style); });
}

int geometry_count(const RegionData& data) {
  return (data.parts.empty() ? 0 : 1) + (data.polylines.empty() ? 0 : 1) + (data.points.empty() ? 0 : 1);
}

void append_outer_and_inner(std::string& out, const Part& part) {
  out += "{\"outer\":";
  append_points(out, part.outer, kNesting, true);
  out += ",\"inner\":";
  append_list(out, part.holes, kNesting, [&](const Ring& hole) { append_points(out, hole, kNesting, true); });
  out += '}';
}

}  // namespace

void append_shape(std::string& out, const RegionData& data) {
  const auto append_parts = [&] {
    append_list(out, data.parts, kNesting, [&](const Part& part) { append_outer_and_inner(out, part); });
  };
  if (!data.polylines.empty() || !data.points.empty()) {
    out += R"({"type":"region","data":{"parts":)";
    append_parts();
    out += ",\"polylines\":";
    append_list(out, data.polylines, kNesting, [&](const Polyline& line) { append_points(out, line, kNesting); });
    out += ",\"points\":";
    append_points(out, data.points, kNesting);
    out += '}';
  } else if (data.parts.size() != 1) {
    out += R"({"type":"multi_polygon","data":)";
    append_parts();
  } else if (!data.parts[0].holes.empty()) {
    out += R"({"type":"polygon","data":)";
    append_outer_and_inner(out, data.parts[0]);
  } else {
    out += R"({"type":"simple_polygon","data":)";
    append_points(out, data.parts[0].outer, kNesting, true);
  }
  out += '}';
}

namespace {}  // namespace

std::string write_poly(const RegionData& data) {
  std::size_t chains = data.parts.size() + data.polylines.size() + (data.points.empty() ? 0 : 1);
  for (const Part& part : data.parts) chains += part.holes.size();
  std::string out = std::to_string(chains) + "\n";
  for (const Part& part : data.parts) {
    append_chain(out, part.outer, "out");
    for (const Ring& hole : part.holes) append_chain(out, hole, "in");
  }
  for (const Polyline& line : data.polylines) append_chain(out, line, "open");
  if (!data.points.empty()) append_chain(out, data.points, "points");
  return out;
}

std::string write_wkt(const RegionData& data) {
  const int count = geometry_count(data);
  if (count == 0) return "GEOMETRYCOLLECTION EMPTY\n";
  std::string out;
  bool first = true;
  if (count > 1) out += "GEOMETRYCOLLECTION (";
  each_geometry(out, data, kWkt, [&](std::string_view name, auto write) {
    comma(out, first);
    for (const char c : name) out += upper(c);
    out += ' ';
    write();
  });
  if (count > 1) out += ')';
  return out + "\n";
}

std::string geojson_geometry(const RegionData& data) {
  const bool several = geometry_count(data) != 1;
  std::string out;
  bool first = true;
  if (several) out += R"({"type":"GeometryCollection","geometries":[)";
  each_geometry(out, data, kGeoJson, [&](std::string_view name, auto write) {
    comma(out, first);
    out += "{\"type\":\"";
    out += name;
    out += "\",\"coordinates\":";
    write();
    out += '}';
  });
  if (several) out += "]}";
  return out;
}

std::string write_geojson(const RegionData& data) { return geojson_geometry(data) + "\n"; }

std::string write_nesting(const RegionData& data) {
  std::string out = R"({"name":"dymsum","items":[{"id":0,"demand":1,"allowed_orientations":[0.0],"shape":)";
  append_shape(out, data);
  return out + "}]}\n";
}

std::string format_region_data(const RegionData& data, RegionFormat format) {
  switch (format) {
    case RegionFormat::poly:
      return write_poly(data);
    case RegionFormat::wkt:
      return write_wkt(data);
    case RegionFormat::geojson:
      return write_geojson(data);
    case RegionFormat::svg:
      return write_svg(data);
    case RegionFormat::dxf:
      return write_dxf(data);
    case RegionFormat::gpkg:
      return write_gpkg(data);
    case RegionFormat::json:
      break;
  }
  return write_nesting(data);
}

}  // namespace io

std::string format_region(const Region& region, RegionFormat format) {
  return io::format_region_data(region.data(), format);
}

// A rounded sum with its tight features, as text.

namespace {

std::string feature(const std::string& name, const std::string& properties, const RegionData& data) {
  return R"({"type":"Feature","id":")" + name + R"(","properties":{)" + properties + R"(},"geometry":)" +
         io::geojson_geometry(data) + "}";
}

}  // namespace

std::string format_sum(const PlanarSum& sum, const Region& rounded, RegionFormat format) {
  if (sum.tight_segments.empty() && sum.tight_points.empty()) return format_region(rounded, format);
  if (format == RegionFormat::geojson)
    return R"({"type":"FeatureCollection","features":[)" + feature("sum", R"("tight":false)", rounded.data()) + ",\n" +
           feature("tight", R"("tight":true)", io::tight_data(sum)) + "]}\n";
  const RegionData all = io::with_tight(rounded.data(), io::tight_data(sum));
  const std::size_t polylines = rounded.polylines().size(), points = rounded.points().size();
  std::string text = io::format_region_data(all, format);
  if (format != RegionFormat::poly) return text;
  return "# tight features: the last " + std::to_string(all.polylines.size() - polylines) + " polylines and " +
         std::to_string(all.points.size() - points) + " points\n" + text;
}

}  // namespace dymsum

namespace dymsum::io {

// Regions as DXF text, of AutoCAD 2000 and later: every ring and polyline an LWPOLYLINE, every point a POINT.

namespace {

class DxfWriter {
 public:
  std::string write(const RegionData& data) {
    group(999, kDxfOwn);
    begin_section("HEADER");
    group(9, "$ACADVER");
    group(1, "AC1015");
    group(0, "ENDSEC");
    begin_section("ENTITIES");
    for (const Part& part : data.parts) {
      chain(part.outer, kDxfOuter, true);
      for (const Ring& hole : part.holes) chain(hole, kDxfHole, true);
    }
    for (const Polyline& line : data.polylines) chain(line, kDxfLine, false);
    for (const Point p : data.points) {
      begin_entity("POINT", "AcDbPoint", kDxfPoint);
      position(p);
      number(30, 0);
    }
    group(0, "ENDSEC");
    group(0, "EOF");
    return std::move(out_);
  }

 private:
  void group(int code, std::string_view value) {
    out_ += std::to_string(code);
    out_ += '\n';
    out_ += value;
    out_ += '\n';
  }
  void number(int code, double value) {
    std::string text;
    append_number(text, value);
    group(code, text);
  }
  void position(Point p) {
    number(10, p.x);
    number(20, p.y);
  }
  void begin_section(std::string_view name) {
    group(0, "SECTION");
    group(2, name);
  }
  // Every entity has a handle of its own.
  void begin_entity(std::string_view kind, std::string_view type, std::string_view layer) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string handle;
    for (std::size_t n = ++entities_ + 0xff; n > 0; n /= 16) handle.insert(handle.begin(), kDigits[n % 16]);
    group(0, kind);
    group(5, handle);
    group(100, "AcDbEntity");
    group(8, layer);
    group(100, type);
  }
  void chain(const std::vector<Point>& points, std::string_view layer, bool closed) {
    begin_entity("LWPOLYLINE", "AcDbPolyline", layer);
    group(90, std::to_string(points.size()));
    group(70, closed ? "1" : "0");
    for (const Point p : points) position(p);
  }

  std::string out_;
  std::size_t entities_ = 0;
};

}  // namespace

std::string write_dxf(const RegionData& data) { return DxfWriter().write(data); }

}  // namespace dymsum::io
