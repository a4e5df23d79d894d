// Penetration depths, and scales at which a part fits.
#include "arrays.h"
#include "dymsum/penetration_depth.h"
#include "dymsum/scale_range.h"
#include "dymsum/solid_scale_range.h"
#include "options.h"
#include "plain.h"

namespace dymsum::web {
namespace {

using emscripten::function;

Point approx(const RationalPoint& at) { return {at.x.to_double(), at.y.to_double()}; }
Point3 approx(const RationalPoint3& at) { return {at.x.to_double(), at.y.to_double(), at.z.to_double()}; }

}  // namespace

/// Exact positions have doubles beside them.
template <class T>
requires std::is_same_v<T, PlanarTouch> || std::is_same_v<T, SolidTouch>
struct Derived<T> {
  static void add(val& made, const T& touch) { made.set("approx", plain(approx(touch.at))); }
};
template <class T>
requires std::is_same_v<T, PlanarWay> || std::is_same_v<T, SolidWay>
struct Derived<T> {
  static void add(val& made, const T& way) { made.set("approx", plain(approx(way.move))); }
};
template <class T>
requires std::is_same_v<T, ScaleRange> || std::is_same_v<T, SolidScaleRange>
struct Derived<T> {
  static void add(val& made, const T& range) { made.set("trap", plain(range.trap())); }
};

namespace {

std::shared_ptr<PlanarDepth> planar_depth(const Region& p, const Region& q) {
  return shared(got(PlanarDepth::create(p, q)));
}
val planar_at(const PlanarDepth& depth, const val& x, const val& y) {
  return plain(depth.at({is_none(x) ? 0 : x.as<double>(), is_none(y) ? 0 : y.as<double>()}));
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
  return plain(depth.at({number(x), number(y), number(z)}, number(limit)));
}
double facet_count(const SolidDepth& depth) { return static_cast<double>(depth.facet_count()); }

val scales_along(const Region& part, const val& path, const Region& obstacles, const val& progress) {
  return plain(got(scale_range(part, points_in(path), obstacles, progress_in(progress))));
}
val scales_that_fit(const Region& part, const Region& container, const val& at, const val& progress) {
  return plain(got(is_none(at) ? fit_range(part, container, progress_in(progress))
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
  return plain(got(solid_scale_range(part, positions_in(path), obstacles, progress_in(progress))));
}
val solid_scales_that_fit(const Mesh& part, const Mesh& container, const val& at, const val& progress) {
  return plain(got(is_none(at) ? solid_fit_range(part, container, progress_in(progress))
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
