// What is made of solids besides their sum: inner fits, openings, closings and offsets.
#include "arrays.h"
#include "dymsum/solid_erosion.h"
#include "dymsum/solid_offset.h"
#include "options.h"

namespace dymsum::web {
namespace {

using emscripten::function;

std::shared_ptr<SpatialSum> eroded(const Mesh& a, const Mesh& b, const val& options) {
  return shared(got(erode(a, b, spatial_options(options))));
}

BetweenSteps between_in(const val& options) { return enumerator(member(options, "between"), BetweenSteps::exact); }
val opened_data(SolidOpening made) {
  val v = val::object();
  v.set("solid", shared(std::move(made.solid)));
  v.set("moved", made.moved);
  return v;
}
val opened(const Mesh& a, const Mesh& b, const val& options) {
  return opened_data(got(opening(a, b, spatial_options(options), between_in(options))));
}
val closed(const Mesh& a, const Mesh& b, const val& options) {
  return opened_data(got(closing(a, b, spatial_options(options), between_in(options))));
}

val offset_by(const Mesh& mesh, double distance, double tolerance, const val& options) {
  const OffsetBound bound = enumerator(member(options, "bound"), OffsetBound::inside);
  SolidOffset made = got(offset(mesh, distance, tolerance, bound, spatial_options(options)));
  val v = val::object();
  v.set("solid", shared(std::move(made.solid)));
  v.set("low", made.low);
  v.set("high", made.high);
  v.set("ballFacets", static_cast<double>(made.ball_facets));
  return v;
}

EMSCRIPTEN_BINDINGS(solid_operations) {
  function("erodeMeshes", guarded<&eroded>);
  function("opening", guarded<&opened>);
  function("closing", guarded<&closed>);
  function("offset", guarded<&offset_by>);
}

}  // namespace
}  // namespace dymsum::web
