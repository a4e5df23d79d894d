// Edited sums against sums from scratch.
#include <gtest/gtest.h>

#include <cstdlib>

#include "dymsum/shapes.h"
#include "oracles/coordinate_kinds.h"
#include "oracles/tiny_regions.h"
#include "planar/edit/edited_same.h"
#include "planar/position/exact_source.h"

namespace dymsum {
namespace {

using namespace edit_tests;

int rounds(int by_default) {
  const char* text = std::getenv("DYMSUM_EDITS");
  return text != nullptr ? std::max(1, std::atoi(text) * by_default / 3000) : by_default;
}

struct Counts {
  int made = 0, refused = 0, updated = 0, degenerate = 0;
};

void edit_and_compare(EditableSum& sum, oracles::Random& random, const Reach& reach, const EditOptions& options,
                      bool names, Counts& counts) {
  std::vector<Edit> edits{random_edit(random, sum, reach)};
  while (random.chance(25)) edits.push_back(random_edit(random, sum, reach));
  const int kind = random.below(12);
  const Result<FrameChanges> changes = kind == 0 && sum.undo_count() > 0   ? sum.undo()
                                       : kind == 1 && sum.redo_count() > 0 ? sum.redo()
                                                                           : sum.edit(edits);
  if (!changes) {
    ++counts.refused;
    return;
  }
  ++counts.made;
  counts.updated += !sum.work().rebuilt;
  counts.degenerate += sum.work().degenerate;
  const PlanarSum scratch = fresh_sum(sum.p(), sum.q(), options);
  ASSERT_EQ(difference(sum.sum(), scratch, names), "");
  ASSERT_EQ(sum.ring_ids().size(), [&] {
    std::size_t rings = 0;
    for (const SumPart& part : scratch.parts) rings += 1 + part.holes.size();
    return rings;
  }());
}

TEST(EditableSum, tiny_grids_equal_sums_from_scratch) {
  Counts counts;
  for (int round = 0, n = rounds(150); round < n; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    oracles::Random random(static_cast<std::uint64_t>(round) + 1);
    const Region p = Region::create(oracles::random_parts(random, 6)).value();
    const Region q = Region::create(oracles::random_parts(random, 4)).value();
    EditOptions options;
    options.mode = FrameMode::window;
    options.reflect_q = random.chance(30);
    options.semantics = random.chance(20)   ? Semantics::open
                        : random.chance(20) ? Semantics::regular
                                            : Semantics::closed;
    planar::SumInternals::min_tier_bits(options) = random.chance(30) ? 61 : 0;
    EditableSum sum = EditableSum::create(p, q, options).value();
    for (int step = 0; step < 20; ++step) {
      // Now and then a fine coordinate: what doubles decided takes exact signs, and the reverse.
      const Reach reach{2, random.chance(4) ? 0x1p-30 : 1};
      edit_and_compare(sum, random, reach, options, false, counts);
      ASSERT_FALSE(testing::Test::HasFatalFailure()) << "step " << step;
    }
  }
  EXPECT_GT(counts.made, 100);
  EXPECT_GT(counts.refused, 100);
  EXPECT_GT(counts.updated, 100);
  EXPECT_GT(counts.degenerate, 0);
  std::cout << counts.made << " made, " << counts.refused << " refused, " << counts.updated << " updated, "
            << counts.degenerate << " degenerate\n";
}

TEST(EditableSum, free_shapes_equal_sums_from_scratch_in_all_coordinates) {
  Counts counts;
  const struct {
    Region p, q;
  } shapes[] = {{shapes::noisy_star(40, 0.5, 1), shapes::noisy_star(30, 0.7, 2)},
                {shapes::random_polygon(60, 3, 3), shapes::noisy_star(12, 0.6, 4)},
                {shapes::random_polygon(50, 2, 5), shapes::random_polygon(40, 1, 6)}};
  for (const CoordinateKind kind : kCoordinateKinds)
    for (const auto& shape : shapes) {
      SCOPED_TRACE(name_of(kind));
      std::mt19937_64 noise(1);
      const Result<Region> p = Region::create(of_kind(shape.p.data(), kind, noise));
      const Result<Region> q = Region::create(of_kind(shape.q.data(), kind, noise));
      ASSERT_TRUE(p.ok() && q.ok());
      EditOptions options;
      options.mode = FrameMode::window;
      const auto box = bounds(*p);
      const Reach reach{0.08 * (box[2] - box[0]), 0};
      // Anew every so many steps: edits make shapes small, and what is small is made from scratch.
      for (int block = 0, n = rounds(60) / 60; block < n; ++block) {
        SCOPED_TRACE("block " + std::to_string(block));
        oracles::Random random(static_cast<std::uint64_t>(7 + block));
        EditableSum sum = EditableSum::create(*p, *q, options).value();
        for (int step = 0; step < 60; ++step) {
          edit_and_compare(sum, random, reach, options, true, counts);
          ASSERT_FALSE(testing::Test::HasFatalFailure()) << "step " << step;
        }
      }
    }
  EXPECT_GT(counts.updated, 100);
  std::cout << counts.made << " made, " << counts.refused << " refused, " << counts.updated << " updated, "
            << counts.degenerate << " degenerate\n";
}

}  // namespace
}  // namespace dymsum
