#include <atomic>
#include <cmath>
#include <mutex>
#include <string>

#include "base/parallel.h"
#include "base/poll.h"
#include "dymsum/convex_sum.h"
#include "spatial/convex/pose_order.h"

namespace dymsum {

Result<std::vector<PoseReport>> pose_batch(const Mesh& p, const Mesh& q, std::span<const Rotation> poses,
                                           const BatchOptions& options) {
  for (const Point3& at : {options.support_direction, options.depth_point})
    if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z))
      return Error{ErrorCode::not_finite, "the direction and the point of a batch have to be finite", {}};
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  Result<ConvexSum> sum = ConvexSum::create(p, q);
  if (!sum) return sum.error();
  const std::vector<std::uint32_t> order = spatial::pose_order(poses);
  std::vector<PoseReport> reports(poses.size());
  const std::size_t parts = std::min<std::size_t>(
      poses.size(), static_cast<std::size_t>(options.threads > 0 ? options.threads : base::core_count()));
  std::atomic<bool> stop = false;
  std::mutex progress_mutex;
  std::size_t done = 0;
  base::parallel_parts(parts, options.threads, [&](std::size_t part) {
    ConvexSum mine = *sum;
    for (std::size_t i = poses.size() * part / parts; i < poses.size() * (part + 1) / parts && !stop; ++i) {
      mine.set(poses[order[i]]);
      reports[order[i]] = {mine.facet_count().all, mine.volume(), mine.support(options.support_direction).at,
                           mine.depth(options.depth_point)};
      if (!options.progress) continue;
      const std::lock_guard lock(progress_mutex);
      ++done;
      if (!options.progress("poses", static_cast<double>(done) / static_cast<double>(poses.size()))) stop = true;
    }
  });
  if (stop) return cancelled();
  return reports;
}

}  // namespace dymsum
