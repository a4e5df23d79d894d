// What a table consists of, behind NfpTable.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/sha256.h"
#include "dymsum/nfp_table.h"
#include "dymsum/planar_sum.h"

namespace dymsum {

namespace nesting {

using Key = base::Digest;

/// One answer to be computed, and perhaps the one that mirrors it, by the first rows that have them.
struct Task {
  static constexpr std::uint32_t kNone = TableRow::kNone;
  std::uint32_t row = 0;
  std::uint32_t mirror = kNone;  ///< the operands exchanged
};

/// The SHA-256 of a shape: of its well-known binary.
base::Digest digest_of(const Region& shape);

}  // namespace nesting

struct NfpTable::State {
  TableInput input;
  std::vector<base::Digest> item_digests, bin_digests;
  std::vector<TableAngle> angles;
  /// How many quarter turns, counter-clockwise, an angle is, where it is a number of them.
  std::vector<std::optional<int>> quarters;
  std::optional<Region> spacing, margin;  ///< the polygons of these distances, symmetric to axes and diagonals
  std::vector<Result<PlanarSum>> grown;   ///< by items: with the spacing around them, where there is one
  /// The regions of items, turned by 1, 2 and 3 quarters where a row needs that.
  std::vector<std::array<std::optional<Region>, 4>> turned;
  std::vector<TableRow> rows;
  std::vector<nesting::Key> keys;  ///< by answer; strip fits have none, their answers come last
  std::vector<nesting::Task> tasks;
  std::size_t answers = 0;
  std::uint64_t mark = 0;  ///< see TableResult::table
};

}  // namespace dymsum
