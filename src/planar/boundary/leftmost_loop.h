// The outer boundary among loops, by how far left they reach.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dymsum::planar {

/// The one of n loops that do not turn clockwise that provably reaches farthest left, or n where doubles do not decide:
/// of a connected sum its outer boundary. for_each_end(i, f) calls f(x, error) for the vertices of loop i.
template <class Clockwise, class ForEachEnd>
std::size_t leftmost_loop(std::size_t n, const Clockwise& clockwise, const ForEachEnd& for_each_end) {
  // The least x of loop i lies within 2 error of low, the difference x - e errs by a rounding of x, which positions err
  // by, too, and the difference below by as much.
  constexpr double kApart = 4;
  double best = INFINITY, second = INFINITY, error = 0;
  std::size_t leftmost = n;
  for (std::size_t i = 0; i < n; ++i) {
    if (clockwise(i)) continue;
    double low = INFINITY;
    for_each_end(i, [&](double x, double e) {
      low = std::min(low, x - e);
      error = std::max(error, e);
    });
    if (low < best) {
      second = best;
      best = low;
      leftmost = i;
    } else {
      second = std::min(second, low);
    }
  }
  return second - best > kApart * error ? leftmost : n;
}

}  // namespace dymsum::planar
