// Frames of a sum of two solids of any shape: what is kept between them.
#pragma once

#include <optional>
#include <vector>

#include "spatial/moving/dynamic_convolution.h"
#include "spatial/moving/inner_window.h"
#include "spatial/moving/posed_sum.h"

namespace dymsum::spatial {

class SolidFrames {
 public:
  /// Requires operands that are not empty, without thin parts; the pair has to live as long.
  SolidFrames(const SolidPair& pair, const SpatialOptions& options);

  /// The sum at a pair of poses, after the frame at `before`. Throws as fresh_sum; what is kept then still serves.
  SpatialSum frame(const PosePair& poses, const PosePair& before, SolidFrameWork& work);
  /// Whether a move is too long for what is kept to serve.
  bool is_long(const PosePair& from, const PosePair& to) const;

 private:
  enum class Inner : std::uint8_t { unknown, yes, no };
  void keep_window(const PosePair& poses, const PosePair& before, SolidFrameWork& work);
  ReducedConvolution outer_facets(SolidFrameWork& work);

  const SolidPair& pair_;
  const SpatialOptions& options_;
  std::array<double, 2> radius_{};
  DynamicConvolution convolution_;
  std::optional<InnerWindow> window_;
  std::vector<Inner> inner_;  // per slot of the convolution, as the window says
};

}  // namespace dymsum::spatial
