// The windows of a sweep cover the full turn, one after the other, however they are halved.
#include "cspace/obstacle/event_windows.h"

#include <gtest/gtest.h>

#include "dymsum/shapes.h"
#include "oracles/snapped_shapes.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {
namespace {

void expect_full_turn(const Region& robot, const Region& obstacle, EventWindows::Halved halved) {
  const std::shared_ptr<const OperandPair> base =
      pair_of_regions(obstacle, robot, PairOptions{.moved = 1, .reflect_q = true}).value();
  const TurningForms forms(*base);
  const RotationCatalog catalog(forms);
  const EventWindows windows(forms, catalog, false);
  int chart = 0;
  double at = -1;
  std::size_t parts = 0;
  for (int k = 0; k < windows.count(); ++k)
    for (const PreparedWindow& p : windows.prepare(k, halved)) {
      if (at == 1) at = chart++ == 0 ? -1 : 1;
      EXPECT_EQ(p.range.chart, chart);
      EXPECT_EQ(p.range.t_low, at);
      EXPECT_LT(p.range.t_low, p.range.t_high);
      at = p.range.t_high;
      ++parts;
      for (const RotationEvent& event : p.found.events) {
        EXPECT_GE(event.high, p.range.theta(p.range.t_low));
        EXPECT_LE(event.low, p.range.theta(p.range.t_high));
      }
      EXPECT_EQ(p.at_end.has_value() && p.range.t_high != 0 && p.range.t_high != 1, false);
    }
  EXPECT_EQ(chart, 1);
  EXPECT_EQ(at, 1);
  EXPECT_GE(parts, static_cast<std::size_t>(windows.count()) * (halved == EventWindows::Halved::always ? 2 : 1));
}

TEST(EventWindows, CoverTheTurn) {
  const Region comb = shapes::comb(5, 3, 1, 5), star = snapped_shapes::star(6, 0.4, 1);
  for (const auto halved : {EventWindows::Halved::where_crowded, EventWindows::Halved::always}) {
    expect_full_turn(comb, comb, halved);
    expect_full_turn(star, comb, halved);
  }
}

}  // namespace
}  // namespace dymsum::planar
