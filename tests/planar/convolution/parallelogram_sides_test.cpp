// Parallelograms of two polylines: closed, counter-clockwise, one for each pair of edges that is not parallel.
#include "planar/convolution/convolution.h"

#include <gtest/gtest.h>

#include <map>

#include "planar/placed_pair.h"

namespace dymsum::planar {
namespace {

Region line(Polyline points) { return Region::create({{}, {std::move(points)}, {}}).value(); }

TEST(ParallelogramSides, close_around_every_pair_of_edges_that_is_not_parallel) {
  const PlacedPair o = placed_pair(line({{0, 0}, {4, 0}, {4, 3}}), line({{0, 0}, {0, 2}}));
  const std::vector<WalkSegment> sides = parallelogram_sides(*o.lattice, *o.p, *o.q);
  ASSERT_EQ(sides.size(), 4u) << "(4, 0) with (0, 2) there and back";
  std::map<std::pair<double, double>, int> ends;
  double area = 0;
  for (const WalkSegment& w : sides) {
    const Operand &own = w.side == 0 ? *o.p : *o.q, &other = w.side == 0 ? *o.q : *o.p;
    const EdgeBox& b = own.boxes[w.edge];
    const double x = other.x[w.vertex], y = other.y[w.vertex];
    ++ends[{b.ax + x, b.ay + y}];
    --ends[{b.bx + x, b.by + y}];
    area += 0.5 * ((b.ax + x) * (b.by + y) - (b.ay + y) * (b.bx + x));
  }
  for (const auto& [at, count] : ends) EXPECT_EQ(count, 0) << at.first << ", " << at.second;
  EXPECT_EQ(area, 8);
}

TEST(ParallelogramSides, none_beside_a_component_with_area) {
  const Region square = Region::create({{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}}}, {}, {}}).value();
  const PlacedPair o = placed_pair(square, line({{0, 0}, {3, 1}}));
  EXPECT_TRUE(parallelogram_sides(*o.lattice, *o.p, *o.q).empty());
  EXPECT_FALSE(has_component_without_area(*o.p));
  EXPECT_TRUE(has_component_without_area(*o.q));
}

}  // namespace
}  // namespace dymsum::planar
