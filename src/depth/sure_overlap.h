// Overlap that doubles prove.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "depth/depth_operands.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::depth {

/// Whether an edge of one solid crosses a triangle of the other, told by doubles with a margin: a "no" says nothing.
class SureOverlap {
 public:
  explicit SureOverlap(const DepthOperands& o);

  /// Of P and Q at all positions within `radius` of one, in each coordinate. Pairs that crossed at the last positions
  /// are tried first, then those whose boxes overlap, some of them.
  bool holds(spatial::Vec3 at, double radius);

 private:
  bool crosses(std::uint32_t i, std::uint32_t j, spatial::Vec3 at, double radius) const;

  const DepthOperands& o_;
  spatial::BoxTree p_tree_, q_tree_;
  std::vector<std::array<std::uint32_t, 2>> witnesses_;  // the last one first
};

}  // namespace dymsum::depth
