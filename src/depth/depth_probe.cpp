#include "depth/depth_probe.h"

#include <utility>

namespace dymsum::depth {

namespace {

/// A space keeps the positions that it was queried: it is made anew before they are many.
constexpr std::size_t kPositions = 1 << 16;
constexpr std::size_t kBalls = 4;

}  // namespace

DepthProbe::DepthProbe(const DepthOperands& o) : o_(o), proved_(o) { renew(); }

void DepthProbe::renew() {
  collision_.reset();
  space_ = spatial::make_sum_space(o_.p.vertices, o_.q.vertices);
  collision_ = std::make_unique<const spatial::Collision>(*space_, o_.p, o_.q, o_.inner.get());
  positions_ = 0;
}

bool DepthProbe::overlaps(const std::array<BigRational, 3>& position) {
  if (++positions_ > kPositions) renew();
  const std::optional<spatial::PointSource> at = space_->add_position(position);
  return at && collision_->overlaps({*at, 0, 0, 0, 0, 0});
}

void DepthProbe::remember(const CoveredBall& ball, std::vector<Free> free) {
  balls_.insert(balls_.begin(), ball);
  if (balls_.size() > kBalls) balls_.pop_back();
  free_ = std::move(free);
}

bool DepthProbe::provably_overlaps(spatial::Vec3 at, double radius) { return proved_.holds(at, radius); }

}  // namespace dymsum::depth
