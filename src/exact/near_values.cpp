#include "exact/near_values.h"

#include <algorithm>
#include <cmath>

#include "exact/grid.h"

namespace dymsum::exact {

double power_below(double v) { return std::exp2(std::floor(std::log2(v))); }

namespace {

/// The spacing of single precision at the size, or at the largest coordinate of what is further away than it is large.
/// Nothing where the size has not 256 of these: there is no telling what is rounding.
std::optional<double> unit_of_single_precision(std::span<const double> coordinates, double size) {
  const double coarse = power_below(std::ldexp(size, -12));
  bool long_ones = false;
  double reach = size;
  for (const double c : coordinates) {
    if (static_cast<double>(static_cast<float>(c)) != c) return std::nullopt;
    long_ones = long_ones || std::remainder(c, coarse) != 0;
    reach = std::max(reach, std::abs(c));
  }
  const double unit = std::ldexp(reach, -23);
  return long_ones && size >= 256 * unit ? std::optional(unit) : std::nullopt;
}

/// The unit of the last digit of decimals.
std::optional<double> unit_of_decimals(std::span<const double> coordinates, double size) {
  constexpr int kMostDigits = 12;
  double power = 1;
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    power *= 10;
    std::size_t round = 0;  // that end in 0 or 5
    const bool all = std::all_of(coordinates.begin(), coordinates.end(), [&](double c) {
      const double whole = std::nearbyint(c * power);
      round += std::remainder(whole, 5) == 0;
      return std::abs(whole) < 0x1p53 && whole / power == c;
    });
    if (!all) continue;
    const bool long_ones = size * power >= 4096 && 8 * round <= 7 * coordinates.size();
    return long_ones ? std::optional(1 / power) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> rounding_unit(std::span<const double> coordinates, double size, bool decimals) {
  if (!(size > 0)) return std::nullopt;
  if (const auto unit = unit_of_single_precision(coordinates, size)) return unit;
  return decimals ? unit_of_decimals(coordinates, size) : std::nullopt;
}

MoveTolerance move_tolerance(std::span<const double> coordinates, double size, std::optional<double> wanted,
                             bool decimals) {
  double largest = 0;
  for (const double c : coordinates) largest = std::max(largest, std::abs(c));
  const double least = largest * 0x1p-46;
  if (wanted) return {least, *wanted, false};
  const std::optional<double> unit = rounding_unit(coordinates, size, decimals);
  return {least, std::max(least, unit ? 8 * *unit : std::ldexp(size, -40)), unit.has_value()};
}

double most_usual(const std::vector<double>& run) {
  double best = run[0];
  std::size_t most = 0;
  const auto digits = [](double v) {
    const std::int64_t m = to_dyadic(v).mantissa;
    return m < 0 ? -m : m;
  };
  for (std::size_t first = 0, last = 0; first < run.size(); first = last) {
    while (last < run.size() && run[last] == run[first]) ++last;
    const std::size_t count = last - first;
    if (count > most || (count == most && digits(run[first]) < digits(best))) best = run[first], most = count;
  }
  return best;
}

double midpoint_of(const std::vector<double>& run, double unit) {
  return std::nearbyint((run.front() / 2 + run.back() / 2) / unit) * unit;
}

Residue residue_of(double v) {
  const Dyadic d = to_dyadic(v);
  const Residue size = folded(static_cast<u128>(d.mantissa < 0 ? -d.mantissa : d.mantissa));
  const Residue shifted = times(size, Residue{1} << ((d.exponent % 61 + 61) % 61));  // 2^61 is 1
  return d.mantissa < 0 ? minus(0, shifted) : shifted;
}

}  // namespace dymsum::exact
