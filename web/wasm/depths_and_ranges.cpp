// Penetration depths, and scales at which a part fits.
#include "arrays.h"
#include "dymsum/penetration_depth.h"
#include "dymsum/scale_range.h"
#include "dymsum/solid_scale_range.h"
#include "options.h"
#include "planar_shape.h"
#include "solid_feature.h"

namespace dymsum::web {
namespace {

using emscripten::function;

std::string meeting_name(Meeting meeting) {
  return meeting == Meeting::overlapping ? "overlapping" : meeting == Meeting::touching ? "touching" : "apart";
}

template <class Distance>
val distance_data(const Distance& distance) {
  val v = val::object();
  v.set("meeting", meeting_name(distance.meeting));
  v.set("squared", distance.squared.to_string());
  v.set("distance", distance.distance);
  return v;
}

Point approx(const RationalPoint& at) { return {at.x.to_double(), at.y.to_double()}; }
Point3 approx(const RationalPoint3& at) { return {at.x.to_double(), at.y.to_double(), at.z.to_double()}; }

template <class Way, class Contacts>
val way_data(const Way& way, Contacts contact_data) {
  val v = val::object();
  v.set("move", exact_point(way.move));
  v.set("approx", point(approx(way.move)));
  v.set("direction", point(way.direction));
  v.set("contacts", list_of(way.contacts, contact_data));
  return v;
}

val feature_data(const SolidFeature& feature) { return solid_feature(feature); }
val feature_data(const PlanarFeature& feature) {
  val v = val::object();
  v.set("kind", std::string(feature.kind == PlanarFeature::Kind::vertex ? "vertex" : "edge"));
  v.set("index", feature.index);
  return v;
}

template <class Touch>
val touch_data(const Touch& touch) {
  val v = val::object();
  v.set("p", feature_data(touch.p));
  v.set("q", feature_data(touch.q));
  v.set("dimension", touch.dimension);
  v.set("at", exact_point(touch.at));
  v.set("approx", point(approx(touch.at)));
  v.set("patch", touch.patch);
  return v;
}

std::shared_ptr<PlanarDepth> planar_depth(const Region& p, const Region& q) {
  return shared(got(PlanarDepth::create(p, q)));
}
val planar_at(const PlanarDepth& depth, const val& x, const val& y) {
  const PlanarDistance distance = depth.at({is_none(x) ? 0 : x.as<double>(), is_none(y) ? 0 : y.as<double>()});
  val v = distance_data(distance);
  v.set("ways", list_of(distance.ways, [](const PlanarWay& way) { return way_data(way, touch_data<PlanarTouch>); }));
  return v;
}

std::shared_ptr<SolidDepth> solid_depth(const Mesh& p, const Mesh& q, const val& options) {
  DepthOptions how;
  how.threads = 1;
  how.progress = progress_in(member(options, "progress"));
  if (const val contacts = member(options, "contacts"); !is_none(contacts)) how.contacts = contacts.as<bool>();
  return shared(got(SolidDepth::create(p, q, how)));
}
val solid_at(SolidDepth& depth, const val& x, const val& y, const val& z, const val& limit) {
  const auto number = [](const val& v) { return is_none(v) ? 0 : v.as<double>(); };
  const SolidDistance distance = depth.at({number(x), number(y), number(z)}, number(limit));
  val v = distance_data(distance);
  v.set("ways", list_of(distance.ways, [](const SolidWay& way) { return way_data(way, touch_data<SolidTouch>); }));
  v.set("complete", distance.complete);
  v.set("atLeast", distance.at_least);
  return v;
}
double facet_count(const SolidDepth& depth) { return static_cast<double>(depth.facet_count()); }

std::string kind_name(ScaleContact::Kind kind) {
  switch (kind) {
    case ScaleContact::Kind::vertex_on_edge:
      return "vertex_on_edge";
    case ScaleContact::Kind::edge_on_vertex:
      return "edge_on_vertex";
    case ScaleContact::Kind::vertex_on_vertex:
      return "vertex_on_vertex";
  }
  throw std::logic_error("a contact of no kind");
}

val contact_data(const ScaleContact& contact) {
  val v = val::object();
  v.set("kind", kind_name(contact.kind));
  v.set("part", contact.part);
  v.set("obstacle", contact.obstacle);
  v.set("leg", contact.leg);
  v.set("along", contact.along.to_string());
  v.set("at", exact_point(contact.at));
  return v;
}

val text_or_null(const std::optional<Rational>& number) { return number ? val(number->to_string()) : val::null(); }

val contact_data(const SolidScaleContact& contact) {
  val v = val::object();
  v.set("part", solid_feature(contact.part));
  v.set("obstacle", solid_feature(contact.obstacle));
  v.set("leg", contact.leg);
  v.set("along", contact.along.to_string());
  v.set("at", exact_point(contact.at));
  return v;
}

template <class Range>
val range_data(const Range& range) {
  val v = val::object();
  v.set("free", list_of(range.free, [](const auto& interval) {
          val one = val::object();
          one.set("low", text_or_null(interval.low));
          one.set("high", text_or_null(interval.high));
          const auto data = [](const auto& contact) { return contact_data(contact); };
          one.set("atLow", list_of(interval.at_low, data));
          one.set("atHigh", list_of(interval.at_high, data));
          return one;
        }));
  v.set("trap", text_or_null(range.trap()));
  v.set("critical", static_cast<double>(range.critical));
  v.set("tested", static_cast<double>(range.tested));
  return v;
}

val scales_along(const Region& part, const val& path, const Region& obstacles, const val& progress) {
  return range_data(got(scale_range(part, points_in(path), obstacles, progress_in(progress))));
}
val scales_that_fit(const Region& part, const Region& container, const val& at, const val& progress) {
  return range_data(got(is_none(at) ? fit_range(part, container, progress_in(progress))
                                    : fit_range(part, container, point_in(at), progress_in(progress))));
}

std::vector<Point3> positions_in(const val& coordinates) {
  const std::vector<double> numbers = numbers_in(coordinates);
  if (numbers.size() % 3 != 0) throw Thrown{{ErrorCode::malformed, "a place in space has three coordinates", {}}};
  std::vector<Point3> positions;
  for (std::size_t k = 0; k < numbers.size(); k += 3) positions.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
  return positions;
}
val solid_scales_along(const Mesh& part, const val& path, const Mesh& obstacles, const val& progress) {
  return range_data(got(solid_scale_range(part, positions_in(path), obstacles, progress_in(progress))));
}
val solid_scales_that_fit(const Mesh& part, const Mesh& container, const val& at, const val& progress) {
  return range_data(got(is_none(at) ? solid_fit_range(part, container, progress_in(progress))
                                    : solid_fit_range(part, container, point3_in(at), progress_in(progress))));
}

EMSCRIPTEN_BINDINGS(depths_and_ranges) {
  handle<PlanarDepth>("PlanarDepth")
      .class_function("create", guarded<&planar_depth>)
      .function("at", guarded<&planar_at>);
  handle<SolidDepth>("SolidDepth")
      .class_function("create", guarded<&solid_depth>)
      .function("at", guarded<&solid_at>)
      .property("facetCount", &facet_count);
  function("scaleRange", guarded<&scales_along>);
  function("fitRange", guarded<&scales_that_fit>);
  function("scaleRangeOfMeshes", guarded<&solid_scales_along>);
  function("fitRangeOfMeshes", guarded<&solid_scales_that_fit>);
}

}  // namespace
}  // namespace dymsum::web
