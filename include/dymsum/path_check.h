// Whether a whole path is free, piece by piece, and the first piece that is not.
#pragma once

#include <cstddef>
#include <span>

#include "dymsum/motion.h"
#include "dymsum/planner.h"
#include "dymsum/progress.h"

namespace dymsum {

struct PathCheck {
  /// undecided: a piece that moves and turns at once comes closer to a touch than the resolution
  MotionCheck::Outcome outcome = MotionCheck::Outcome::free;
  /// The index of the first piece that is not free, which leads from the pose of that index to the next one; of a free
  /// path that of the last one.
  std::size_t piece = 0;
  bool moves = false, turns = false;  ///< that piece translates; it rotates
  /// The fractions of the piece between which the first contact lies, in doubles; equal up to rounding where exact.
  double low = 1, high = 1;
  Configuration at;                ///< at `low`
  std::optional<Contact> contact;  ///< there, as for patches
  std::size_t pieces = 0;          ///< examined
};

/// Each piece by the move of its end, exactly: by check_translation or check_rotation. Errors: malformed, with the
/// index in the sentence, for a translation that turns and a rotation that moves, a start that is not the first, and
/// for an empty path; cancelled, which progress is asked for before each piece; as these checks.
Result<PathCheck> check_path(const Region& robot, const Region& obstacle, std::span<const Waypoint> path,
                             Touching touch = Touching::allowed, const Progress& progress = {});

/// A pose whose position doubles may not hold.
struct ExactPose {
  RationalPoint at;
  double theta = 0;
};

/// Checks the motion from each pose to the next, x, y and theta linear in time: exactly where it is a translation, or a
/// rotation in place the way theta says at face value (with Orientation::nearest at both ends), by check_motion where
/// it is both. Errors: malformed for an empty path; cancelled, as above; as these checks.
Result<PathCheck> check_path(const Region& robot, const Region& obstacle, std::span<const Configuration> poses,
                             Touching touch = Touching::allowed, const MotionOptions& options = {},
                             const Progress& progress = {});

/// The same. A piece that moves and turns at once is examined in doubles: unsupported_operand, with the index in the
/// sentence, where its positions are none.
Result<PathCheck> check_path(const Region& robot, const Region& obstacle, std::span<const ExactPose> poses,
                             Touching touch = Touching::allowed, const MotionOptions& options = {},
                             const Progress& progress = {});

}  // namespace dymsum
