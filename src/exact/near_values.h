// Coordinates that were equal before they were rounded: how far rounding took them apart, and one value for each run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "exact/big.h"

namespace dymsum::exact {

/// The largest power of two that is not above v. Requires: v > 0, finite.
double power_below(double v);

/// The spacing of numbers to which coordinates look rounded: of single precision at `size`, or of decimals. Nothing
/// where they have digits beyond these, or have no use for nearly all of them: coordinates that are multiples of 2^-12
/// of the size, decimals of fewer than 4096 units in the size or of which all but an eighth end in 0 or 5.
std::optional<double> rounding_unit(std::span<const double> coordinates, double size, bool decimals);

/// How far a vertex may move to where it was meant.
struct MoveTolerance {
  double least = 0;      ///< 64 units in the last place of the largest coordinate: below it nothing can be put right
  double value = 0;      ///< as wanted, else 8 units of the rounding, else 2^-40 of the size or the least
  bool rounded = false;  ///< by the rounding
};
MoveTolerance move_tolerance(std::span<const double> coordinates, double size, std::optional<double> wanted,
                             bool decimals);

/// Values within `width` of the smallest of a run become one. `rounded` says which one of a sorted run. The number of
/// different values that this takes away.
template <class F>
std::size_t join_values(std::vector<double>& values, double width, F rounded) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::size_t joined = 0;
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && values[order[last]] - values[order[first]] <= width) ++last;
    std::vector<double> run;
    for (std::size_t k = first; k < last; ++k) run.push_back(values[order[k]]);
    const double one = rounded(run);
    joined += static_cast<std::size_t>(std::unique(run.begin(), run.end()) - run.begin()) - 1;
    for (std::size_t k = first; k < last; ++k) values[order[k]] = one;
  }
  return joined;
}

/// Of doubles in order the one that occurs most often, with the fewest digits of such.
double most_usual(const std::vector<double>& run);
/// The midpoint of a sorted run as a multiple of a unit.
double midpoint_of(const std::vector<double>& run, double unit);

/// A double by its residue: equal doubles have equal ones, different ones with a chance of 2^-61.
Residue residue_of(double v);

}  // namespace dymsum::exact
