#include "cspace/sampled_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace dymsum::bench {
namespace {

constexpr double kPi = std::numbers::pi;

double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

}  // namespace

SampledDepth::SampledDepth(const CspaceObstacle& obstacle, const ObstacleQueries& exact, double weight,
                           const std::vector<Configuration>& samples)
    : obstacle_(obstacle), weight_(weight), samples_(samples) {
  // Samples know patches, not what is tight.
  for (const Configuration& s : samples_) nearest_.push_back(exact.clearance(s, weight, Touching::forbidden).patch);
}

double SampledDepth::square(const Patch& patch, const Configuration& from, double fraction, double theta) const {
  const auto [a, b] = obstacle_.ends(patch, theta);
  const double x = a.x + fraction * (b.x - a.x) - from.x, y = a.y + fraction * (b.y - a.y) - from.y;
  const double turn = weight_ * wrapped(theta - from.theta);
  return x * x + y * y + turn * turn;
}

// Steps of changing size against the gradient, by differences, kept within the patch.
double SampledDepth::descend(const Patch& patch, const Configuration& from, double fraction, double theta, double low,
                             double high) const {
  constexpr double kDelta = 1e-6;
  double best = square(patch, from, fraction, theta), step = 0.1;
  for (int k = 0; k < 60 && step > 1e-9; ++k) {
    const auto at = [&](double u, double t) { return square(patch, from, u, t); };
    const double along = (at(fraction + kDelta, theta) - at(fraction - kDelta, theta)) / (2 * kDelta);
    const double turning = (at(fraction, theta + kDelta) - at(fraction, theta - kDelta)) / (2 * kDelta);
    const double norm = std::hypot(along, turning);
    if (!(norm > 0)) break;
    const double s = std::clamp(fraction - step * along / norm, 0.0, 1.0);
    const double t = std::clamp(theta - step * turning / norm, low, high);
    const double now = square(patch, from, s, t);
    if (now < best) {
      best = now;
      fraction = s;
      theta = t;
      step *= 1.5;
    } else {
      step /= 3;
    }
  }
  return best;
}

double SampledDepth::distance(std::uint32_t patch, const Configuration& from) const {
  const Patch& p = obstacle_.patches()[patch];
  double low = -kPi, high = kPi;
  if (p.begin != Patch::kNone) {
    low = obstacle_.angles()[p.begin].theta;
    high = obstacle_.angles()[p.end].theta;
    if (high <= low) high += 2 * kPi;
  }
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= 8; ++k)
    for (const double fraction : {0.0, 0.499, 0.501, 1.0})
      best = std::min(best, descend(p, from, fraction, low + (high - low) * k / 8, low, high));
  return std::sqrt(best);
}

SampledAnswer SampledDepth::clearance(const Configuration& from) const {
  const std::size_t count = std::min(kNeighbours, samples_.size());
  std::vector<double> far(samples_.size());
  for (std::size_t k = 0; k < samples_.size(); ++k)
    far[k] =
        std::hypot(samples_[k].x - from.x, samples_[k].y - from.y, weight_ * wrapped(samples_[k].theta - from.theta));
  std::vector<std::size_t> order(samples_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count - 1), order.end(),
                   [&](std::size_t a, std::size_t b) { return far[a] < far[b]; });
  std::vector<std::uint32_t> patches;
  for (std::size_t k = 0; k < count; ++k) patches.push_back(nearest_[order[k]]);
  std::sort(patches.begin(), patches.end());
  patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
  SampledAnswer best{std::numeric_limits<double>::infinity(), Patch::kNone};
  for (const std::uint32_t p : patches) {
    const double d = distance(p, from);
    if (d < best.distance) best = {d, p};
  }
  return best;
}

}  // namespace dymsum::bench
