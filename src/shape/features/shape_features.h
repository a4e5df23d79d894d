// What ShapeFeatures holds.
#pragma once

#include <optional>
#include <vector>

#include "dymsum/shape_features.h"
#include "exact/big.h"
#include "shape/features/boundary_loops.h"
#include "shape/features/pocket.h"
#include "shape/features/tracks.h"

namespace dymsum {

struct ShapeFeatures::State {
  Region region;
  FeatureOptions options;
  shape::Complex complex;
  shape::BoundaryLoops loops;
  std::optional<shape::ChainExtremes> extremes;
  shape::Tracks tracks;
  std::vector<std::uint32_t> first_node;  ///< event -> node
  std::vector<FeatureBar> bars;
};

struct ShapeFeaturesAccess {
  static const ShapeFeatures::State& state(const ShapeFeatures& features) { return *features.state_; }
};

}  // namespace dymsum
