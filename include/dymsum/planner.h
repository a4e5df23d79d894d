// Is there a motion of a polygonal robot from one configuration to another, and which? Answered from the whole exact
// configuration-space obstacle: "none" is a proof, with what separates the two, and a path is free in every point.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/motion.h"
#include "dymsum/names.h"

namespace dymsum {

/// A point of a path, and how it is reached: by one straight translation or one rotation in place.
struct Waypoint {
  enum class Move : std::uint8_t { start, translation, counter_clockwise, clockwise };
  Move move = Move::start;
  RationalPoint at;   ///< exactly
  Orientation theta;  ///< exactly
  Configuration approx;
};

/// A configuration of numbers that doubles may not hold.
struct ExactConfiguration {
  RationalPoint at;
  Orientation theta;
};

/// A connected component of free space, touching not counted as a connection.
struct FreeComponent {
  std::uint32_t index = 0;            ///< FreeCell::component
  bool unbounded = false;             ///< it reaches infinity
  bool all_angles = false;            ///< it has configurations of every angle
  double from = 0, to = 0;            ///< else the interval of its angles, counter-clockwise
  std::vector<std::uint32_t> shells;  ///< that bound it
};

/// What a search that did not decide was limited by, and where it stood.
struct SearchLimit {
  /// Else nothing was left to try: what joins the components is touched in one point or curve, which no translations
  /// and rotations in place follow.
  bool out_of_time = true;
  double seconds = 0;  ///< the time limit
  /// The passage nearest to the goal that was not crossed, if one is known: between two angles in radians,
  /// counter-clockwise, a position (x, y) that was reached at one of them, and one at the other that was not.
  struct Passage {
    double from = 0, to = 0;
    Point reached, beyond;
  };
  std::optional<Passage> passage;
};

/// Why there is no path.
struct NoPath {
  enum class Kind : std::uint8_t {
    start_not_free,  ///< the start overlaps the obstacle, or touches it where that is forbidden
    goal_not_free,
    separated,  ///< they lie in different components
    undecided,  ///< the components are joined, but no path was found: `limit` says how far the search came
  };
  Kind kind = Kind::separated;
  std::string text;                ///< one sentence
  std::optional<Contact> contact;  ///< where start or goal touches
  /// the components around them; several where touching joins them, none at a tight placement
  std::vector<FreeComponent> start, goal;
  std::optional<SearchLimit> limit;  ///< exactly when it is undecided
  /// events at irrational angles, at which nothing is passed by touching alone
  std::uint32_t unexamined_angles = 0;
};

struct PlanWork {
  std::uint64_t levels = 0, slices = 0, rotations = 0;
  std::uint64_t refinements = 0;  ///< how often levels were put between two that are neighbours
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
  /// `undecided` after that. The steps between two looks at the clock, a slice or a way in one, are finished; infinity
  /// is allowed.
  double time_limit_seconds = 60;
  /// The number of bytes, nearly, that of slices are kept for when they are looked at again; the others are computed
  /// again. Not less than the few that one step looks at.
  std::uint64_t slice_bytes = std::uint64_t{1} << 28;
  Progress progress;
  /// Bytes that the search may hold at a time in arrays which grow faster than the operands, the slices that are kept
  /// included; each counts before it is made. Past it: out_of_memory. 0: no limit.
  std::uint64_t memory = 0;
};

/// The answer where slices at the two angles tell it, without the obstacle of all angles: start or goal is not free, or
/// translations before or after one rotation in place, at the start or at the goal, lead from one to the other. Nothing
/// where they do not decide. `plan` answers the same there. Errors: as plan and CspaceObstacle::create. Cost: at most
/// two slices, a graph of each, and O(NM) filtered signs.
Result<std::optional<Plan>> direct_plan(const Region& robot, const Region& obstacle, const Configuration& start,
                                        const Configuration& goal, const PlanOptions& options = {});
Result<std::optional<Plan>> direct_plan(const Region& robot, const Region& obstacle, const ExactConfiguration& start,
                                        const ExactConfiguration& goal, const PlanOptions& options = {});

/// A path from start to goal, or why there is none. x and y are taken at face value, theta as Orientation::nearest.
/// Touching forbidden: complete, given the time. Two configurations are joined exactly if FreeCell::component is the
/// same; a path in it has some distance from the obstacle, so that finitely many orientations suffice. They are added
/// where the passage is, until the path is found (docs/design/motion-planning.md has the proof). Touching allowed:
/// joins further what touches at event angles with a rational tangent of the half angle; passages that are open at one
/// irrational angle alone are not examined, and not counted on. A passage that can only be followed along a curve,
/// touching all the way, may stay undecided. Every translation and rotation of a path is free by check_translation and
/// check_rotation. Errors: bad_rotation and not_finite for configurations that are not finite; out_of_range for a time
/// limit that is no number or negative; unsupported_operand for coordinates beyond 2^400; out_of_memory past
/// PlanOptions::memory; cancelled. Cost: a slice and a graph of it per event angle on the way, O(n (n + k)) each for n
/// edges and k of them over one position, and O(NM) filtered signs per rotation tried, N and M being the sizes of robot
/// and obstacle.
Result<Plan> plan(const CspaceObstacle& obstacle, const Configuration& start, const Configuration& goal,
                  const PlanOptions& options = {});
Result<Plan> plan(const CspaceObstacle& obstacle, const ExactConfiguration& start, const ExactConfiguration& goal,
                  const PlanOptions& options = {});

}  // namespace dymsum
