// What a list of times says: its mean, its median and its worst. Shared by the suites.
#pragma once

#include <cstddef>
#include <vector>

namespace dymsum::bench {

/// Of values in any order; all zero for none.
struct Spread {
  double mean = 0, median = 0, p99 = 0, worst = 0;
  std::size_t count = 0;
};
Spread spread(const std::vector<double>& values);

/// The least value that at least this fraction of the others do not exceed; 0 for none.
double quantile(std::vector<double> values, double fraction);

/// Of positive values; 0 for none.
double geometric_mean(const std::vector<double>& values);

}  // namespace dymsum::bench
