// Covered cells against the definition, cell by cell.
#include "planar/mask/interior_mask.h"

#include <gtest/gtest.h>

#include "oracles/random.h"

namespace dymsum::planar {
namespace {

bool corner(const Bitmap& inner, int r, int c) {
  return r > 0 && c > 0 && inner.get(r, c) && inner.get(r - 1, c) && inner.get(r, c - 1) && inner.get(r - 1, c - 1);
}

/// Blocks of inner cells, all touched, and some cells that are only touched.
Raster random_raster(oracles::Random& random, int rows, int columns, int blocks) {
  Raster raster(rows, columns);
  for (int k = 0; k < blocks; ++k) {
    const int r = static_cast<int>(random.below(rows)), c = static_cast<int>(random.below(columns));
    const int height = 1 + static_cast<int>(random.below(6)),
              width = 1 + static_cast<int>(random.below(random.chance(30) ? 140 : 9));
    for (int i = r; i < std::min(rows, r + height); ++i) raster.inner.set_run(i, c, std::min(columns, c + width) - 1);
  }
  for (int k = 0; k < 2 * blocks; ++k)
    raster.touch.set(static_cast<int>(random.below(rows)), static_cast<int>(random.below(columns)));
  for (std::size_t i = 0; i < raster.touch.bits.size(); ++i) raster.touch.bits[i] |= raster.inner.bits[i];
  return raster;
}

std::vector<std::uint8_t> by_definition(const Grid& grid, const Raster& p, const Raster& q) {
  std::vector<std::uint8_t> covered(std::size_t(grid.rows) * grid.columns, 0);
  bool corners_p = false, corners_q = false;
  const auto for_each = [](const Bitmap& map, auto&& f) {
    for (int r = 0; r < map.rows; ++r)
      for (int c = 0; c < map.columns; ++c)
        if (map.get(r, c)) f(r, c);
  };
  const auto add = [&](const Bitmap& a, const Bitmap& b, bool corners, bool& any, int spread) {
    for_each(a, [&](int i, int j) {
      if (corners && !corner(a, i, j)) return;
      any = true;
      for_each(b, [&](int r, int c) {
        for (int u = 0; u <= spread; ++u)
          for (int v = 0; v <= spread; ++v) covered[std::size_t(i + r + u) * grid.columns + (j + c + v)] = 1;
      });
    });
  };
  add(p.inner, q.touch, true, corners_p, 0);
  add(q.inner, p.touch, true, corners_q, 0);
  bool any = false;
  if (!corners_p || !corners_q) add(p.inner, q.inner, false, any, 1);
  return covered;
}

/// Rows of one long run with ragged ends, some with a gap: most sums of two runs lie in longer ones.
Raster solid_raster(oracles::Random& random, int rows, int columns) {
  Raster raster(rows, columns);
  const auto below = [&](int n) { return static_cast<int>(random.below(n)); };
  for (int r = 0; r < rows; ++r) {
    const int first = below(20), last = columns - 1 - below(20);
    if (random.chance(5)) continue;
    if (random.chance(15)) {
      const int gap = first + 1 + below(last - first - 1);
      raster.inner.set_run(r, first, gap - 1);
      if (gap + 1 <= last) raster.inner.set_run(r, gap + 1, last);
    } else {
      raster.inner.set_run(r, first, last);
    }
    raster.touch.set(r, below(columns));
  }
  for (std::size_t i = 0; i < raster.touch.bits.size(); ++i) raster.touch.bits[i] |= raster.inner.bits[i];
  return raster;
}

struct Counts {
  std::size_t covered = 0, live = 0;
};

Counts compare_with_definition(const Raster& p, const Raster& q, std::uint64_t seed) {
  Grid grid;
  grid.rows = p.inner.rows + q.inner.rows;
  grid.columns = p.inner.columns + q.inner.columns;
  grid.cell = grid.per_cell = 1;
  const CoveredCells cells(grid, p, q);
  const std::vector<std::uint8_t> expected = by_definition(grid, p, q);
  std::size_t wrong = 0;
  Counts counts;
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      const bool d = expected[std::size_t(r) * grid.columns + c] != 0;
      wrong += cells.covered(r, c) != d;
      (d ? counts.covered : counts.live) += 1;
      if (cells.live(r, c, r, c) != (d ? 0u : 1u)) ++wrong;
    }
  EXPECT_EQ(wrong, 0u) << "seed " << seed;
  return counts;
}

TEST(CoveredCells, are_the_sums_of_inner_corners_and_touched_cells) {
  std::size_t covered = 0, live = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    oracles::Random random(seed);
    const auto size = [&] { return 3 + static_cast<int>(random.below(seed % 3 == 0 ? 150 : 30)); };
    const int rows_p = size(), columns_p = size(), rows_q = size(), columns_q = size();
    const Raster p = random_raster(random, rows_p, columns_p, seed % 5 == 0 ? 1 : 8),
                 q = random_raster(random, rows_q, columns_q, 6);
    const Counts counts = compare_with_definition(p, q, seed);
    covered += counts.covered;
    live += counts.live;
  }
  EXPECT_GT(covered, 10000u);
  EXPECT_GT(live, 10000u);
}

TEST(CoveredCells, of_solid_operands_are_the_same_by_runs) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    oracles::Random random(seed);
    const int rows_p = 10 + static_cast<int>(random.below(30)), rows_q = 10 + static_cast<int>(random.below(30));
    const Raster p = solid_raster(random, rows_p, 130 + static_cast<int>(random.below(80)));
    const Raster q = solid_raster(random, rows_q, 130 + static_cast<int>(random.below(80)));
    const Counts counts = compare_with_definition(p, q, seed);
    EXPECT_GT(counts.covered, 1000u);
    EXPECT_GT(counts.live, 100u);
  }
}

}  // namespace
}  // namespace dymsum::planar
