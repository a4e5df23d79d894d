// Cells that lie in the sum of two edges throughout a window: every one at many angles against the edges themselves.
#include <gtest/gtest.h>

#include "dymsum/shapes.h"
#include "oracles/snapped_shapes.h"
#include "planar/motion/operand_pair.h"
#include "planar/window/rotating_window.h"
#include "planar/window/rotation_mask.h"

namespace dymsum::planar {
namespace {

struct Made {
  std::shared_ptr<const OperandPair> base;
  std::unique_ptr<TurningForms> forms;
};

Made made(const Region& p, const Region& q) {
  Made m;
  m.base = pair_of_regions(p, q, PairOptions{.moved = 1}).value();
  m.forms = std::make_unique<TurningForms>(*m.base);
  return m;
}

std::vector<Point> turned(const TurningForms& forms, double theta) {
  const Heading h = Heading::of(theta);
  std::vector<Point> to;
  for (const Point& p : forms.points(1)) to.push_back({h.c * p.x - h.s * p.y, h.s * p.x + h.c * p.y});
  return to;
}

// Whether edges e and f of the operands cross properly where the second one, reflected, is put at z: z is an inner
// point of their sum.
bool cross_at(const TurningForms& forms, std::uint32_t e, Point u, Point f0, Point f1, Point z) {
  const Point a = forms.points(0)[e], v{f1.x - f0.x, f1.y - f0.y}, w{z.x - a.x - f0.x, z.y - a.y - f0.y};
  const double area = u.x * v.y - u.y * v.x, s = (w.x * v.y - w.y * v.x) / area, t = (u.x * w.y - u.y * w.x) / area;
  return s > 0 && s < 1 && t > 0 && t < 1;
}

// A rectangle turned by an exact rotation, so that its edges are not parallel to the axes.
Region slanted(double length, double width) {
  return Region::create(RegionData{{{{{0, 0},
                                      {length * 0.75, length},
                                      {length * 0.75 - width, length + 0.75 * width},
                                      {-width, 0.75 * width}},
                                     {}}},
                                   {},
                                   {}})
      .value();
}

TEST(EdgeParallelograms, every_cell_is_covered_at_every_angle_of_the_window) {
  const std::vector<std::pair<Region, Region>> pairs{
      {shapes::rectangle(0, 0, 32, 0.25), shapes::rectangle(0, 0, 0.25, 30)},
      {slanted(24, 0.5), shapes::rectangle(0, 0, 28, 0.5)},
      {shapes::comb(5, 20, 2, 40), shapes::letter_l(30, 20, 0.5)}};
  for (const auto& [p, q] : pairs)
    for (const double midpoint : {0.0, 0.4, 1.6, 3.0})
      for (const double half : {0.01, 0.05}) {
        const Made m = made(p, q);
        const TurningForms& forms = *m.forms;
        const RotationGrid grid(forms, 48);
        const Grid& cells = grid.grid.whole;
        ASSERT_FALSE(grid.long_edges[0].empty());
        ASSERT_FALSE(grid.long_edges[1].empty());
        const Bitmap inside = edge_parallelograms(grid, turned(forms, midpoint), half);
        std::size_t found = 0;
        for (const double by : {-1.0, -0.5, 0.0, 0.7, 1.0}) {
          const std::vector<Point> now = turned(forms, midpoint + by * half);
          for (int row = 0; row < cells.rows; ++row)
            for (int column = 0; column < cells.columns; ++column) {
              if (!inside.get(row, column)) continue;
              ++found;
              // A parallelogram is convex: all four corners in one.
              bool covered = false;
              for (const std::uint32_t e : grid.long_edges[0])
                for (const std::uint32_t f : grid.long_edges[1]) {
                  const Point f0 = now[f], f1 = now[forms.operand(1).next[f]];
                  int corners = 0;
                  for (int k = 0; k < 4; ++k)
                    corners += cross_at(
                        forms, e, forms.edge(0, e), f0, f1,
                        {(column + k % 2) * cells.cell - forms.reach(), (row + k / 2) * cells.cell - forms.reach()});
                  covered |= corners == 4;
                }
              ASSERT_TRUE(covered) << row << " " << column << " of " << cells.rows << " at " << midpoint << " + " << by
                                   << " * " << half;
            }
        }
        const bool parallel = &p == &pairs[0].first && midpoint == 1.6;
        if (half < 0.02 && !parallel) {
          EXPECT_GT(found, 100u) << midpoint;
        }
      }
}

// Of the two sides of a bar one is enough, and short edges say nothing.
TEST(EdgeParallelograms, long_edges_are_told_once_and_short_ones_left_out) {
  const Made m = made(shapes::rectangle(0, 0, 32, 0.25), snapped_shapes::disc(64, 1));
  EXPECT_EQ(long_edges(*m.forms, 0, 1, 24).size(), 1u);
  EXPECT_EQ(long_edges(*m.forms, 0, 0.125, 24).size(), 2u);
  EXPECT_TRUE(long_edges(*m.forms, 1, 1, 24).empty());
}

TEST(EdgeParallelograms, windows_look_at_fewer_pairs_by_them) {
  const Made m = made(shapes::grate(6, 4, 0.25, 6), shapes::comb(6, 2, 0.25, 20));
  const RotationCatalog catalog(*m.forms);
  const RotationGrid grid(*m.forms, 96);
  RotationGrid without = grid;
  without.long_edges = {};
  const RotatingWindow with(grid, catalog, 0.5, 0.005, true), all(without, catalog, 0.5, 0.005, true);
  EXPECT_LT(4 * with.candidates.size(), 3 * all.candidates.size());
}

}  // namespace
}  // namespace dymsum::planar
