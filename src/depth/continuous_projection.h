// Positions x of a surface with x - h n(x) = from: found from a first guess, and followed.
#pragma once

#include "depth/continuous_normals.h"

namespace dymsum::depth {

/// The most that a direction rotates in a step that is believed, in radians.
inline constexpr double kMostTurn = 0.25;
/// A turn that is believed without a look at its rate.
inline constexpr double kSmallTurn = 0x1p-5;

/// A way out along the smoothed normal n at x, a position of a face; h >= 0 but for rounding.
struct NormalFoot {
  std::uint32_t face = kNoEdge;
  Vec3 x, n;
  double h = 0;
  Vec3 gradient;          ///< of h, by `from`
  double turn_rate = 0;   ///< an upper bound of the turn of n for a unit of `from`
  double residual = 0;    ///< |from - (x - h n)|
  SmoothedNormal normal;  ///< at x, where it is known
  bool is_known = false;
};

enum class WalkEnd : std::uint8_t {
  arrived,
  folded,  ///< the equation is singular, or turned over, on the way: no branch goes on from there
  lost,    ///< the end of the surface
  stuck,   ///< too many steps
};

/// What a walk costs.
struct WalkWork {
  std::uint64_t steps = 0, normals = 0;
};

/// Newton's method from `foot` (face, x and h) on, across the edges of faces, in steps of at most l / 4. Off edges
/// quadratic.
WalkEnd walk_to(const ContinuousSurface& surface, double l, Vec3 from, NormalFoot& foot, WalkWork& work);

/// A foot of `from` on the branch of `foot`, which was one of `last`: straight from one position to the other, in steps
/// so short that x does not go much further than its derivative says and n turns little; `halvings` times halved.
WalkEnd follow(const ContinuousSurface& surface, double l, Vec3 last, Vec3 from, int halvings, NormalFoot& foot,
               WalkWork& work);

/// Whether `next` provably lies on the branch of `last`, whose position was at most `moved` away.
bool goes_on(const NormalFoot& last, const NormalFoot& next, double moved, double l);

/// The one with the least h of those that walks from the local minima of the distance reach, no longer than `reach`.
/// None: face is kNoEdge.
NormalFoot shortest_foot(const ContinuousSurface& surface, double l, Vec3 from, double reach, WalkWork& work);

}  // namespace dymsum::depth
