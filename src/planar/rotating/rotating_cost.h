// What frames of a rotating sum cost by what they looked at, in about microseconds: unlike time it is the same in every
// run, so that every run makes the same choices. Fitted to frames and slices of the pairs of `./run bench cspace` and
// of random shapes.
#pragma once

#include "dymsum/frames.h"
#include "planar/turning/rotating_window.h"

namespace dymsum::planar {

inline double cost_of(double each, std::uint64_t n) { return each * static_cast<double>(n); }

/// Of operands with so many vertices together.
inline double cost_of_slice(const SumStats& s, std::size_t vertices) {
  return 2 + cost_of(0.08, vertices) + cost_of(0.03, s.reduced_segments) + cost_of(0.135, s.crossings) +
         cost_of(0.0025, s.pair_tests) + cost_of(1.5, s.collision_tests);
}

/// Of two pieces whose boxes meet, when a window is built.
inline constexpr double kCostOfPair = 0.03;

inline double cost_of_window(const RotatingWindow& w) {
  return 12 + cost_of(0.011, w.all_segments) + cost_of(0.084, w.pieces.size()) + cost_of(kCostOfPair, w.pair_tests) +
         cost_of(0.0055, w.cells);
}

/// `slice`: a frame from scratch.
inline double cost_of_frame(const FrameWork& work, const PlanarSum& sum, double slice) {
  return 1 + cost_of(0.04, sum.vertex_count()) + cost_of(0.004, work.pieces) + cost_of(0.005, work.candidates) +
         cost_of(0.05, sum.stats.crossings) + (work.exact_signs > 0 ? 0.5 * slice : 0) +
         cost_of(0.05 * slice, work.collision_tests);
}

}  // namespace dymsum::planar
