// Many questions on several threads, answered in their order.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>

#include "base/double_text.h"
#include "base/parallel.h"
#include "base/poll.h"
#include "dymsum/penetration_depth.h"

namespace dymsum {
namespace {

std::optional<Error> batch_error(const DepthBatchOptions& options) {
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  if (!(options.time_limit >= 0))
    return Error{ErrorCode::out_of_range,
                 "the time limit must be at least 0, not " + base::general_text(options.time_limit, 6),
                 {}};
  return std::nullopt;
}

/// Calls row(worker, k) for all k below `count`, each worker from the next one on that nobody has taken. False where
/// progress requested a stop.
template <class F>
bool for_each_row(std::size_t count, const DepthBatchOptions& options, std::size_t workers, F row) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  const std::thread::id caller = std::this_thread::get_id();
  base::parallel_parts(workers, static_cast<int>(workers), [&](std::size_t worker) {
    for (std::size_t k = next++; k < count && !stop; k = next++) {
      row(worker, k);
      const double fraction = static_cast<double>(k + 1) / static_cast<double>(count);
      if (options.progress && std::this_thread::get_id() == caller && !options.progress("depth", fraction)) stop = true;
    }
  });
  return !stop;
}

std::size_t worker_count(std::size_t rows, const DepthBatchOptions& options) {
  const auto threads = static_cast<std::size_t>(options.threads > 0 ? options.threads : base::core_count());
  return std::max<std::size_t>(1, std::min(threads, rows));
}

bool is_finite_move(const Point3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Error infinite_move(std::size_t k) {
  Error error{ErrorCode::not_finite, "a translation is not finite", {}};
  error.evidence.vertex = static_cast<std::int64_t>(k);
  return error;
}

Result<SolidDistance> distance_of(const DepthQuestion& question, double time_limit) {
  const Point3 move = question.q_moved_by;
  if (!is_finite_move(move)) return Error{ErrorCode::not_finite, "the translation is not finite", {}};
  DepthOptions one;
  one.threads = 1;
  Result<SolidDepth> pair = SolidDepth::create(*question.p, *question.q, one);
  if (!pair) return pair.error();
  return SolidDepth(*std::move(pair)).at(move, time_limit);
}

template <class Move>
Result<std::vector<SolidDistance>> all_rows(const SolidDepth& pair, std::span<const Move> moves,
                                            const DepthBatchOptions& options) {
  const std::size_t workers = worker_count(moves.size(), options);
  std::vector<SolidDepth> pairs(workers, pair);
  std::vector<SolidDistance> rows(moves.size());
  const bool done = for_each_row(moves.size(), options, workers, [&](std::size_t worker, std::size_t k) {
    rows[k] = pairs[worker].at(moves[k], options.time_limit);
  });
  if (!done) return cancelled();
  return rows;
}

}  // namespace

Result<std::vector<SolidDistance>> depth_batch(const SolidDepth& pair, std::span<const Point3> moves,
                                               const DepthBatchOptions& options) {
  if (std::optional<Error> error = batch_error(options)) return *std::move(error);
  for (std::size_t k = 0; k < moves.size(); ++k)
    if (!is_finite_move(moves[k])) return infinite_move(k);
  return all_rows(pair, moves, options);
}

Result<std::vector<SolidDistance>> depth_batch(const SolidDepth& pair, std::span<const RationalPoint3> moves,
                                               const DepthBatchOptions& options) {
  if (std::optional<Error> error = batch_error(options)) return *std::move(error);
  return all_rows(pair, moves, options);
}

Result<std::vector<Result<SolidDistance>>> depth_batch(std::span<const DepthQuestion> questions,
                                                       const DepthBatchOptions& options) {
  if (std::optional<Error> error = batch_error(options)) return *std::move(error);
  for (const DepthQuestion& question : questions)
    if (question.p == nullptr || question.q == nullptr)
      return Error{ErrorCode::out_of_range, "a question names no solid", {}};
  std::vector<Result<SolidDistance>> rows(questions.size(), Result<SolidDistance>(SolidDistance{}));
  const bool done =
      for_each_row(questions.size(), options, worker_count(questions.size(), options),
                   [&](std::size_t, std::size_t k) { rows[k] = distance_of(questions[k], options.time_limit); });
  if (!done) return cancelled();
  return rows;
}

}  // namespace dymsum
