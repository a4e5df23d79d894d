// Whether an operand that has turned overlaps the other one's reflection at a position, as doubles prove it: by an edge
// of one that crosses a triangle of the other.
#pragma once

#include "spatial/mesh/box_tree.h"
#include "spatial/motion/rotation_forms.h"

namespace dymsum::spatial {

class SureOverlap {
 public:
  /// The turning operand's vertices times `matrix`, which is within 2^-44 of the rotation.
  SureOverlap(const RotatingPair& pair, const Mat3& matrix);
  /// Whether P and x - Q overlap for all x within `radius` of `at` along each axis. A "no" says nothing.
  bool at(Vec3 at, double radius) const;

 private:
  const RotatingPair& pair_;
  std::array<std::vector<Vec3>, 2> places_;
  BoxTree p_tree_, q_tree_;
};

}  // namespace dymsum::spatial
