// Whether solids overlap at exact positions; one for every thread.
#pragma once

#include <memory>

#include "depth/depth_operands.h"
#include "depth/exact_frame.h"
#include "depth/sure_overlap.h"
#include "spatial/boundary/collision.h"

namespace dymsum::depth {

class DepthProbe {
 public:
  explicit DepthProbe(const DepthOperands& o);

  bool overlaps(const std::array<BigRational, 3>& position);
  /// A "no" says nothing. `at` is scaled.
  bool surely_overlaps(spatial::Vec3 at, double radius);

 private:
  void renew();

  const DepthOperands& o_;
  SureOverlap sure_;
  std::unique_ptr<spatial::SumSpace> space_;
  std::unique_ptr<const spatial::Collision> collision_;
  std::size_t places_ = 0;
};

}  // namespace dymsum::depth
