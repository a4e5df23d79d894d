#include <algorithm>
#include <exception>
#include <mutex>

#include "base/parallel.h"
#include "base/poll.h"
#include "spatial/convex/pose_order.h"
#include "spatial/moving/moving_pair.h"

namespace dymsum {

namespace {

using spatial::PosePair;

/// What the threads of a batch share.
class PoseBatch {
 public:
  PoseBatch(const std::vector<PosePair>& poses, const PosedSumVisit& visit, const MovingSolidOptions& options)
      : poses_(poses), visit_(visit), progress_(options.progress), works_(poses.size()) {}

  /// One part of the order: a motion of its own, so that parts share nothing but what they tell. The first failure ends
  /// all parts.
  void run(const Mesh& p, const Mesh& q, const MovingSolidOptions& own, std::span<const std::uint32_t> part) {
    try {
      spatial::MovingPair pair(p, q, own, spatial::PoseOrder::scattered);
      for (const std::uint32_t k : part) {
        const Stopwatch watch;
        const SpatialSum sum = pair.frame(poses_[k], works_[k]);
        works_[k].ms = watch.ms();
        tell(k, sum);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      fail();
    }
  }
  /// Throws what ended the batch.
  std::vector<SolidFrameWork> take() {
    if (failure_) std::rethrow_exception(failure_);
    return std::move(works_);
  }
  /// Whether to go on, between the stages of a sum: the caller is queried by one thread at a time, with the fraction of
  /// all poses.
  bool go_on() {
    const std::lock_guard lock(mutex_);
    if (!failure_ && !queried()) failure_ = std::make_exception_ptr(Cancelled{});
    return !failure_;
  }

 private:
  bool queried() const {
    return !progress_ || progress_("poses", static_cast<double>(done_) / static_cast<double>(poses_.size()));
  }
  void tell(std::uint32_t k, const SpatialSum& sum) {
    const std::lock_guard lock(mutex_);
    if (failure_) throw Cancelled{};
    try {
      visit_(k, sum);
      ++done_;
      if (!queried()) throw Cancelled{};
    } catch (...) {
      fail();  // still under the lock: no other thread visits after a failure
      throw;
    }
  }
  /// Keeps the failure that is being caught, if it is the first. The lock is held.
  void fail() {
    if (!failure_) failure_ = std::current_exception();
  }

  const std::vector<PosePair>& poses_;
  const PosedSumVisit& visit_;
  const Progress& progress_;
  std::vector<SolidFrameWork> works_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
};

/// P's turn as Q sees it, which is what a convolution depends on.
std::vector<Rotation> relative_turns(const std::vector<PosePair>& poses) {
  std::vector<Rotation> turns;
  for (const PosePair& at : poses) turns.push_back(at.q.rotation.inverse() * at.p.rotation);
  return turns;
}

}  // namespace

Result<std::vector<SolidFrameWork>> posed_sums(const Mesh& p, const Mesh& q, std::span<const SolidPose> p_poses,
                                               std::span<const SolidPose> q_poses, const PosedSumVisit& visit,
                                               const MovingSolidOptions& options) {
  if (std::optional<Error> error = spatial::motion_refusal(p, q, options)) return *std::move(error);
  if (!q_poses.empty() && q_poses.size() != p_poses.size())
    return Error{ErrorCode::out_of_range,
                 "there are " + std::to_string(p_poses.size()) + " poses of P and " + std::to_string(q_poses.size()) +
                     " of Q: as many are needed, or none of Q",
                 {}};
  std::vector<PosePair> poses;
  for (std::size_t k = 0; k < p_poses.size(); ++k)
    poses.push_back({p_poses[k], q_poses.empty() ? SolidPose{} : q_poses[k]});
  const std::vector<std::uint32_t> order = spatial::pose_order(relative_turns(poses));
  PoseBatch batch(poses, visit, options);
  MovingSolidOptions own = options;
  own.threads = 1;
  own.progress = [&](std::string_view, double) { return batch.go_on(); };
  const auto threads = static_cast<std::size_t>(options.threads > 0 ? options.threads : base::core_count());
  const std::size_t parts = std::min(poses.size(), threads);
  return spatial::guarded([&] {
    base::parallel_parts(parts, options.threads, [&](std::size_t part) {
      const std::size_t low = poses.size() * part / parts, high = poses.size() * (part + 1) / parts;
      batch.run(p, q, own, std::span(order).subspan(low, high - low));
    });
    return batch.take();
  });
}

}  // namespace dymsum
