// What exact positions of a SpatialSum are made from.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

using ExactPosition = std::array<exact::BigRational, 3>;

/// Of the vertices of a sum: common points of planes in a space, or, of convex operands, the positions themselves.
struct SpatialPositions {
  std::shared_ptr<const SumSpace> space;
  std::vector<PointSource> vertices;
  std::vector<ExactPosition> listed;

  ExactPosition at(std::size_t vertex) const;
};

struct SpatialSumInternals {
  static void set_positions(SpatialSum& sum, std::shared_ptr<const SpatialPositions> positions) {
    sum.positions_ = std::move(positions);
  }
  static const SpatialPositions& positions(const SpatialSum& sum) { return *sum.positions_; }
};

}  // namespace dymsum::spatial
