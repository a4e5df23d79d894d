// Whether a motion of a polygonal robot past an obstacle is free: translations and rotations in place exactly, both at
// once by certified enclosures. The robot turns about the origin of its coordinates and is then moved, as everywhere.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/names.h"
#include "dymsum/orientation.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// Whether robot and obstacle may touch: their interiors never meet, or the closed sets never do.
enum class Touching : std::uint8_t { allowed, forbidden };

struct TranslationCheck {
  bool free = true;
  Rational first;    ///< the fraction of the way up to which it is free; 0 and `free`: all of it
  RationalPoint at;  ///< where that is; the end of a free way
  /// there, an edge and a vertex as for patches; none deep inside the obstacle, nor where points meet what has no area
  std::optional<Contact> contact;
};

/// The robot at orientation theta, moved straight from `from` to `to`. Exact. Regions with holes and several parts.
/// Errors: as cspace_slice; not_finite for doubles that are not finite.
/// Cost: one slice, and O(n) filtered signs per meeting with its n edges.
Result<TranslationCheck> check_translation(const Region& robot, const Region& obstacle, const RationalPoint& from,
                                           const RationalPoint& to, const Orientation& theta,
                                           Touching touch = Touching::allowed);
Result<TranslationCheck> check_translation(const Region& robot, const Region& obstacle, Point from, Point to,
                                           const Orientation& theta, Touching touch = Touching::allowed);

enum class TurnDirection : std::uint8_t { counter_clockwise, clockwise };

/// A closed interval of angles, counter-clockwise from begin to end, which may pass pi.
struct TurnInterval {
  EventAngle begin, end;
  Contact at_begin, at_end;  ///< what is touched there: an edge and a vertex, as for patches
};

struct RotationCheck {
  bool free = true;
  /// the first angle after which the robot overlaps (or at which it touches, where that is forbidden)
  std::optional<EventAngle> first;
  std::optional<Contact> contact;  ///< there; none where the start itself is deep inside the obstacle
  bool always = false;             ///< at no angle is there an overlap
  /// else the angles without overlap, single ones left out; by increasing begin
  std::vector<TurnInterval> free_angles;
};

/// The robot at `at`, turned in place from one orientation to the other; equal ones: not at all. Exact: every contact
/// of an edge and a vertex is at roots of a quadratic in tan(theta / 2); one orientation is tested between neighbours.
/// Errors: as check_translation. Cost: O(nm) filtered pairs, and a slice for each angle that doubles do not decide.
Result<RotationCheck> check_rotation(const Region& robot, const Region& obstacle, const RationalPoint& at,
                                     const Orientation& from, const Orientation& to, TurnDirection turn,
                                     Touching touch = Touching::allowed);
Result<RotationCheck> check_rotation(const Region& robot, const Region& obstacle, Point at, const Orientation& from,
                                     const Orientation& to, TurnDirection turn, Touching touch = Touching::allowed);

struct MotionOptions {
  double resolution = 0x1p-20;         ///< of the fraction of the way
  std::uint64_t most_poses = 1 << 20;  ///< more than this many poses are not examined: undecided
};

struct MotionCheck {
  enum class Outcome : std::uint8_t {
    free,       ///< proved: no touch either
    blocked,    ///< proved: a pose at fraction `high` overlaps
    undecided,  ///< closer to a touch between `low` and `high` than the resolution; to be treated as not free
  };
  Outcome outcome = Outcome::free;
  /// the way is proved free on [0, low); the first contact, if any, lies in [low, high]
  double low = 1, high = 1;
  std::optional<Contact> contact;  ///< the nearest edge and vertex at `low`
  std::uint64_t poses = 0;         ///< examined
};

/// x, y and theta linear in time at once, theta at face value: the way from 0 to 7 is more than a whole turn.
/// Certified: a pose with a gap larger than |d(x, y)| + min(R |d theta|, 2 R) is free up to there, R being the robot's
/// reach; whole turns of theta are taken off exactly, and on a way of more than 2^50 radians any angle may occur. An
/// overlap that exceeds all rounding errors is proved; otherwise the interval is halved. Source: Schwarzer, Saha and
/// Latombe, "Exact collision checking of robot paths" (2004). Errors: unsupported_operand as CspaceObstacle::create,
/// and for configurations beyond 2^400; not_finite; cancelled.
Result<MotionCheck> check_motion(const Region& robot, const Region& obstacle, const Configuration& a,
                                 const Configuration& b, const MotionOptions& options = {},
                                 const Progress& progress = {});

}  // namespace dymsum
