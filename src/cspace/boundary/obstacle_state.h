// What a CspaceObstacle holds.
#pragma once

#include <utility>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "planar/motion/operand_pair.h"
#include "planar/motion/orientation.h"

namespace dymsum {

class CspaceObstacle::State {
 public:
  Region robot, obstacle;
  std::shared_ptr<const planar::OperandPair>
      base;  ///< operand 0: the obstacle; operand 1: the reflected robot, which turns
  std::vector<EventAngle> angles;
  std::vector<planar::ExactAngle> exact_angles;  ///< of `angles`
  std::vector<ObstacleEvent> events;
  std::vector<TightFeature> tight;
  bool always_concurrent =
      false;  ///< three contacts stay at one point at every angle: there may be curves of tight placements
  std::vector<Patch> patches;
  std::vector<Shell> shells;
  std::vector<FreeCell> cells;
  /// The free cell of each patch on its right from that slab of its interval on; the first entry is for the slab it
  /// begins in.
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> patch_cells;
  std::vector<std::pair<std::uint32_t, std::uint32_t>>
      touching_cells;  ///< that touch at an event angle and are not connected there
  ObstacleWork work;

  static CspaceObstacle finish(std::unique_ptr<State> state) { return CspaceObstacle(std::move(state)); }
};

}  // namespace dymsum

namespace dymsum::planar {

/// What the rooms behind the obstacle may read of it.
struct ObstacleInternals {
  using State = CspaceObstacle::State;
  static const CspaceObstacle::State& of(const CspaceObstacle& obstacle) { return *obstacle.state_; }
};
using ObstacleState = ObstacleInternals::State;

}  // namespace dymsum::planar
