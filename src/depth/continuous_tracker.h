// What is known of a sum's boundary near a position, and the last answer there.
#pragma once

#include <memory>
#include <optional>

#include "depth/continuous_surface.h"
#include "dymsum/continuous_depth.h"

namespace dymsum::depth {

// Normals of a sum's boundary, averaged over a distance: a vector field that does not depend on how the boundary is
// cut.

/// The integral of the outward normals over the surface, weighted by (l^2 - r^2)^2 where r < l, at any position x, and
/// its derivative: row k holds the derivatives of component k.
///
/// By the divergence theorem it is minus the gradient of the volume of the solid around x, weighted by the same kernel:
/// it depends on the solid alone, and twice continuously differentiable on x off its edges, once everywhere.
struct SmoothedNormal {
  Vec3 value;
  spatial::Mat3 derivative{};
};
/// The smoothed normal in closed form, up to rounding. Requires the whole surface within l of x. O(n).
SmoothedNormal smoothed_normal(const ContinuousSurface& surface, double l, Vec3 x);

// Positions x of a surface with x - h n(x) = from: found from a first guess, and followed.

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

/// Lengths inside are times `scale`, a power of two.
struct ContinuousPosition {
  std::shared_ptr<const SpatialSum> boundary;  ///< exactly
  ContinuousSurface surface;                   ///< the same in doubles
  WitnessSolids solids;
  Vec3 centre;              ///< of the box that the surface was cut to
  double reach = 0;         ///< half of its side; infinite where the box holds the whole sum
  double size = 0;          ///< of the coordinates
  bool all_inside = false;  ///< nothing bounds the sum in the box, which lies in it
};

class ContinuousTracker {
 public:
  struct Limits {
    double scale = 1, smoothing = 0, inflation = 2;
    int halvings = 5;
  };

  ContinuousTracker() = default;
  explicit ContinuousTracker(const Limits& limits) : limits_(limits) {}

  /// How far the surface has to be known around a position at this distance from the boundary.
  double wanted(double distance) const { return limits_.inflation * distance + limits_.smoothing; }
  bool covers(Vec3 from, double distance) const;
  /// The surface changes; the last answer is carried over to its nearest position.
  void move_to(std::shared_ptr<const ContinuousPosition> position);
  /// The branch ends, for this reason.
  void drop(Discontinuity why);
  bool is_tracking() const { return foot_.has_value(); }

  /// The answer at a position and `near` it. Follows the last one: across `moved` of the sum's boundary since, where
  /// that is not by translation. False, and nothing changed, where the next answer does not provably follow and `must`
  /// is not set.
  bool answer(Vec3 from, const SurfaceDistance& near, double turned_by, bool must, ContinuousContact& result);

  const ContinuousPosition* position() const { return position_.get(); }
  const Limits& limits() const { return limits_; }
  Vec3 scaled(const Point3& v) const { return {limits_.scale * v.x, limits_.scale * v.y, limits_.scale * v.z}; }
  Point3 unscaled(Vec3 v) const { return {v.x / limits_.scale, v.y / limits_.scale, v.z / limits_.scale}; }
  double error() const { return position_->size * 0x1p-46; }

 private:
  /// Whether the answer goes on from the last one. The second: nothing, and nothing changed, where it does not and need
  /// not.
  bool follow_shortest(Vec3 from, const SurfacePoint& nearest, double turned_by);
  std::optional<bool> follow_or_search(Vec3 from, const SurfacePoint& nearest, double turned_by, bool must,
                                       WalkWork& work);
  bool follow_last(Vec3 from, double turned_by, WalkWork& work);
  void search(Vec3 from, double distance, WalkWork& work);
  bool follows_shortest(Vec3 from, const SurfacePoint& nearest, double turned_by) const;
  void report(Vec3 from, const SurfaceDistance& near, ContinuousContact& result) const;

  Limits limits_;
  std::shared_ptr<const ContinuousPosition> position_;
  std::optional<NormalFoot> foot_;  ///< of the last place, on this surface
  NormalFoot before_;               ///< the same as it was found, on the surface then
  Vec3 last_;
  bool falls_back_ = false;  ///< the last answer was the shortest way out, for want of a smoothed one
  std::uint64_t branch_ = 0;
  Discontinuity why_ = Discontinuity::entered;
};

}  // namespace dymsum::depth
