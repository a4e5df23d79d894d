// Refined cells of the interior mask: proofs, cell by cell; the pieces of segments outside them; and sums by them.
#include "planar/mask/fine_cells.h"
#include "oracles/snapped_shapes.h"

#include <gtest/gtest.h>

#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "oracles/check_sum.h"
#include "oracles/membership.h"
#include "oracles/pair_text.h"
#include "oracles/random.h"
#include "oracles/sanitized.h"
#include "oracles/tiny_regions.h"
#include "oracles/verdict.h"
#include "planar/arrangement/live_pieces.h"
#include "planar/operand/operand.h"
#include "planar/result/planar_sum.h"
#include "planar/sum/minkowski_sum.h"
#include "planar/sum/reduced.h"

namespace dymsum::planar {
namespace {

Bitmap random_bitmap(oracles::Random& random, int rows, int columns, int percent) {
  Bitmap map(rows, columns);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      if (random.chance(percent)) map.set(r, c);
  return map;
}

TEST(FineCells, brick_pairs_are_sums_of_bits) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    oracles::Random random(seed);
    const auto size = [&] { return kBrick * (1 + static_cast<int>(random.below(seed % 4 == 0 ? 20 : 5))); };
    const Bitmap a = random_bitmap(random, size(), size(), 1), b = random_bitmap(random, size(), size(), 2);
    Bitmap expected(a.rows + b.rows, a.columns + b.columns);
    for (int r = 0; r < a.rows; ++r)
      for (int c = 0; c < a.columns; ++c)
        for (int i = 0; a.get(r, c) && i < b.rows; ++i)
          for (int j = 0; j < b.columns; ++j)
            if (b.get(i, j)) expected.set(r + i, c + j);
    BrickPairs pairs(a, b);
    const Bricks sums(expected);
    for (int r = 0; r < sums.rows(); ++r)
      for (int c = 0; c < sums.columns(); ++c)
        ASSERT_EQ(pairs.covered(r, c, 0), sums.at(r, c)) << "seed " << seed << " " << r << " " << c;
  }
}

TEST(FineCells, parities_give_the_raster_of_winding_numbers) {
  const Region shapes_of[] = {shapes::noisy_star(80, 0.7, 1), shapes::random_polygon(60, 4, 2),
                              shapes::grate(5, 3, 1, 9)};
  for (const Region& shape : shapes_of) {
    const auto operand = prepared_operand(shape, 0);
    const auto lattice = make_lattice(operand->points, operand->points, 0);
    const auto placed = placed_on(*lattice, operand);
    const SumGrid grid({placed->points->width, placed->points->width}, {placed->points->height, placed->points->height},
                       300);
    const Raster by_parity = fine_raster(*placed, grid.part[0]), by_winding = winding_raster(*placed, grid.part[0]);
    EXPECT_EQ(by_parity.inner.bits, by_winding.inner.bits);
    EXPECT_EQ(by_parity.touch.bits, by_winding.touch.bits);
    EXPECT_TRUE(by_parity.inner.any());
  }
}

struct Refining {
  Refining(const Region& a, const Region& b, int cells) {
    const auto kept_p = prepared_operand(a, 0), kept_q = prepared_operand(b, 1);
    lattice = make_lattice(kept_p->points, kept_q->points, 0);
    p = placed_on(*lattice, kept_p);
    q = placed_on(*lattice, kept_q);
    mask.emplace(*p, *q, cells);
    fine.emplace(*p, *q, *mask);
    for (int r = 0; r < mask->grid().rows; ++r)
      for (int c = 0; c < mask->grid().columns; ++c)
        if (!mask->covered(r, c)) fine->refine(r, c);
  }
  bool covered(int row, int column) const {
    const Grid& g = fine->grid();
    return fine->covered((column + 0.5) * g.cell, (row + 0.5) * g.cell);
  }
  std::shared_ptr<const Lattice> lattice;
  std::shared_ptr<const Operand> p, q;
  std::optional<InteriorMask> mask;
  std::optional<FineCells> fine;
};

TEST(FineCells, covered_cells_lie_in_the_open_sum_with_their_rim) {
  const Region star = shapes::noisy_star(40, 0.5, 1), holed = shapes::random_polygon(30, 3, 2),
               disc = snapped_shapes::disc(60, 0.3);
  const std::pair<Region, Region> pairs[] = {{star, holed}, {disc, star}, {holed, star}};
  for (const auto& [p, q] : pairs) {
    const Refining m(p, q, 13);
    const Grid& g = m.fine->grid();
    const oracles::Membership<oracles::Big> sum(p.data(), q.data());
    const auto overlaps = [&](double x, double y) {
      const Point at = m.lattice->to_input(x * g.cell, y * g.cell);
      return sum.overlaps({oracles::from_double<oracles::Big>(at.x), oracles::from_double<oracles::Big>(at.y)});
    };
    int queried = 0, fine_only = 0;
    for (int r = 1; r + 1 < g.rows; ++r)
      for (int c = 1; c + 1 < g.columns; ++c) {
        const bool beside_live =
            !m.covered(r - 1, c) || !m.covered(r + 1, c) || !m.covered(r, c - 1) || !m.covered(r, c + 1);
        if (!m.covered(r, c) || !beside_live || (oracles::kSanitized && (r + c) % 8 != 0)) continue;
        ++queried;
        fine_only += !m.mask->covered(r / kBrick, c / kBrick);
        const double rim = 8 * kReach;
        for (const double y : {r - rim, r + 1 + rim})
          for (const double x : {c - rim, c + 1 + rim}) ASSERT_TRUE(overlaps(x, y)) << r << " " << c;
      }
    EXPECT_GT(queried, 30);
    EXPECT_GT(fine_only, 20);
  }
}

TEST(FineCells, pieces_hold_every_point_of_a_segment_outside_covered_cells) {
  const Region star = shapes::noisy_star(60, 0.6, 3), other = shapes::random_polygon(40, 2, 4);
  Refining m(star, other, 24);
  const ReducedConvolution convolution(*m.lattice, *m.p, *m.q);
  Soup soup(*m.lattice, *m.p, *m.q);
  add_all(convolution, soup);
  const Progress never;
  const LivePieces live = live_pieces(soup, Array<Span>(), *m.fine, Poll(never));
  std::size_t at = 0, mark = 0, gaps = 0, dropped = 0;
  for (std::uint32_t s = 0; s < soup.size(); ++s) {
    const std::size_t first = at;
    while (at < live.pieces.size() && live.pieces[at].segment == s) ++at;
    for (std::size_t k = first + 1; k < at; ++k) ASSERT_GT(live.pieces[k].low, live.pieces[k - 1].high);
    const SoupBox& b = soup.boxes[s];
    const auto covered = [&](double t) { return m.fine->covered(b.ax + t * b.dx, b.ay + t * b.dy); };
    for (double t = 1.0 / 2048; t < 1; t += 1.0 / 1024) {
      const bool in_piece = std::any_of(&live.pieces[first], live.pieces.data() + at,
                                        [&](const SegmentPiece& piece) { return t >= piece.low && t <= piece.high; });
      ASSERT_TRUE(in_piece || covered(t)) << s << " at " << t;
      gaps += !in_piece;
    }
    for (; mark < live.marks.size() && live.marks[mark].segment == s; ++mark) ASSERT_TRUE(covered(live.marks[mark].t));
    dropped += at == first;
  }
  EXPECT_EQ(at, live.pieces.size());
  EXPECT_EQ(mark, live.marks.size());
  EXPECT_GT(gaps, 1000u);
  EXPECT_GT(dropped, 10u);
}

Result<PlanarSum> refined_sum(const Region& p, const Region& q) {
  Result<SumState> state = compute_boundary(prepared_operand(p, 0), prepared_operand(q, 1), {}, Refine::always);
  if (!state.ok()) return state.error();
  return finish_sum(std::move(state).value(), {});
}

// DYMSUM_FUZZ_PAIRS tiny pairs, all degenerate somewhere, by refined masks and without any.
TEST(FineCells, refined_sums_of_tiny_grids_are_the_same) {
  const std::uint64_t count = oracles::setting("DYMSUM_FUZZ_PAIRS", oracles::kSanitized ? 100 : 1500);
  std::uint64_t masks = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    oracles::Random random(7000000 + k);
    const auto [p, q] = oracles::random_pair(random, 2 + random.below(5));
    const Result<Region> a = Region::create(p), b = Region::create(q);
    if (!a || !b) continue;
    const Result<PlanarSum> by_mask = refined_sum(*a, *b);
    ASSERT_TRUE(by_mask.ok());
    ASSERT_TRUE(*by_mask == *minkowski_sum(*a, *b)) << "seed " << 7000000 + k << "\n" << oracles::to_text(p, q);
    masks += by_mask->stats.mask_grid > 0;
  }
  EXPECT_GT(masks, count / 3);
}

TEST(FineCells, refined_sums_of_larger_shapes_are_the_same) {
  const Region shapes_of[] = {
      shapes::noisy_star(60, 0.8, 1), shapes::random_polygon(50, 4, 2),      shapes::grate(6, 3, 1, 11),
      snapped_shapes::disc(70, 1),    snapped_shapes::spiral(3, 12, 1, 0.4), shapes::comb(8, 3, 1, 5)};
  for (const Region& p : shapes_of)
    for (const Region& q : shapes_of) {
      const Result<PlanarSum> by_mask = refined_sum(p, q);
      ASSERT_TRUE(by_mask.ok());
      ASSERT_TRUE(*by_mask == *minkowski_sum(p, q)) << oracles::to_text(p.data(), q.data());
    }
}

}  // namespace
}  // namespace dymsum::planar
