// What a CspaceObstacle holds, and what every one begins with.
#pragma once

#include <memory>
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

// The slabs, the ranges between neighbouring event angles, that a patch is in.

/// Slabs counted from `begin` on, round the circle.
inline std::uint32_t slabs_between(std::uint32_t begin, std::uint32_t slab, std::size_t slabs) {
  return static_cast<std::uint32_t>(slab >= begin ? slab - begin : slab + slabs - begin);
}
/// Whether a patch is there in a slab.
inline bool is_in_slab(const Patch& p, std::uint32_t slab, std::size_t slabs) {
  if (p.begin == Patch::kNone) return true;
  const std::uint32_t length = slabs_between(p.begin, p.end, slabs);
  return length == 0 || slabs_between(p.begin, slab, slabs) < length;
}

// What every obstacle begins with: its operands and their lattice.

/// A state with robot, obstacle and base, and nothing else. Errors as CspaceObstacle::create.
Result<std::unique_ptr<planar::ObstacleState>> start_obstacle(const Region& robot, const Region& obstacle);

}  // namespace dymsum::planar
