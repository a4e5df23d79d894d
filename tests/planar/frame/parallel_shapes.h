// Shapes most of whose edges are parallel to others, many on one line: their sums touch themselves at every scale.
#pragma once

#include <random>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::scaling_tests {

/// A polygon between two skylines of few heights, so that most edges have others on their lines; `upright`: turned by a
/// quarter.
inline Region skylines(std::mt19937& random, int steps, bool upright) {
  const auto level = [&] { return static_cast<double>(random() % 3); };
  Ring ring;
  std::vector<double> x{0};
  for (int i = 0; i < steps; ++i) x.push_back(x.back() + 2 + 2 * static_cast<double>(random() % 3));
  const auto step = [&](double at, double from, double to) {
    if (from == to) return;
    ring.push_back({at, from});
    ring.push_back({at, to});
  };
  double low = level(), first = low;
  for (int i = 1; i < steps; ++i) {
    const double next = level();
    step(x[i] + 1, low, next);  // no edge of one skyline runs against one of the other on the same line
    low = next;
  }
  double high = 4 + level();
  step(x[steps], low, high);
  for (int i = steps - 1; i > 0; --i) {
    const double next = 4 + level();
    step(x[i], high, next);
    high = next;
  }
  step(0, high, first);
  if (upright)
    for (Point& p : ring) p = {-p.y, p.x};
  RegionData data;
  data.parts.push_back({std::move(ring), {}});
  return Region::create(std::move(data)).value();
}

/// Bars of equal width on one side of a beam, at the given places.
inline Region comb(const std::vector<double>& bars, double length, bool upright) {
  Ring ring{{-2, -2}, {bars.back() + 4, -2}, {bars.back() + 4, 0}};
  for (std::size_t i = bars.size(); i-- > 0;)
    ring.insert(ring.end(), {{bars[i] + 1, 0}, {bars[i] + 1, length}, {bars[i], length}, {bars[i], 0}});
  ring.push_back({-2, 0});
  if (upright)
    for (Point& p : ring) p = {-p.y, p.x};
  RegionData data;
  data.parts.push_back({std::move(ring), {}});
  return Region::create(std::move(data)).value();
}

}  // namespace dymsum::scaling_tests
