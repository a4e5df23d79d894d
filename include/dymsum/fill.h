// The positions that lie inside of closed curves or surfaces that cross, touch or lie on each other: by winding number.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace dymsum {

/// A rule for the winding number, that is how often rings go around a position counter-clockwise, or surfaces seen from
/// outside; those that run the other way count as -1.
enum class Fill : std::uint8_t {
  positive,  ///< 1 or more: the union of sets, their holes taken out
  nonzero,   ///< any but 0: the same, also of sets whose boundaries run the other way
  even_odd,  ///< an odd number: what lies in two sets is outside
};

}  // namespace dymsum
