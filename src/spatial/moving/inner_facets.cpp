#include "spatial/moving/inner_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spatial/motion/pose_angles.h"

namespace dymsum::spatial {

InnerFacets::InnerFacets(const SolidPair& pair) : own_{inner_balls(pair.p), inner_balls(pair.q)} {}

void InnerFacets::move(const PosedSpace& at, const PosePair& poses) {
  space_ = at.space.get();
  kept_ = tested_ = 0, last_ = kUnknown;
  margin_ = 8 * space_->sum_radius() + space_->span() * 0x1p-40;
  const double unit = std::ldexp(exact::round_to_double(exact::BigRational(at.scale)), -space_->line(0).unit);
  for (int op = 0; op < 2; ++op) {
    const SolidPose& pose = op == 0 ? poses.p : poses.q;
    const Mat3 turn = matrix_of(relative_rotation(Rotation(), pose.rotation));
    const Vec3 s = scale_factors(pose);
    // A scaled ball holds the ball of its least half-axis.
    const double least = unit * std::min({s.x, s.y, s.z}) * (1 - 0x1p-40);
    posed_[op].clear();
    for (const InnerBalls::Ball& ball : own_[op].balls) {
      const Vec3& m = ball.centre;
      posed_[op].push_back({unit * (turn * Vec3{s.x * m.x, s.y * m.y, s.z * m.z}), least * ball.radius});
    }
  }
  make_some();
}

/// Sums of some balls of either operand.
void InnerFacets::make_some() {
  some_ = {};
  const auto some = [](const std::vector<InnerBalls::Ball>& balls) {
    return static_cast<std::uint32_t>(std::min<std::size_t>(balls.size(), 20));
  };
  for (std::uint32_t i = 0; i < some(posed_[0]); ++i) {
    for (std::uint32_t j = 0; j < some(posed_[1]); ++j) {
      const InnerBalls::Ball &a = posed_[0][i], &b = posed_[1][j];
      const Vec3 centre = a.centre + b.centre;
      some_.x.push_back(centre.x), some_.y.push_back(centre.y), some_.z.push_back(centre.z);
      some_.radius.push_back(a.radius + b.radius), some_.pair.push_back({i, j});
    }
  }
}

/// A ball holds all of a facet with its corners.
bool InnerFacets::covers(BallPair pair, const SumFacet& facet) const {
  for (int k = 0; k < facet.corners; ++k)
    if (gap(pair, space_->approx(facet.corner[k])) > -margin_) return false;
  return true;
}

bool InnerFacets::hold(std::uint32_t slot, const SumFacet& facet) {
  if (posed_[0].empty() || posed_[1].empty()) return false;
  BallPair& pair = pairs_[slot];
  if (pair.p != kUnknown.p && covers(pair, facet)) {
    ++kept_;
    last_ = pair;
    return true;
  }
  ++tested_;
  Vec3 centre;
  for (int k = 0; k < facet.corners; ++k) centre = centre + 1.0 / facet.corners * space_->approx(facet.corner[k]);
  if (pair.p != kUnknown.p) {
    pair = descend(pair, centre);
  } else {
    // Facets come in an order in which neighbours are often near to one another.
    if (last_.p != kUnknown.p) pair = descend(last_, centre);
    if (pair.p == kUnknown.p || !covers(pair, facet)) pair = search(centre);
  }
  last_ = pair;
  return covers(pair, facet);
}

/// Searches from the best pairs of those that stand for all others.
InnerFacets::BallPair InnerFacets::search(Vec3 x) {
  constexpr std::size_t kStarts = 4;
  std::array<std::pair<double, BallPair>, kStarts> starts;
  starts.fill({std::numeric_limits<double>::infinity(), {0, 0}});
  // Balls are compared by their powers, many at a time: roots would take longer than all else.
  powers_.resize(some_.x.size());
  for (std::size_t k = 0; k < powers_.size(); ++k) {
    const double dx = x.x - some_.x[k], dy = x.y - some_.y[k], dz = x.z - some_.z[k], r = some_.radius[k];
    powers_[k] = dx * dx + dy * dy + dz * dz - r * r;
  }
  for (std::size_t k = 0; k < powers_.size(); ++k) {
    if (powers_[k] >= starts.back().first) continue;
    std::size_t at = kStarts - 1;
    for (; at > 0 && powers_[k] < starts[at - 1].first; --at) starts[at] = starts[at - 1];
    starts[at] = {powers_[k], some_.pair[k]};
  }
  BallPair best = starts[0].second;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [value, start] : starts) {
    const BallPair end = descend(start, x);
    if (const double g = gap(end, x); g < least) least = g, best = end;
  }
  return best;
}

InnerFacets::BallPair InnerFacets::descend(BallPair from, Vec3 x) const {
  BallPair best = from;
  double least = gap(best, x);
  for (bool better = true; better;) {
    better = false;
    const auto try_pair = [&](BallPair other) {
      if (const double g = gap(other, x); g < least) least = g, best = other, better = true;
    };
    const BallPair at = best;
    for (const std::uint32_t i : own_[0].neighbours[at.p]) try_pair({i, at.q});
    for (const std::uint32_t j : own_[1].neighbours[at.q]) try_pair({at.p, j});
  }
  return best;
}

}  // namespace dymsum::spatial
