#include "spatial/convex/pose_batch.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <string>

#include "base/parallel.h"
#include "base/poll.h"
#include "dymsum/convex_sum.h"

namespace dymsum::spatial {
namespace {

constexpr int kBits = 10;

/// The position of a cell of the cube of 2^kBits cells a side along its Hilbert curve (Skilling, "Programming the
/// Hilbert curve", 2004).
std::uint64_t hilbert(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1)
    for (std::uint32_t& c : x) {
      if (c & q) {
        x[0] ^= q - 1;
      } else {
        const std::uint32_t t = (x[0] ^ c) & (q - 1);
        x[0] ^= t;
        c ^= t;
      }
    }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1)
    if (x[2] & q) t ^= q - 1;
  for (std::uint32_t& c : x) c ^= t;
  std::uint64_t position = 0;
  for (int b = kBits - 1; b >= 0; --b)
    for (const std::uint32_t c : x) position = position << 1 | (c >> b & 1);
  return position;
}

std::uint64_t key(const Rotation& r) {
  const std::array<std::int64_t, 4>& q = r.quaternion();
  std::size_t top = 0;
  for (std::size_t k = 1; k < 4; ++k)
    if (std::abs(q[k]) > std::abs(q[top])) top = k;
  std::array<std::uint32_t, 3> x{};
  std::size_t n = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (k == top) continue;
    const double t = static_cast<double>(q[k]) / static_cast<double>(q[top]);  // in [-1, 1]
    x[n++] = static_cast<std::uint32_t>(std::min((t + 1) / 2 * (1 << kBits), (1 << kBits) - 1.0));
  }
  return std::uint64_t{top} << 60 | hilbert(x);
}

}  // namespace

std::vector<std::uint32_t> pose_order(std::span<const Rotation> poses) {
  std::vector<std::uint64_t> keys;
  for (const Rotation& r : poses) keys.push_back(key(r));
  std::vector<std::uint32_t> order(poses.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

}  // namespace dymsum::spatial

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
