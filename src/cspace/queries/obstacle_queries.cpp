#include "dymsum/obstacle_queries.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/doubles.h"
#include "base/parallel.h"
#include "cspace/queries/clearance_search.h"
#include "cspace/queries/containment_index.h"
#include "cspace/queries/free_angles.h"

namespace dymsum {
namespace {

// The root of the mean square distance of the robot's points from the origin: of its parts, else of its polylines, else
// of its points.
double turning_radius(const Region& robot) {
  if (!robot.parts().empty()) return radius_of_gyration(robot);
  // A segment counts with its midpoint and its length; the mean is by lengths.
  double size = 0, radius = 0;
  const auto add = [&](double more, double mean) {
    if (!(more > 0)) return;
    size += more;
    radius = std::hypot(radius * std::sqrt((size - more) / size), mean * std::sqrt(more / size));
  };
  for (const Polyline& line : robot.polylines())
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Point a = line[k], b = line[k + 1];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      add(length, base::hypot3((a.x + b.x) / 2, (a.y + b.y) / 2, length / std::sqrt(12)));
    }
  if (robot.polylines().empty())
    for (const Point& p : robot.points()) add(1, std::hypot(p.x, p.y));
  return radius;
}

// The angle in [-pi, pi], within 2^-51 of the angle of Orientation::nearest.
double reduced(double theta) {
  return std::abs(theta) <= std::numbers::pi ? theta : Orientation::nearest(theta).value().radians();
}

}  // namespace

class ObstacleQueries::State {
 public:
  explicit State(const CspaceObstacle& o)
      : obstacle(o),
        forms(o),
        index(o, forms),
        gyration(turning_radius(o.robot())),
        tree(o, forms, forms.in_units(gyration)) {}

  // A curve of tight placements may be free in what is inside by the patches.
  std::optional<bool> proved(double x, double y, double theta) const {
    const std::optional<bool> by_patches = index.contains(x, y, theta);
    return by_patches == true && obstacle.may_have_tight_curves() ? std::nullopt : by_patches;
  }
  bool exact(double x, double y, const Orientation& theta) const {
    exact_answers.fetch_add(1, std::memory_order_relaxed);
    return obstacle.contains(x, y, theta);
  }

  const CspaceObstacle& obstacle;
  cspace::PatchForms forms;
  cspace::ContainmentIndex index;
  double gyration = 0;
  cspace::PatchTree tree;
  mutable std::atomic<std::uint64_t> exact_answers{0}, bounds{0};
};

ObstacleQueries::ObstacleQueries(const CspaceObstacle& obstacle) : state_(std::make_unique<State>(obstacle)) {}
ObstacleQueries::ObstacleQueries(ObstacleQueries&&) noexcept = default;
ObstacleQueries& ObstacleQueries::operator=(ObstacleQueries&&) noexcept = default;
ObstacleQueries::~ObstacleQueries() = default;

bool ObstacleQueries::contains(const Configuration& at) const {
  const State& s = *state_;
  if (std::abs(at.theta) <= std::numbers::pi)
    if (const std::optional<bool> proved = s.proved(at.x, at.y, at.theta)) return *proved;
  if (!std::isfinite(at.theta)) throw std::invalid_argument("ObstacleQueries::contains: theta is not finite");
  return contains(at.x, at.y, Orientation::nearest(at.theta).value());
}

bool ObstacleQueries::contains(double x, double y, const Orientation& theta) const {
  const State& s = *state_;
  if (!std::isfinite(x) || !std::isfinite(y)) return false;
  const std::optional<bool> proved = s.proved(x, y, theta.radians());
  return proved ? *proved : s.exact(x, y, theta);
}

std::vector<std::uint8_t> ObstacleQueries::contains(std::span<const Configuration> at, int threads) const {
  constexpr std::size_t kBlock = 1024;
  std::vector<std::uint8_t> result(at.size());
  base::parallel_parts((at.size() + kBlock - 1) / kBlock, threads, [&](std::size_t block) {
    const std::size_t last = std::min(at.size(), (block + 1) * kBlock);
    for (std::size_t k = block * kBlock; k < last; ++k) result[k] = contains(at[k]) ? 1 : 0;
  });
  return result;
}

std::uint64_t ObstacleQueries::exact_answers() const { return state_->exact_answers; }
double ObstacleQueries::gyration_radius() const { return state_->gyration; }
std::uint64_t ObstacleQueries::bounds_evaluated() const { return state_->bounds; }

std::vector<FreeAngles> ObstacleQueries::free_angles(double x, double y) const {
  if (!std::isfinite(x) || !std::isfinite(y))
    throw std::invalid_argument("ObstacleQueries::free_angles: the position is not finite");
  const State& s = *state_;
  return cspace::free_angles(s.obstacle, s.forms, {x, y}, [&](double theta) { return !contains({x, y, theta}); });
}

double ObstacleQueries::largest_weight() const { return 0x1p40 * state_->forms.size() * state_->forms.unit(); }

Clearance ObstacleQueries::clearance(const Configuration& from, double weight, Touching touching) const {
  if (!(weight >= 0) || !std::isfinite(from.x) || !std::isfinite(from.y) || !std::isfinite(from.theta))
    throw std::invalid_argument("clearance: the weight is negative or an argument is not a number");
  if (weight > largest_weight() && !std::isinf(weight))
    throw std::invalid_argument("clearance: the weight is larger than largest_weight(), but not infinite");
  const State& s = *state_;
  const Configuration at{from.x, from.y, reduced(from.theta)};
  const std::optional<bool> proved = s.proved(at.x, at.y, at.theta);
  const bool overlaps = proved ? *proved : contains(from);
  const auto found = cspace::ClearanceSearch(s.obstacle, s.forms, s.tree)
                         .run({at, from.theta, weight, touching, overlaps, proved == false});
  s.bounds.fetch_add(found.bounds, std::memory_order_relaxed);
  return found.clearance;
}

std::size_t ObstacleQueries::bytes() const { return state_->index.bytes() + state_->tree.bytes(); }

}  // namespace dymsum
