// Two solids at exact poses: what they are made of once and for all, and the space of their sum at a pair of poses.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "dymsum/mesh.h"
#include "dymsum/rotation.h"
#include "exact/big.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convolution/solid_operand.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/grid_positions.h"

namespace dymsum::spatial {

/// Triangles, wedges and cones stay what they are under rotations and positive scales: only positions move.
struct SolidPair {
  SolidOperand p, q;
  GridPositions p_positions, q_positions;  ///< in one unit
};
SolidPair solid_pair(const Mesh& p, const Mesh& q);

/// A pose of either operand.
struct PosePair {
  SolidPose p, q;
  friend bool operator==(const PosePair&, const PosePair&) = default;
};

/// The space of the sum at a pair of poses; positions are its own divided by `scale`.
struct PosedSpace {
  std::unique_ptr<SumSpace> space;
  exact::BigInteger scale = 1;
};
/// A height along an axis (0, 1 or 2), in the operands' own units.
struct AxisLevel {
  int axis = 0;
  double at = 0;
};
/// Behind P's vertices the space has a place for every level, whose sum with Q's first vertex lies at that height.
/// Throws std::invalid_argument where coordinates need more than 8,192 bits.
PosedSpace posed_space(const SolidPair& pair, const PosePair& poses, std::span<const AxisLevel> levels = {});
/// The same at any rational linear maps.
PosedSpace posed_space(const SolidPair& pair, ExactPose p, ExactPose q, std::span<const AxisLevel> levels = {});

/// The space at a pair of poses, made when it is first requested: most signs of a motion need none.
class SpaceOnDemand {
 public:
  SpaceOnDemand(const SolidPair& pair, const PosePair& poses) : pair_(pair), poses_(poses) {}
  const SumSpace& operator()() {
    if (!made_) made_ = posed_space(pair_, poses_);
    return *made_->space;
  }
  PosedSpace take() {
    (*this)();
    return *std::exchange(made_, std::nullopt);
  }

 private:
  const SolidPair& pair_;
  const PosePair& poses_;
  std::optional<PosedSpace> made_;
};

}  // namespace dymsum::spatial
