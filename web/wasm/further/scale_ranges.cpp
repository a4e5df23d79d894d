// Scales at which a part fits.
#include "dymsum/scale_range.h"

#include "arrays.h"
#include "dymsum/solid_scale_range.h"
#include "options.h"
#include "plain.h"

namespace dymsum::web {

template <class T>
requires std::is_same_v<T, ScaleRange> || std::is_same_v<T, SolidScaleRange>
struct Derived<T> {
  static void add(val& made, const T& range) { made.set("trap", plain(range.trap())); }
};

namespace {

using emscripten::function;

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

EMSCRIPTEN_BINDINGS(scale_ranges) {
  function("scaleRange", guarded<&scales_along>);
  function("fitRange", guarded<&scales_that_fit>);
  function("scaleRangeOfMeshes", guarded<&solid_scales_along>);
  function("fitRangeOfMeshes", guarded<&solid_scales_that_fit>);
}

}  // namespace
}  // namespace dymsum::web
