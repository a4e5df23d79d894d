// A sum that follows its rotating operand against a slice from scratch at the same orientations.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cspace/turning_pairs.h"
#include "spread.h"

namespace dymsum::bench {

struct RotationRow {
  std::string name;
  int steps = 0;                ///< a turn
  Spread update_ms, static_ms;  ///< of frames
  double window_ms = 0;         ///< median of the frames that built a window
  std::uint64_t windows = 0, rebuilt = 0, degenerate = 0;
  double pieces = 0, pairs = 0, collision_tests = 0;  ///< a frame
  std::size_t compared = 0, different = 0;
  double vertices = 0;  ///< a frame
};

/// A whole turn in `steps` frames, every frame compared exactly.
RotationRow measure_rotation(const TurningPair& pair, int steps);

}  // namespace dymsum::bench
