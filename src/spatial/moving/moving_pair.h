// What follows a pair of solids from pose to pose, one sum at a time.
#pragma once

#include <optional>

#include "dymsum/convex_sum.h"
#include "spatial/moving/solid_frames.h"

namespace dymsum::spatial {

/// One error for all makers of moving sums: out_of_range, unsupported_operand.
std::optional<Error> motion_refusal(const Mesh& p, const Mesh& q, const MovingSolidOptions& options);

/// What follows: a motion, whose next pose is near as a rule, or poses of which few are near the one before.
enum class PoseOrder : std::uint8_t { motion, scattered };

class MovingPair {
 public:
  MovingPair(const Mesh& p, const Mesh& q, const MovingSolidOptions& options, PoseOrder order = PoseOrder::motion);
  MovingPair(const MovingPair&) = delete;

  /// The sum at a pair of poses, from what is kept of the frame before or from scratch. Throws as fresh_sum, Cancelled;
  /// the next frame then is made as if that one had not been requested.
  SpatialSum frame(const PosePair& to, SolidFrameWork& work);
  const PosePair& poses() const { return poses_; }
  const MovingSolidOptions& options() const { return options_; }

 private:
  SpatialSum any_frame(const PosePair& to, SolidFrameWork& work);
  bool follows(const PosePair& to);
  SpatialSum convex_frame(const PosePair& to, SolidFrameWork& work);

  MovingSolidOptions options_;
  SpatialOptions stages_;
  SolidPair pair_;
  PosePair poses_;
  PoseOrder order_;
  bool started_ = false;
  std::uint32_t near_steps_ = 0;     // in a row, of scattered poses
  std::optional<ConvexSum> convex_;  // both operands are convex
  std::optional<SolidFrames> frames_;
};

}  // namespace dymsum::spatial
