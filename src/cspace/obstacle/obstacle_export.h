// What a sweep found, as the obstacle's patches, cells, shells, angles and events.
#pragma once

#include <vector>

#include "cspace/boundary/boundary_graph.h"
#include "cspace/boundary/obstacle_state.h"
#include "planar/motion/orientation.h"

namespace dymsum::planar {

// What a sweep over a full turn finds, in its own indices: angles in the order of the turn, from -pi / 2 on.

struct SweptBoundary {
  explicit SweptBoundary(SegmentIndex segments) : graph(segments) {}

  BoundaryGraph graph;
  std::vector<ExactAngle> angles;
  std::vector<ObstacleEvent> events;
  std::vector<TightFeature> tight;
  /// Angles at which Euler numbers are determined by limits of the boundary, and then twice what surfaces gain there,
  /// each with a node of theirs.
  std::vector<std::uint32_t> limit_angles;
  std::vector<std::pair<std::uint32_t, int>> limit_halves;
  bool always_concurrent = false;  ///< of some window: CspaceObstacle::may_have_tight_curves
  ObstacleWork work;
};

/// Fills a state that has its operands and base, which may name contacts differently from the sweep's. Requires that
/// the sweep is closed.
void export_obstacle(const SweptBoundary& swept, const TurningForms& forms, planar::ObstacleState& state);

}  // namespace dymsum::planar
