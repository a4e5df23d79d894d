// The obstacle of all orientations of a pair: time, work, and its slabs against whole slices.
#pragma once

#include <cstdint>
#include <string>

#include "cspace/turning_pairs.h"
#include "dymsum/cspace_obstacle.h"
#include "versus/rival.h"

namespace dymsum::bench {

struct ObstacleRow {
  std::string name, shapes;
  Times cpu, wall;  ///< of the same runs; several threads work at once
  ObstacleWork work;
  std::size_t angles = 0, patches = 0, shells = 0, cells = 0;
  std::size_t slabs_compared = 0, slabs_different = 0;
  PrintedObstacle thesis;
};

/// Builds the obstacle once, and on until `most` times or `budget_ms`.
ObstacleRow measure_obstacle(const TurningPair& pair, int most, double budget_ms);

/// Compares `count` random slabs, all where there are fewer, with slices of the static engine inside them: the contacts
/// of all loops in their order. Fills the counts of the row.
void compare_slabs(const CspaceObstacle& obstacle, std::size_t count, std::uint64_t seed, ObstacleRow& row);

}  // namespace dymsum::bench
