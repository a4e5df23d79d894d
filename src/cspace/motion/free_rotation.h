// The robot at one position, turning: the angles at which it may stand there, single ones included. Exact.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cspace/motion/pivot.h"

namespace dymsum::planar {

class FreeRotation {
 public:
  /// Requires: an obstacle that lives as long as this.
  FreeRotation(const CspaceObstacle& obstacle, Point at);

  /// The marks are those of CspaceObstacle::turn_marks, the angles those of Pivot; between two of them one orientation
  /// decides what is free, at one with overlaps on both sides free_position does.
  std::vector<TurnMark> marks();
  std::vector<TurnMark> marks(const Orientation& from, const Orientation& to);

 private:
  bool is_free(const Orientation& theta) const { return !obstacle_.contains(at_.x, at_.y, theta); }
  bool is_free_at(const ExactAngle& angle);

  const CspaceObstacle& obstacle_;
  Point at_;
  Pivot pivot_;
  std::shared_ptr<const OperandPair>
      base_;  // with the position as a pair of further vertices; made when first requested
  std::optional<TurningForms> forms_;
};

}  // namespace dymsum::planar
