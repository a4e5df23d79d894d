// Region, and files of regions.
#include <algorithm>
#include <array>

#include "arrays.h"
#include "dymsum/area_text.h"
#include "dymsum/region_io.h"
#include "file.h"
#include "options.h"
#include "plain.h"
#include "region.h"

namespace dymsum::web {
namespace {

using emscripten::function;
using SharedRegion = std::shared_ptr<Region>;

RegionData data_in(const val& v) {
  RegionData data;
  const val parts = v["parts"], polylines = v["polylines"], points = v["points"];
  const auto each = [](const val& list, auto take) {
    const unsigned n = is_none(list) ? 0 : list["length"].as<unsigned>();
    for (unsigned k = 0; k < n; ++k) take(list[k]);
  };
  each(parts, [&](const val& part) {
    Part& made = data.parts.emplace_back();
    made.outer = points_in(part["outer"]);
    each(part["holes"], [&](const val& hole) { made.holes.push_back(points_in(hole)); });
  });
  each(polylines, [&](const val& line) { data.polylines.push_back(points_in(line)); });
  if (!is_none(points)) data.points = points_in(points);
  return data;
}

/// The region as it is, if valid, or repaired.
Region region_of(RegionData data, bool with_repair) {
  return with_repair ? got(repair(std::move(data))).region : got(Region::create(std::move(data)));
}

ReadOptions reading_in(const val& options) {
  return {enumerator(member(options, "thirdCoordinates"), ThirdCoordinates::refused), {}};
}

SharedRegion read(const std::string& name, const std::string& bytes, const val& options) {
  const ReadOptions reading = reading_in(options);
  const FileInMemory file(name, bytes);
  return in_file(name, [&] {
    return shared(region_of(got(read_region_data(file.path(), reading)), member_or(options, "repair", false)));
  });
}

std::vector<NamedShape> shapes_in(const std::string& name, const std::string& bytes, const val& options) {
  const ReadOptions reading = reading_in(options);
  const FileInMemory file(name, bytes);
  return got(read_shapes(file.path(), reading));
}

val named(const std::string& name, const char* field, const val& value) {
  val v = val::object();
  v.set("name", name);
  v.set(field, value);
  return v;
}

val read_all(const std::string& name, const std::string& bytes, const val& options) {
  const bool with_repair = member_or(options, "repair", false);
  const std::vector<NamedShape> shapes = shapes_in(name, bytes, options);
  return list_of(shapes, [&](const NamedShape& shape) {
    const std::string own = shape.name.empty() ? std::to_string(&shape - shapes.data()) : shape.name;
    const std::string which = shapes.size() > 1 ? name + "#" + own : name;
    return named(shape.name, "region", in_file(which, [&] { return val(shared(region_of(shape.data, with_repair))); }));
  });
}

val read_data(const std::string& name, const std::string& bytes, const val& options) {
  return list_of(shapes_in(name, bytes, options),
                 [&](const NamedShape& shape) { return named(shape.name, "shape", region_shape(shape.data)); });
}

SharedRegion from_data(const val& data) { return shared(got(Region::create(data_in(data)))); }

/// A list of points that may end where it began.
Ring ring_in(const val& points) {
  Ring ring = points_in(points);
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

SharedRegion from_rings(const val& rings) {
  RegionData data;
  Part& part = data.parts.emplace_back();
  const auto n = rings["length"].as<unsigned>();
  for (unsigned k = 0; k < n; ++k) (k == 0 ? part.outer : part.holes.emplace_back()) = ring_in(rings[k]);
  return shared(got(Region::create(std::move(data))));
}

val repaired(const val& data) {
  Repaired made = got(repair(data_in(data)));
  val v = val::object();
  v.set("changed", made.report.changed());
  v.set("report", made.report.to_string());
  v.set("region", shared(std::move(made.region)));
  return v;
}

SharedRegion nothing() { return shared(Region()); }

/// The vertex of an index through the whole region; null beyond.
Point* vertex_of(RegionData& data, std::size_t index) {
  const auto in = [&](std::vector<Point>& points) -> Point* {
    if (index < points.size()) return &points[index];
    index -= points.size();
    return nullptr;
  };
  for (Part& part : data.parts) {
    if (Point* at = in(part.outer)) return at;
    for (Ring& hole : part.holes)
      if (Point* at = in(hole)) return at;
  }
  for (Polyline& line : data.polylines)
    if (Point* at = in(line)) return at;
  return in(data.points);
}

SharedRegion with_vertex(const Region& region, double index, double x, double y) {
  RegionData data = region.data();
  Point* const at = index >= 0 && index < static_cast<double>(region.vertex_count())
                        ? vertex_of(data, static_cast<std::size_t>(index))
                        : nullptr;
  if (at == nullptr) throw Thrown{{ErrorCode::bad_index, "the region has no such vertex", {}}};
  *at = {x, y};
  return shared(got(Region::create(std::move(data))));
}

val shape_of(const Region& region) { return region_shape(region.data()); }
double area_of(const Region& region) { return area(region); }
std::string area_text_of(const Region& region) { return area_text(region); }
val bounds_of(const Region& region) { return plain(bounds(region)); }
double gyration_of(const Region& region) { return radius_of_gyration(region); }
SharedRegion negated_of(const Region& region) { return shared(negated(region)); }
SharedRegion translated_of(const Region& region, double dx, double dy) {
  return shared(got(translated(region, dx, dy)));
}
SharedRegion scaled_of(const Region& region, double sx, double sy) { return shared(got(scaled(region, sx, sy))); }
SharedRegion canonical_of(const Region& region) { return shared(region.canonical()); }
bool equal(const Region& a, const Region& b) { return a == b; }
std::string formatted(const Region& region, const std::string& format) {
  return format_region(region, region_format_in(format));
}
std::string drawn(const Region& region) { return draw_region(region); }

double vertex_count(const Region& region) { return static_cast<double>(region.vertex_count()); }
double hole_count(const Region& region) { return static_cast<double>(region.hole_count()); }

EMSCRIPTEN_BINDINGS(region) {
  handle<Region>("Region")
      .property("empty", &Region::empty)
      .property("vertexCount", &vertex_count)
      .property("holeCount", &hole_count)
      .function("shape", guarded<&shape_of>)
      .function("area", guarded<&area_of>)
      .function("areaText", guarded<&area_text_of>)
      .function("bounds", guarded<&bounds_of>)
      .function("radiusOfGyration", guarded<&gyration_of>)
      .function("negated", guarded<&negated_of>)
      .function("translated", guarded<&translated_of>)
      .function("scaled", guarded<&scaled_of>)
      .function("withVertex", guarded<&with_vertex>)
      .function("canonical", guarded<&canonical_of>)
      .function("equals", guarded<&equal>)
      .function("format", guarded<&formatted>)
      .class_function("read", guarded<&read>)
      .class_function("readAll", guarded<&read_all>)
      .class_function("readData", guarded<&read_data>)
      .class_function("fromData", guarded<&from_data>)
      .class_function("fromRings", guarded<&from_rings>)
      .class_function("repair", guarded<&repaired>)
      .class_function("empty", guarded<&nothing>);
  function("drawRegion", guarded<&drawn>);
}

}  // namespace

val region_shape(const RegionData& data) {
  std::vector<double> vertices;
  std::vector<std::uint32_t> rings{0}, parts{0}, lines;
  const auto take = [&](const std::vector<Point>& points, std::vector<std::uint32_t>& ends) {
    for (const Point at : points) add(vertices, at);
    ends.push_back(static_cast<std::uint32_t>(vertices.size() / 2));
  };
  for (const Part& part : data.parts) {
    take(part.outer, rings);
    for (const Ring& hole : part.holes) take(hole, rings);
    parts.push_back(static_cast<std::uint32_t>(rings.size() - 1));
  }
  lines.push_back(rings.back());
  for (const Polyline& line : data.polylines) take(line, lines);
  for (const Point at : data.points) add(vertices, at);
  val shape = val::object();
  shape.set("vertices", array_of(vertices));
  shape.set("ringStarts", array_of(rings));
  shape.set("partStarts", array_of(parts));
  shape.set("polylineStarts", array_of(lines));
  shape.set("firstPoint", lines.back());
  return shape;
}

RegionFormat region_format_in(const std::string& text) {
  static_assert(name(RegionFormat::gpkg) == names_of<RegionFormat>().back());  // a database, which needs SQLite
  return enumerator(val(text), RegionFormat::wkt, std::span(names_of<RegionFormat>()).first<6>());
}

}  // namespace dymsum::web
