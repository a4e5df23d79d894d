// What is known of a sum's boundary near a position, and the last answer there.
#pragma once

#include <memory>
#include <optional>

#include "depth/continuous_projection.h"
#include "depth/continuous_witness.h"
#include "dymsum/continuous_depth.h"

namespace dymsum::depth {

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
