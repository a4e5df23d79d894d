#include "cspace/kinds.h"

#include <algorithm>
#include <numbers>

#include "cspace/measure.h"
#include "cspace/rotation.h"
#include "dymsum/shapes.h"
#include "off_grid.h"
#include "thesis/thesis_shapes.h"

namespace dymsum::bench {
namespace {

/// So many slices at equally spaced orientations, from scratch.
double slices_ms(const Region& robot, const Region& obstacle, int measured) {
  const double start = cpu_ms();
  for (int k = 0; k < measured; ++k)
    cspace_slice(robot, obstacle, Orientation::nearest(2 * std::numbers::pi * k / measured, 1e-6).value()).value();
  return cpu_ms() - start;
}

OffGridCase obstacle_case(const std::string& name, const Region& robot, const Region& obstacle) {
  return off_grid_case(name, robot, obstacle, [](const Region& r, const Region& o) {
    OffGridWork work;
    work.run = [=] { return CspaceObstacle::create(r, o).value().patches().size(); };
    work.compare = [=] {
      constexpr std::size_t kSlabs = 20;
      constexpr int kSlices = 360, kMeasured = 36;
      ObstacleRow row;
      compare_slabs(CspaceObstacle::create(r, o).value(), kSlabs, 1, row);
      const bool wrong = row.slabs_different > 0;
      return Compared{wrong ? std::to_string(row.slabs_different) + " DIFFERENT" : "equal", wrong,
                      slices_ms(r, o, kMeasured) * kSlices / kMeasured};
    };
    return work;
  });
}

const Region& shape_of(const std::vector<shapes::Named>& set, std::string_view name) {
  return std::find_if(set.begin(), set.end(), [&](const shapes::Named& n) { return n.name == name; })->region;
}

}  // namespace

bool measure_kinds(const std::string& folder) {
  const std::vector<shapes::Named> set = shapes::thesis_like_set();
  const Region comb = shapes::comb(12, 2, 1, 3), small_comb = shapes::comb(5, 2, 1, 3), octagon = shapes::disc(8, 1),
               small_gear = shapes::gear(6, 0.5, 1, shapes::demo_snap(1)),
               gear = shapes::gear(13, 2, 3, shapes::demo_snap(3)), bar = shape_of(set, "bar");
  return off_grid_table(
      {"cspace",
       "The obstacle of a robot at all its orientations. In the combs the teeth are exactly as wide as the gaps; with "
       "the octagon itself events coincide.",
       "patch", "360 slices",
       "360 slices: by our static engine (36 measured). Compared: up to 20 random slabs with slices inside them."},
      {obstacle_case("bar, sewing", bar, shape_of(set, "sewing")), obstacle_case("bar, G4", bar, shape_of(set, "G4")),
       obstacle_case("star, hand1", shape_of(set, "star"), shape_of(set, "hand1")),
       obstacle_case("comb 5, comb 12", small_comb, comb), obstacle_case("octagon, octagon", octagon, octagon),
       obstacle_case("gear 6, gear 13", small_gear, gear)},
      folder);
}

}  // namespace dymsum::bench
