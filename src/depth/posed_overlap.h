// Whether solids, of which Q is turned, overlap at exact positions.
#pragma once

#include <array>
#include <memory>

#include "dymsum/rotation.h"
#include "exact/big.h"
#include "spatial/boundary/collision.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::depth {

/// P and Q reflected, at one orientation of Q.
class PosedOverlap {
 public:
  /// The pair has to live as long. Throws std::invalid_argument where coordinates need more than 8,192 bits.
  PosedOverlap(const spatial::SolidPair& pair, const Rotation& q_turned);

  /// Whether the definition holds: the interiors of P and of Q moved to `at` meet. Exact.
  bool holds(const std::array<exact::BigRational, 3>& at);

 private:
  spatial::PosedSpace posed_;
  spatial::Collision collision_;
};

}  // namespace dymsum::depth
