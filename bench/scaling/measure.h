// Frames of a scaling sum, measured against fresh computations of the very same sets.
#pragma once

#include <string>
#include <vector>

#include "dymsum/scaling_sum.h"
#include "scaling/pairs.h"
#include "spread.h"

namespace dymsum::bench {

struct FrameSample {
  double s = 1, ms = 0, static_ms = 0;
  std::uint64_t events = 0, crossings = 0;  ///< crossings that came or went; of the fresh computation
  bool rebuilt = false, new_window = false;
};

struct FramesRow {
  std::string name, steps;
  std::size_t p_vertices = 0, q_vertices = 0;
  std::uint64_t segments = 0, vertices = 0, holes = 0, pieces = 0, candidates = 0, bytes = 0;
  Spread frame_ms, static_ms;
  double all_pairs_ms = 0, cgal_ms = 0;  ///< on a few of the frames; 0: not measured
  std::uint64_t frames = 0, windows = 0, rebuilt = 0, degenerate = 0, compared = 0, different = 0, cgal_different = 0;
  double kept = 1;                      ///< median share of corners that the frame before had
  double update_ms = 0, window_ms = 0;  ///< medians of frames inside windows and of those that build one
  std::vector<FrameSample> samples;
};

struct FramesPlan {
  std::string steps;           ///< for the table
  std::vector<double> scales;  ///< with at most 17 significant bits
  FrameMode mode = FrameMode::automatic;
  std::size_t rival_frames = 0;  ///< frames at which all pairs and CGAL are run too
  bool cgal = true;
};

/// s <- s (1 + step), on the grid of 2^-14, from 1 on.
std::vector<double> steady_steps(double step, std::size_t frames);
/// Multiples of 0.1 in [0.1, 10], rounded to the grid; seeded.
std::vector<double> random_scales(std::size_t frames);

FramesRow measure_frames(const ScalingPair& pair, const FramesPlan& plan);

}  // namespace dymsum::bench
