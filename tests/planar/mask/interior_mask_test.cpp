// Covered cells lie in the open sum with more around them than anything errs, and are determined by words as cell by
// cell.
#include "planar/mask/interior_mask.h"
#include "oracles/snapped_shapes.h"

#include <gtest/gtest.h>

#include "dymsum/shapes.h"
#include "oracles/membership.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {
namespace {

struct Masked {
  Masked(const Region& a, const Region& b, int cells) {
    const auto kept_p = prepared_operand(a, 0), kept_q = prepared_operand(b, 1);
    lattice = make_lattice(kept_p->points, kept_q->points, 0);
    mask.emplace(*placed_on(*lattice, kept_p), *placed_on(*lattice, kept_q), cells);
  }
  std::shared_ptr<const Lattice> lattice;
  std::optional<InteriorMask> mask;
};

bool lies_inside(const oracles::Membership<oracles::Big>& sum, const Masked& m, int row, int column) {
  const Grid& g = m.mask->grid();
  const double rim = 8 * kReach;
  for (const double y : {row - rim, row + 1 + rim})
    for (const double x : {column - rim, column + 1 + rim}) {
      const Point at = m.lattice->to_input(x * g.cell, y * g.cell);
      const auto big = [](double v) { return oracles::from_double<oracles::Big>(v); };
      if (!sum.overlaps({big(at.x), big(at.y)})) return false;
    }
  return true;
}

/// A pyramid of steps of one unit; with cells of two units its edges lie on lines between cells or in the middle of
/// cells.
Region steps(int n) {
  Ring ring;
  for (int k = 0; k < n; ++k) {
    ring.push_back({4.0 * n - k, 1.0 * k});
    ring.push_back({4.0 * n - k, 1.0 * k + 1});
  }
  for (int k = n - 1; k >= 0; --k) {
    ring.push_back({1.0 * k, 1.0 * k + 1});
    ring.push_back({1.0 * k, 1.0 * k});
  }
  return Region::create({{{std::move(ring), {}}}, {}, {}}).value();
}

TEST(InteriorMask, edges_between_cells_keep_both_rows_from_being_covered) {
  for (const bool upside_down : {false, true}) {
    const Region p = upside_down ? negated(steps(16)) : steps(16), q = shapes::rectangle(0, 0, 8, 8);
    const Masked m(p, q, 36);
    ASSERT_EQ(m.mask->grid().cell, 2);
    const oracles::Membership<oracles::Big> sum(p.data(), q.data());
    int covered = 0;
    for (int r = 0; r < m.mask->grid().rows; ++r)
      for (int c = 0; c < m.mask->grid().columns; ++c) {
        if (!m.mask->covered(r, c)) continue;
        ++covered;
        ASSERT_TRUE(lies_inside(sum, m, r, c)) << r << " " << c;
      }
    EXPECT_GT(covered, 200);
  }
}

// Those beside a live cell: any other lies among them.
TEST(InteriorMask, covered_cells_lie_in_the_open_sum_with_their_rim) {
  const Region star = shapes::noisy_star(40, 0.5, 1), holed = shapes::random_polygon(30, 3, 2);
  const Region fine = snapped_shapes::disc(400, 1), gear = snapped_shapes::gear(60, 3, 4),
               disc = snapped_shapes::disc(90, 0.4);
  const std::pair<Region, Region> pairs[] = {{star, holed}, {fine, star}, {gear, disc}, {holed, fine}};
  for (const auto& [p, q] : pairs)
    for (const int cells : {9, 40, 100}) {
      const Masked m(p, q, cells);
      const Grid& g = m.mask->grid();
      const oracles::Membership<oracles::Big> sum(p.data(), q.data());
      int covered = 0, queried = 0;
      for (int r = 1; r + 1 < g.rows; ++r)
        for (int c = 1; c + 1 < g.columns; ++c) {
          covered += m.mask->covered(r, c);
          if (!m.mask->covered(r, c) || !m.mask->any_live(r - 1, c - 1, r + 1, c + 1)) continue;
          if (cells > 50 && (r + c) % (oracles::kSanitized ? 16 : 4) != 0) continue;
          ++queried;
          ASSERT_TRUE(lies_inside(sum, m, r, c)) << r << " " << c << " of " << cells;
        }
      if (cells == 9) continue;
      EXPECT_GT(covered, g.rows * g.columns / 10);
      EXPECT_GT(queried, 10);
    }
}

TEST(InteriorMask, any_live_looks_at_every_cell_of_a_rectangle) {
  const Masked m(shapes::noisy_star(60, 0.5, 3), shapes::noisy_star(50, 0.5, 4), 200);
  const Grid& g = m.mask->grid();
  oracles::Random random(5);
  int live = 0, covered = 0;
  for (int k = 0; k < 20000; ++k) {
    const int r0 = random.below(g.rows), c0 = random.below(g.columns);
    const int r1 = std::min(g.rows - 1, r0 + random.below(6));
    const int c1 = std::min(g.columns - 1, c0 + random.below(k % 2 == 0 ? 6 : 150));
    bool expected = false;
    for (int r = r0; r <= r1; ++r)
      for (int c = c0; c <= c1; ++c) expected |= !m.mask->covered(r, c);
    ASSERT_EQ(m.mask->any_live(r0, c0, r1, c1), expected) << r0 << " " << c0 << " " << r1 << " " << c1;
    (expected ? live : covered) += 1;
  }
  EXPECT_GT(live, 1000);
  EXPECT_GT(covered, 1000);
}

}  // namespace
}  // namespace dymsum::planar
