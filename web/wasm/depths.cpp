// Penetration depths.
#include "arrays.h"
#include "dymsum/penetration_depth.h"
#include "options.h"
#include "plain.h"

namespace dymsum::web {
namespace {

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

EMSCRIPTEN_BINDINGS(depths) {
  handle<PlanarDepth>("PlanarDepth")
      .class_function("create", guarded<&planar_depth>)
      .function("at", guarded<&planar_at>);
  handle<SolidDepth>("SolidDepth")
      .class_function("create", guarded<&solid_depth>)
      .function("at", guarded<&solid_at>)
      .property("facetCount", &facet_count);
}

}  // namespace
}  // namespace dymsum::web
