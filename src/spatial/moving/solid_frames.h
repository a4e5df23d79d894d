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
  /// Whether a move is too long for the certificates of the convolution to serve.
  bool is_long(const PosePair& from, const PosePair& to) const {
    return convolution_.motion(from, to) > convolution_.longest_step();
  }

 private:
  ReducedConvolution outer_facets();

  const SolidPair& pair_;
  const SpatialOptions& options_;
  DynamicConvolution convolution_;
  InnerFacets inner_;
};

}  // namespace dymsum::spatial
