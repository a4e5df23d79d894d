// Events of a sum while an operand turns: structure is constant between them and changes at visible ones.
#include "dymsum/turning_solid_sum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "spatial/moving/moving_cases.h"
#include "spatial/turning/turn_structure.h"

namespace dymsum {
namespace {

using moving_cases::mesh_of;

AxisTurn turn_at(const TurnAxis& axis, double radians) { return AxisTurn::nearest(axis, radians).value(); }

struct Seen {
  std::uint64_t hash = 0;
  spatial::SolidTopology topology;
  friend bool operator==(const Seen&, const Seen&) = default;
};
Seen seen(const TurningSolidSum& sum, const AxisTurn& turn) {
  const Result<SpatialSum> at = sum.at(turn);
  EXPECT_TRUE(at.ok()) << at.error().to_string();
  return {sum.combinatorial_hash(*at), spatial::topology_of(*at)};
}

/// Between two samples with different structures lies a visible event, between neighbours with the same ones none (or
/// two): looked at by samples alone, which know nothing of events. Returns how many events are visible.
std::size_t check_by_samples(const TurningSolidSum& sum, double from, double to, int samples, const std::string& name) {
  const TurnAxis axis = sum.axis();
  const Result<std::vector<SolidTurnEvent>> events = sum.events(turn_at(axis, from), turn_at(axis, to));
  EXPECT_TRUE(events.ok()) << name << ": " << events.error().to_string();
  if (!events) return 0;
  const TurningSolidWork w = sum.work();
  std::size_t visible = 0, next = 0;
  double last = from + 1e-9;
  Seen before = seen(sum, turn_at(axis, last));
  for (int k = 1; k <= samples; ++k) {
    const double angle = from + (to - from) * (k - 0.3456789) / samples;
    const Seen here = seen(sum, turn_at(axis, angle));
    std::size_t between = 0;
    for (; next < events->size() && (*events)[next].radians < angle; ++next)
      between += (*events)[next].radians > last && (*events)[next].visible;
    if (between == 0) {
      EXPECT_TRUE(here == before) << name << ": changed between " << last << " and " << angle;
    } else if (between == 1) {
      EXPECT_FALSE(here == before) << name << ": the same at " << last << " and " << angle;
    }
    visible += between, before = here, last = angle;
  }
  std::cout << name << ", axis " << axis[2] << " at " << from << ": " << visible << " visible; " << w.windows
            << " windows, " << w.facets << " facets, " << w.candidates << " candidates, " << w.roots << " meetings, "
            << w.covered << " covered, " << w.exact_tests << " tested, " << w.events << " events, " << w.sums
            << " sums, " << w.ms << " ms" << std::endl;
  return visible;
}

TEST(TurningSolidSum, StructureIsConstantBetweenEventsAndChangesAtThem) {
  std::size_t visible = 0;
  double at = 0.1234;
  for (const auto& [name, p, q] : moving_cases::small_pairs())
    for (const TurnAxis& axis : {TurnAxis{0, 0, 1}, TurnAxis{1, 2, 3}}) {
      const TurningSolidSum sum = TurningSolidSum::create(p, q, axis).value();
      at = std::remainder(at + 1.1, 2.8);
      visible += check_by_samples(sum, at, at + 0.05, 12, name);
    }
  EXPECT_GT(visible, 100u);
}

TEST(TurningSolidSum, BoxesAboutASharedAxisChangeAtQuarterTurnsAlone) {
  const Mesh cube = mesh_of(box(1));
  const TurningSolidSum sum = TurningSolidSum::create(cube, cube, {0, 0, 2}).value();
  const std::vector<SolidTurnEvent> events = sum.events_of_turn().value();
  for (const SolidTurnEvent& e : events) std::cout << e.radians << " " << e.visible << " " << e.contacts.size() << "\n";
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(*events[0].exact, AxisTurn::of(-1));
  EXPECT_EQ(*events[1].exact, AxisTurn::of(0));
  EXPECT_EQ(*events[2].exact, AxisTurn::of(1));
  EXPECT_EQ(*events[3].exact, AxisTurn::half_turn());
  for (const SolidTurnEvent& e : events) EXPECT_TRUE(e.visible);
}

}  // namespace
}  // namespace dymsum
