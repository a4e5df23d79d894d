// Is there a motion of a polygonal robot from one configuration to another, and which? Answered from the whole exact
// configuration-space obstacle: "none" is a proof, with what separates the two, and a path is free in every point.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/motion.h"

namespace dymsum {

/// A point of a path, and how it is reached: by one straight translation or one rotation in place.
struct Waypoint {
  enum class Move : std::uint8_t { start, translation, counter_clockwise, clockwise };
  Move move = Move::start;
  RationalPoint at;   ///< exactly
  Orientation theta;  ///< exactly
  Configuration approx;
};

/// A connected component of free space, touching not counted as a connection.
struct FreeComponent {
  std::uint32_t number = 0;        ///< FreeCell::component
  bool unbounded = false;          ///< it reaches infinity
  bool all_angles = false;         ///< it has configurations of every angle
  double from = 0, to = 0;         ///< else the interval of its angles, counter-clockwise
  std::vector<std::uint32_t> shells;  ///< that bound it
};

/// Why there is no path.
struct NoPath {
  enum class Kind : std::uint8_t {
    start_not_free,  ///< the start overlaps the obstacle, or touches it where that is forbidden
    goal_not_free,
    separated,  ///< they lie in different components
    undecided,  ///< the components are joined, but no path was found within the limits of the search
  };
  Kind kind = Kind::separated;
  std::string text;                              ///< one sentence
  std::optional<Contact> contact;                ///< where start or goal touches
  /// the components around them; several where touching joins them, none in a tight place
  std::vector<FreeComponent> start, goal;
  /// events at irrational angles, at which nothing is passed by touching alone
  std::uint32_t unexamined_angles = 0;
};

struct PlanWork {
  std::uint64_t levels = 0, slices = 0, rotations = 0, rounds = 0;
  double ms = 0;
};

struct Plan {
  std::vector<Waypoint> path;    ///< from start to goal; empty when there is none
  std::optional<NoPath> reason;  ///< exactly when there is none
  PlanWork work;
  bool found() const { return !reason; }
};

struct PlanOptions {
  Touching touching = Touching::allowed;
  std::uint32_t most_rounds = 48;  ///< of refinement
  Progress progress;
};

/// A path from start to goal, or why there is none. x and y are taken at face value, theta as Orientation::nearest.
/// Touching forbidden: complete. Two places are joined exactly if FreeCell::component is the same; a path in it has
/// some distance from the obstacle, so that finitely many orientations suffice, which are added round by round until it
/// is found.
/// Touching allowed: joins further what touches at event angles with a rational tangent of the half angle; passages
/// that are open at one irrational angle alone are not examined, and not counted on.
/// Every translation and rotation of a path is free by check_translation and check_rotation.
/// Errors: bad_rotation and not_finite for configurations that are not finite; unsupported_operand for coordinates
/// beyond 2^400; cancelled.
/// Cost: a slice and a graph of it per event angle on the way, O(n (n + k)) each for n edges and k of them over one
/// place, and O(NM) filtered signs per rotation tried, N and M being the sizes of robot and obstacle.
Result<Plan> plan(const CspaceObstacle& obstacle, const Configuration& start, const Configuration& goal,
                  const PlanOptions& options = {});

}  // namespace dymsum
