// The box around exact positions of which doubles are known to be near.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace dymsum::python {

/// [lowest x, y, (z,) highest x, y, (z)] of positions, each the nearest double to the exact one; zeros for none.
/// each(add) calls add(near, exact) for every position: `near` are its doubles, within `error` in each coordinate, and
/// exact(k) is the nearest double to coordinate k, which is requested those alone that may be outermost.
template <std::size_t K, class Each>
std::array<double, 2 * K> extent_of(double error, Each&& each) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  std::array<double, 2 * K> near, box{};
  std::fill_n(near.begin(), K, kInfinite);
  std::fill_n(near.begin() + K, K, -kInfinite);
  each([&](const std::array<double, K>& at, auto&&) {
    for (std::size_t k = 0; k < K; ++k) near[k] = std::min(near[k], at[k]), near[K + k] = std::max(near[K + k], at[k]);
  });
  if (near[0] > near[K]) return box;
  box = {};
  for (std::size_t k = 0; k < K; ++k) box[k] = kInfinite, box[K + k] = -kInfinite;
  each([&](const std::array<double, K>& at, auto&& exact) {
    for (std::size_t k = 0; k < K; ++k) {
      const bool low = at[k] <= near[k] + 2 * error, high = at[k] >= near[K + k] - 2 * error;
      if (!low && !high) continue;
      const double x = exact(k);
      box[k] = std::min(box[k], x), box[K + k] = std::max(box[K + k], x);
    }
  });
  return box;
}

}  // namespace dymsum::python
