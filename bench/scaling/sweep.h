// A sum that follows a motion from its first frame to its last and back, beside static sums at the same positions: what
// a user waits for, windows and the making of the sum included.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dymsum/orientation.h"
#include "dymsum/scale.h"
#include "scaling/pairs.h"
#include "spread.h"

namespace dymsum::bench {

/// Times in milliseconds. One thread: processor time, of each frame the median of the rounds. Two threads: the clock
/// on the wall, all frames of all rounds.
struct SweepRow {
  std::string name, coordinates, steps;
  std::uint64_t vertices = 0;  ///< of the largest frame compared
  /// At every position: the sum from scratch at the exact position, of operands that have been summed before.
  std::vector<double> statics;
  /// At some of the positions. `fresh`: both regions made from points, with all checks, and one sum; a scaled operand's
  /// points are rounded to doubles. `rounded` (scaling only): these regions summed a second time.
  Spread fresh, rounded;
  std::vector<double> there, back;                         ///< of each frame; the first one holds the making of the sum
  std::vector<double> two_there, two_back;                 ///< with a second thread; empty where sums cannot use one
  std::uint64_t windows = 0, rebuilt = 0, degenerate = 0;  ///< frames of one round, there and back
  std::size_t compared = 0, different = 0;                 ///< frames, there and back, from the static sum: exactly
};

struct SweepPlan {
  std::string coordinates, steps;  ///< for the table
  int rounds = 3;
  double round_ms = 4000;  ///< no further round once they have taken this together
  std::size_t some = 30;   ///< frames that are compared; a third of them fresh
};

/// diag(x, y) P (+) Q.
struct ScaleXY {
  Scale x, y;
};

/// At these scales.
SweepRow measure_sweep(const ScalingPair& pair, const std::vector<ScaleXY>& scales, const SweepPlan& plan);
/// R(theta) P (+) Q at these orientations.
SweepRow measure_sweep(const ScalingPair& pair, const std::vector<Orientation>& thetas, const SweepPlan& plan);

}  // namespace dymsum::bench
