// What frames of a scaling sum cost, in about microseconds, by what they looked at. Unlike time it is the same in every
// run and whatever else the machine does, so that every run makes the same choices. Fitted to frames of the pairs of
// `./run bench scaling`.
#pragma once

#include "dymsum/frames.h"
#include "dymsum/planar_sum.h"
#include "planar/window/rotating_window.h"
#include "planar/window/scaling_window.h"

namespace dymsum::planar {

/// A frame from scratch, or the part of a degenerate frame that goes through the static engine's arrangement.
double cost_of_sum(const PlanarSum& sum);
/// A window, without its first frame. `all`: segments of the convolution.
double cost_of_window(const Window& window, std::uint32_t all);
/// How many boxes of pieces may meet in one that costs no more.
std::uint64_t pairs_of_window(double cost, std::uint32_t all);
/// A frame inside a window.
double cost_of_frame(const FrameWork& work, const PlanarSum& sum);

// What frames of a rotating sum cost by what they looked at, in about microseconds: unlike time it is the same in every
// run, so that every run makes the same choices. Fitted to frames and slices of the pairs of `./run bench cspace` and
// of random shapes.

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
