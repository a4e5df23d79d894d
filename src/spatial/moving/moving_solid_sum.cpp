#include "dymsum/moving_solid_sum.h"

#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "spatial/moving/frame_changes.h"
#include "spatial/moving/moving_pair.h"
#include "spatial/sum/grid_error.h"

namespace dymsum {

using spatial::PosePair;

class MovingSolidSum::State {
 public:
  State(const Mesh& p, const Mesh& q, const MovingSolidOptions& options) : motion(p, q, options) {}

  Result<SolidFrameWork> set(const PosePair& to) {
    const Stopwatch watch;
    SolidFrameWork now;
    Result<SpatialSum> made = spatial::guarded([&] { return motion.frame(to, now); });
    if (!made) return made.error();
    before = std::exchange(sum, *std::move(made));
    work = now;
    work.ms = watch.ms();
    return work;
  }

  spatial::MovingPair motion;
  SpatialSum sum;
  std::optional<SpatialSum> before;
  SolidFrameWork work;
};

Result<MovingSolidSum> MovingSolidSum::create(const Mesh& p, const Mesh& q, const MovingSolidOptions& options) {
  if (std::optional<Error> error = spatial::motion_refusal(p, q, options)) return *std::move(error);
  MovingSolidSum sum(std::make_unique<State>(p, q, options));
  if (const Result<SolidFrameWork> first = sum.set({}); !first) {
    const bool wide = first.error().code == ErrorCode::unsupported_operand && !p.empty() && !q.empty();
    if (std::optional<Error> error; wide && (error = spatial::grid_error(p.vertices(), q.vertices()))) return *error;
    return first.error();
  }
  sum.state_->before.reset();
  return sum;
}

MovingSolidSum::MovingSolidSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
MovingSolidSum::MovingSolidSum(MovingSolidSum&&) noexcept = default;
MovingSolidSum& MovingSolidSum::operator=(MovingSolidSum&&) noexcept = default;
MovingSolidSum::~MovingSolidSum() = default;

Result<SolidFrameWork> MovingSolidSum::set(const SolidPose& p, const SolidPose& q) { return state_->set({p, q}); }
const SolidPose& MovingSolidSum::p_pose() const { return state_->motion.poses().p; }
const SolidPose& MovingSolidSum::q_pose() const { return state_->motion.poses().q; }
const SpatialSum& MovingSolidSum::sum() const { return state_->sum; }
const SolidFrameWork& MovingSolidSum::work() const { return state_->work; }
SolidFrameChanges MovingSolidSum::changes() const {
  return state_->before ? spatial::frame_changes(*state_->before, state_->sum) : SolidFrameChanges{};
}

Result<SpatialSum> posed_sum(const Mesh& p, const Mesh& q, const SolidPose& p_pose, const SolidPose& q_pose,
                             const MovingSolidOptions& options) {
  if (std::optional<Error> error = spatial::motion_refusal(p, q, options)) return *std::move(error);
  return spatial::guarded([&] {
    return spatial::fresh_sum(spatial::solid_pair(p, q), {p_pose, q_pose}, spatial::stage_options(options));
  });
}

}  // namespace dymsum
