#include "spread.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dymsum::bench {

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(std::ceil(fraction * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

Spread spread(const std::vector<double>& values) {
  if (values.empty()) return {};
  const double total = std::accumulate(values.begin(), values.end(), 0.0);
  return {total / static_cast<double>(values.size()), quantile(values, 0.5), quantile(values, 0.99),
          quantile(values, 1), values.size()};
}

double geometric_mean(const std::vector<double>& values) {
  if (values.empty()) return 0;
  double logs = 0;
  for (const double v : values) logs += std::log(v);
  return std::exp(logs / static_cast<double>(values.size()));
}

}  // namespace dymsum::bench
