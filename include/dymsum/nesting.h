// Nesting instances: which items have to be placed, in which orientations, and into what.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// A kind of item. Its shape is as it stands in the file and not yet validated.
struct NestingItem {
  std::string name;
  RegionData shape;
  std::uint64_t demand = 1;  ///< how many are to be placed
  /// The orientations that it may take, counter-clockwise about the origin of its coordinates, in degrees: exactly the
  /// decimal numbers with the fewest digits that stand for the doubles of the file. Nothing where any orientation is
  /// allowed.
  std::optional<std::vector<Rational>> degrees;
};

/// A kind of bin.
struct NestingBin {
  std::string name;
  RegionData shape;
};

struct NestingInstance {
  std::string name;  ///< empty where the file has none
  std::vector<NestingItem> items;
  std::vector<NestingBin> bins;
  std::optional<double> strip_height;
};

/// The JSON of the nesting literature, as jagua-rs and sparrow read it (docs/guide/nesting.md). Errors: cannot_open;
/// malformed, truncated and not_finite with file and line: also for items of one name, heights that are not positive,
/// demands that are no count, bins with zones of other quality.
Result<NestingInstance> read_nesting_instance(const std::string& path);
Result<NestingInstance> parse_nesting_instance(std::string_view text, std::string_view name_for_errors);

}  // namespace dymsum
