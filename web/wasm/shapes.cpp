// Generators of regions and solids, and what concerns the module as a whole.
#include "dymsum/shapes.h"

#include <emscripten/heap.h>

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "arrays.h"
#include "dymsum/solids.h"
#include "dymsum/version.h"

namespace dymsum::web {
namespace {

using emscripten::function;

/// A number as a generator takes it: counts are integers, which embind would wrap where they are too large.
template <class T>
T number_in(double number) {
  if constexpr (std::is_floating_point_v<T>) {
    return number;
  } else {
    if (!(std::abs(number) <= 0x1p28 && number == std::floor(number)))
      throw std::invalid_argument("a count is an integer of at most 2^28");
    return static_cast<T>(number);
  }
}

template <class>
using AsDouble = double;

/// `make` of numbers, as a handle.
template <auto make>
struct Made;
template <class R, class... A, R (*make)(A...)>
struct Made<make> {
  static std::shared_ptr<R> call(AsDouble<A>... numbers) { return shared(make(number_in<A>(numbers)...)); }
};
template <auto make>
constexpr auto made = guarded<&Made<make>::call>;

std::shared_ptr<Region> noisy_star(double vertices, double noise, double seed) {
  return shared(shapes::noisy_star(number_in<int>(vertices), noise, static_cast<std::uint64_t>(seed)));
}
std::shared_ptr<Region> random_polygon(double vertices, double holes, double seed) {
  return shared(
      shapes::random_polygon(number_in<int>(vertices), number_in<int>(holes), static_cast<std::uint64_t>(seed)));
}
std::shared_ptr<Mesh> prism(const val& base, double height, double snap) {
  return shared(solids::prism(points_in(base), height, snap));
}

double memory_bytes() { return static_cast<double>(emscripten_get_heap_size()); }
std::string version() { return DYMSUM_VERSION; }

EMSCRIPTEN_BINDINGS(shapes) {
  function("rectangle", made<&shapes::rectangle>);
  function("disc", made<&shapes::disc>);
  function("gear", made<&shapes::gear>);
  function("grate", made<&shapes::grate>);
  function("comb", made<&shapes::comb>);
  function("star", made<&shapes::star>);
  function("noisyStar", guarded<&noisy_star>);
  function("spiral", made<&shapes::spiral>);
  function("letterU", made<&shapes::letter_u>);
  function("letterL", made<&shapes::letter_l>);
  function("pockets", made<&shapes::pockets>);
  function("randomPolygon", guarded<&random_polygon>);
  function("box", made<&solids::box>);
  function("prism", guarded<&prism>);
  function("tessellatedCube", made<&solids::tessellated_cube>);
  function("cone", made<&solids::cone>);
  function("cylinder", made<&solids::cylinder>);
  function("dipyramid", made<&solids::dipyramid>);
  function("pyramid", made<&solids::pyramid>);
  function("geodesicSphere", made<&solids::geodesic_sphere>);
  function("ellipsoid", made<&solids::ellipsoid>);
  function("triakisIcosahedron", made<&solids::triakis_icosahedron>);
  function("truncatedIcosidodecahedron", made<&solids::truncated_icosidodecahedron>);
  function("rod", made<&solids::rod>);
  function("memoryBytes", &memory_bytes);
  function("version", &version);
}

}  // namespace
}  // namespace dymsum::web
