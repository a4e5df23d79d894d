// What frames of a rotating sum cost by what they looked at, in about microseconds: unlike time it is the same in every
// run, so that every run makes the same choices. Fitted to frames and slices of the pairs of `./run bench cspace` and
// of random shapes.
#pragma once

#include "dymsum/frames.h"
#include "planar/turning/rotating_window.h"

namespace dymsum::planar {

inline double cost_of(double each, std::uint64_t n) { return each * static_cast<double>(n); }

inline double cost_of_slice(const SumStats& s) {
  return 12 + cost_of(0.085, s.reduced_segments) + cost_of(0.11, s.crossings) + cost_of(0.5, s.collision_tests);
}

inline double cost_of_window(const RotatingWindow& w) {
  return 6 + cost_of(0.1, w.all_segments) + cost_of(0.1, w.pieces.size()) + cost_of(0.035, w.pair_tests);
}

/// `slice`: a frame from scratch.
inline double cost_of_frame(const FrameWork& work, const PlanarSum& sum, double slice) {
  return 1 + cost_of(0.008, sum.vertex_count()) + cost_of(0.008, work.pieces) + cost_of(0.009, work.candidates) +
         cost_of(0.025, sum.stats.crossings) + (work.exact_signs > 0 ? 0.5 * slice : 0) +
         cost_of(0.05 * slice, work.collision_tests);
}

}  // namespace dymsum::planar
