// Fast questions to the obstacle of a robot that translates and rotates: whether a configuration is free, at which
// angles a position is, and how far a configuration is from the boundary.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/motion.h"

namespace dymsum {

/// The distance of a configuration to the boundary of the obstacle: to the nearest contact, and from inside to the
/// nearest position that is free.
struct Clearance {
  double distance = 0;  ///< negative inside the obstacle: then its absolute value is the generalised penetration depth
  double error = 0;     ///< proved: the exact distance differs by at most this; 0 at a contact
  /// the index of a patch on which the nearest point lies; kNone where that is a tight placement
  std::uint32_t patch = Patch::kNone;
  Configuration nearest;  ///< a point of the boundary, rounded, at most `error` farther than the nearest one
};

/// Angles at which the robot can stand at a position, from `begin` counter-clockwise to `end`, which is less than
/// `begin` where they pass pi. Each exact end lies within `error` of its double; beyond it the robot would overlap at
/// the contact of the patch, which is kNone where none decides. The whole circle has begin = -pi, end = pi and no
/// patches. A single angle, and nothing else, has begin = end: turned either way, however little, the robot overlaps
/// there.
struct FreeAngles {
  double begin = 0, end = 0;
  double begin_error = 0, end_error = 0;
  std::uint32_t begin_patch = Patch::kNone, end_patch = Patch::kNone;
  bool single() const { return begin == end; }
};

/// An index over the patches of an obstacle, which has to outlive it. Its members are thread-safe. For n patches: O(n)
/// memory and O(n log n) time to build, with factors that depend on how many cells of the index a patch passes through.
class ObstacleQueries {
 public:
  explicit ObstacleQueries(const CspaceObstacle& obstacle);
  ObstacleQueries(ObstacleQueries&&) noexcept;
  ObstacleQueries& operator=(ObstacleQueries&&) noexcept;
  ~ObstacleQueries();

  /// Whether the robot overlaps the obstacle; touching is free, as are positions that are not finite. Exact: x and y at
  /// face value, the angle being exactly Orientation::nearest(theta). Doubles decide away from the boundary and from
  /// event angles, CspaceObstacle::contains elsewhere. Requires: a finite theta (else std::invalid_argument).
  bool contains(const Configuration& at) const;
  bool contains(double x, double y, const Orientation& theta) const;
  /// The same for many, in parallel; 1 for contained. 0 threads: as many as there are cores.
  std::vector<std::uint8_t> contains(std::span<const Configuration> at, int threads = 0) const;
  /// How many of all questions so far the exact test has answered.
  std::uint64_t exact_answers() const;

  /// The angles at which the robot can stand at (x, y), touching allowed, ascending by `begin`: all of them, single
  /// angles and the shortest intervals too, at event angles and between them. Ends err by about 2^-40 where a patch
  /// crosses the position, by some units in the last place where more happens there. O(n) for n patches, and there, as
  /// where the position is beside tight placements, O(NM) filtered pairs of vertices and edges of robot and obstacle.
  /// Requires: a finite position (else std::invalid_argument).
  std::vector<FreeAngles> free_angles(double x, double y) const;

  /// The signed distance in the metric dx^2 + dy^2 + weight^2 dtheta^2, dtheta being the angle between two
  /// orientations, in [0, pi], to the boundary of the obstacle.
  /// Touching allowed: the obstacle is open, its boundary all placements that touch without overlap: patches and tight
  /// placements (CspaceObstacle::tight), at which the robot is jammed, or slides but cannot leave. From a free
  /// configuration it is the distance to the nearest contact, 0 at any contact, jammed ones included; from inside,
  /// minus the distance to the nearest free placement, which may be a tight one. Touching forbidden: the obstacle is
  /// closed and holds its contacts. From inside, or from a contact, it is minus the distance to placements with
  /// clearance, however small: 0 on patches, and of a jammed robot how far it has to go to be loose. Elsewhere it is
  /// the same as above. A global minimum by branch and bound over all patches and tight features, within an error that
  /// is stated with it, mostly 1e-9 of the distance or 1e-11 of the size of the obstacle. Bounds hold with all
  /// roundings (docs/design/obstacle-queries.md). The sign is exact; contacts, and only they, have both distance and
  /// error 0. `weight`, a length per radian, is not negative. Infinite: only translations count, within the slice of
  /// exactly this angle, with the tight placements of an event angle at that angle only. Of curves of tight placements,
  /// which exist only where three contacts stay at one point at every angle, the depth counts what lies at event
  /// angles, with an infinite weight all; clearances count all. Microseconds; at a contact, and for an infinite weight
  /// at event angles, a whole slice. Requires: finite arguments, and a weight that is not
  /// negative and, if finite, at most largest_weight() (else std::invalid_argument). Source: Behar 2016, section 4.4.2,
  /// which samples instead.
  Clearance clearance(const Configuration& from, double weight, Touching touching = Touching::allowed) const;
  /// 2^40 times the extent of the obstacle: beyond, an angle in doubles says nothing about a distance.
  double largest_weight() const;
  /// The clearance with the robot's radius of gyration about the reference point.
  Clearance clearance(const Configuration& from) const { return clearance(from, gyration_radius()); }
  /// The root of the mean square distance of the robot's points, those of a segment too, from the origin of its
  /// coordinates.
  double gyration_radius() const;
  /// How many bounds of intervals of patches all clearances so far have evaluated.
  std::uint64_t bounds_evaluated() const;

  std::size_t bytes() const;  ///< of the index, about

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
