// The pairs of regions of the benchmarks in which one operand moves.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coordinate_kinds.h"
#include "dymsum/region.h"

namespace dymsum::bench {

struct ScalingPair {
  std::string name;
  Region p, q;
  bool q_scales = false;
};

/// Which pairs are measured.
using Wanted = std::function<bool(const ScalingPair&)>;

/// Coordinates as files and generators give them, or integers of at most 22 bits on one grid for both operands: then
/// scales with few bits give doubles again, and everyone computes the same.
enum class Snapping { raw, snapped };

/// The pairs of the frame table, snapped; those of the thesis need its polygons in `data`.
std::vector<ScalingPair> frame_pairs(const std::string& data);
/// dog, G1, G2, G3, G4 against each other, snapped: table 6.1, with shapes of the same vertex counts.
std::vector<ScalingPair> table_pairs();
/// The pairs of the sweeps. P moves.
std::vector<ScalingPair> sweep_pairs(const std::string& data, Snapping snapping);

/// The same pairs in coordinates of a kind; what rounding spoils is left out, with a note.
std::vector<ScalingPair> with_coordinates(std::vector<ScalingPair> pairs, Kind kind, std::vector<std::string>& notes);

}  // namespace dymsum::bench
