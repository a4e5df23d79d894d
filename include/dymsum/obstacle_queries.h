// Fast questions to the obstacle of a robot that translates and rotates: whether a configuration is free, at which
// angles a position is, and how far a configuration is from the boundary.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "dymsum/cspace_obstacle.h"

namespace dymsum {

/// The distance of a configuration to the boundary of the obstacle.
struct Clearance {
  double distance = 0;  ///< negative inside the obstacle: then its absolute value is the generalised penetration depth
  double error = 0;     ///< proved: the exact distance differs by at most this
  std::uint32_t patch = Patch::kNone;  ///< number of a patch on which the nearest point lies
  Configuration nearest;               ///< a point of that patch, rounded, at most `error` farther than the nearest one
};

/// Angles at which the robot can stand at a position, from `begin` counter-clockwise to `end`, which is less than
/// `begin` where they pass pi. Each exact end lies within `error` of its double; beyond it the robot would overlap at
/// the contact of the patch. The whole circle has begin = -pi, end = pi and no patches.
struct FreeAngles {
  double begin = 0, end = 0;
  double begin_error = 0, end_error = 0;
  std::uint32_t begin_patch = Patch::kNone, end_patch = Patch::kNone;
};

/// An index over the patches of an obstacle, which has to outlive it. Its members are thread-safe. For n patches: O(n)
/// memory and O(n log n) time to build, with factors that depend on how many cells of the index a patch passes through.
class ObstacleQueries {
 public:
  explicit ObstacleQueries(const CspaceObstacle& obstacle);
  ObstacleQueries(ObstacleQueries&&) noexcept;
  ObstacleQueries& operator=(ObstacleQueries&&) noexcept;
  ~ObstacleQueries();

  /// Whether the robot overlaps the obstacle; touching is free. Exact: x and y at face value, the angle being exactly
  /// Orientation::nearest(theta). Doubles decide away from the boundary and from event angles, CspaceObstacle::contains
  /// elsewhere. Throws std::logic_error for a theta that is not finite.
  bool contains(const Configuration& at) const;
  bool contains(double x, double y, const Orientation& theta) const;
  /// The same for many, in parallel; 1 for contained. 0 threads: as many as there are cores.
  std::vector<std::uint8_t> contains(std::span<const Configuration> at, int threads = 0) const;
  /// How many of all questions so far the exact test has answered.
  std::uint64_t exact_answers() const;

  /// The angles at which the robot can stand at (x, y), ascending by `begin`. Free and forbidden intervals are never
  /// missed unless they are shorter than the errors of their ends, which are of the order of 2^-40 where the contact
  /// does not merely graze the position. O(n).
  std::vector<FreeAngles> free_angles(double x, double y) const;

  /// The signed distance to the boundary in the metric dx^2 + dy^2 + weight^2 dtheta^2, dtheta being the angle between
  /// two orientations, in [0, pi]: a global minimum by branch and bound over all patches, within an error that is
  /// stated with it, mostly 1e-9 of the distance or 1e-11 of the size of the obstacle. Bounds hold with all roundings
  /// (docs/design/obstacle-queries.md). The sign is exact. `weight`, a length per radian, is not negative; infinite:
  /// only translations count, and within 2^-46 radians of an event angle the slice may be that of either side. Throws
  /// std::invalid_argument for other weights and arguments that are not finite. Source: Behar 2016, section 4.4.2,
  /// which samples instead.
  Clearance clearance(const Configuration& from, double weight) const;
  /// With the robot's radius of gyration about the reference point.
  Clearance clearance(const Configuration& from) const { return clearance(from, gyration_radius()); }
  /// The root of the mean square distance of the robot's points from the origin of its coordinates.
  double gyration_radius() const;
  /// How many bounds of stretches of patches all clearances so far have evaluated.
  std::uint64_t bounds_evaluated() const;

  std::size_t bytes() const;  ///< of the index, about

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
