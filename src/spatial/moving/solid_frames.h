// Frames of a sum of two solids of any shape: what is kept between them.
#pragma once

#include "spatial/moving/dynamic_convolution.h"
#include "spatial/moving/inner_facets.h"
#include "spatial/moving/posed_sum.h"

namespace dymsum::spatial {

class SolidFrames {
 public:
  /// Requires operands that are not empty, without thin parts; the pair has to live as long.
  SolidFrames(const SolidPair& pair, const SpatialOptions& options)
      : pair_(pair), options_(options), convolution_(pair), inner_(pair) {}

  /// The sum at a pair of poses. Throws as fresh_sum; what is kept then still serves.
  SpatialSum frame(const PosePair& poses, SolidFrameWork& work);
  /// Whether a frame had better be made from scratch: the move is too long for the certificates of the convolution to
  /// serve, or normals lie on arcs in masses, as where faces and edges stay parallel while solids scale along an axis.
  /// That is found out at a frame, and holds for some after it.
  bool had_better_not(const PosePair& from, const PosePair& to);

 private:
  ReducedConvolution outer_facets();

  const SolidPair& pair_;
  const SpatialOptions& options_;
  DynamicConvolution convolution_;
  InnerFacets inner_;
  std::uint32_t crowded_ = 0;        // frames for which that holds
  std::uint32_t without_boxes_ = 0;  // frames for which boxes do not pay
};

}  // namespace dymsum::spatial
