// GrowingDisc and sets with arcs.
#include "dymsum/growing_disc.h"

#include "arrays.h"
#include "options.h"
#include "plain.h"

namespace dymsum::web {
namespace {

DiscRadius radius_in(const val& v) {
  if (v.typeOf().as<std::string>() == "object") return DiscRadius::at_event(index_in(v["event"].as<double>()));
  return {rational_in(v)};
}

val piece_data(const DiscPiece& piece) {
  val v = val::object();
  v.set("of", plain(piece.of));
  v.set("index", piece.index);
  v.set("x", piece.from.at.x);
  v.set("y", piece.from.at.y);
  v.set("corner", plain(piece.from.kind));
  v.set("arc", val::null());
  if (piece.of == DiscPiece::Of::edge) return v;
  val arc = val::object();
  arc.set("cx", piece.centre.x);
  arc.set("cy", piece.centre.y);
  arc.set("fromAngle", piece.from_angle);
  arc.set("sweep", piece.sweep);
  v.set("arc", arc);
  return v;
}

val ring_data(const DiscRing& ring) { return list_of(ring.pieces, piece_data); }

val segments_array(const std::vector<DiscSegment>& segments) {
  std::vector<double> numbers;
  for (const DiscSegment& segment : segments) {
    add(numbers, segment.from.at);
    add(numbers, segment.to.at);
  }
  return array_of(numbers);
}
val corners_array(const std::vector<DiscCorner>& corners) {
  std::vector<double> numbers;
  for (const DiscCorner& corner : corners) add(numbers, corner.at);
  return array_of(numbers);
}

val shape_of(const DiscSet& set) {
  val v = val::object();
  v.set("parts", list_of(set.parts, [](const DiscPart& part) {
          val one = val::object();
          one.set("outer", ring_data(part.outer));
          one.set("holes", list_of(part.holes, ring_data));
          return one;
        }));
  v.set("segments", segments_array(set.segments));
  v.set("points", corners_array(set.points));
  v.set("tightSegments", segments_array(set.tight_segments));
  v.set("tightPoints", corners_array(set.tight_points));
  v.set("radius", set.radius);
  v.set("radiusExact", set.radius_exact);
  v.set("atError", set.at_error);
  return v;
}

val area_of(const DiscSet& set) { return plain(area(set)); }
val perimeter_of(const DiscSet& set) { return plain(perimeter(set)); }
val bounds_of(const DiscSet& set) { return plain(bounds(set)); }
val polygons(const DiscSet& set, double error, const val& bound) {
  DiscPolygons made = got(to_region(set, error, enumerator(bound, DiscBound::inside)));
  val v = val::object();
  v.set("error", made.error);
  v.set("chords", static_cast<double>(made.chords));
  v.set("collapsed", static_cast<double>(made.collapsed));
  v.set("region", shared(std::move(made.region)));
  return v;
}
std::string svg_of(const DiscSet& set, const Region& over) { return draw_disc_set(over, set); }
std::string json_of(const DiscSet& set) { return disc_set_to_json(set); }

std::shared_ptr<GrowingDisc> created(const Region& region) { return std::make_shared<GrowingDisc>(region); }
val events_of(const GrowingDisc& disc, const val& side, const val& progress) {
  return plain(got(disc.events(enumerator(side, DiscSide::outside), progress_in(progress))));
}
using At = Result<DiscSet> (GrowingDisc::*)(const DiscRadius&, Semantics, const Progress&) const;
template <At at>
std::shared_ptr<DiscSet> set_at(const GrowingDisc& disc, const val& radius, const val& semantics) {
  return shared(got((disc.*at)(radius_in(radius), semantics_in(semantics), {})));
}

EMSCRIPTEN_BINDINGS(growing_disc) {
  handle<DiscSet>("DiscSet")
      .function("shape", guarded<&shape_of>)
      .function("area", guarded<&area_of>)
      .function("perimeter", guarded<&perimeter_of>)
      .function("bounds", guarded<&bounds_of>)
      .function("toRegion", guarded<&polygons>)
      .function("svg", guarded<&svg_of>)
      .function("toJson", guarded<&json_of>);
  handle<GrowingDisc>("GrowingDisc")
      .class_function("create", guarded<&created>)
      .function("events", guarded<&events_of>)
      .function("sumAt", guarded<&set_at<&GrowingDisc::sum_at>>)
      .function("erodedAt", guarded<&set_at<&GrowingDisc::eroded_at>>)
      .function("openedAt", guarded<&set_at<&GrowingDisc::opened_at>>)
      .function("closedAt", guarded<&set_at<&GrowingDisc::closed_at>>);
}

}  // namespace
}  // namespace dymsum::web
