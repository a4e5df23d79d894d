// Whether solids overlap at exact positions; one for every thread.
#pragma once

#include <memory>

#include "depth/depth_operands.h"
#include "depth/exact_frame.h"
#include "depth/proved_overlap.h"
#include "spatial/boundary/collision.h"

namespace dymsum::depth {

class DepthProbe {
 public:
  explicit DepthProbe(const DepthOperands& o);

  bool overlaps(const std::array<BigRational, 3>& position);
  /// A "no" says nothing. `at` is scaled.
  bool provably_overlaps(spatial::Vec3 at, double radius);

  /// A position that is free, and a facet that it lies on, or kNoFacet.
  struct Free {
    std::array<BigRational, 3> at;
    std::uint32_t facet;
  };
  static constexpr std::uint32_t kNoFacet = 0xffffffff;

  /// What the last questions found: depth is continuous, so nearly all of what lies nearer is known to be covered, and
  /// a free position is near.
  void remember(const CoveredBall& ball, std::vector<Free> free);
  const std::vector<CoveredBall>& balls() const { return balls_; }
  const std::vector<Free>& free() const { return free_; }

 private:
  void renew();

  const DepthOperands& o_;
  ProvedOverlap proved_;
  std::unique_ptr<spatial::SumSpace> space_;
  std::unique_ptr<const spatial::Collision> collision_;
  std::size_t positions_ = 0;
  std::vector<CoveredBall> balls_;  // the last one first
  std::vector<Free> free_;
};

}  // namespace dymsum::depth
