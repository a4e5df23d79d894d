// Stages: how long each takes, and whether they are to go on.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "dymsum/progress.h"
#include "dymsum/result.h"

namespace dymsum {

// How long stages query whether to go on.

/// Thrown where the caller's progress callback requests a stop; the public function makes ErrorCode::cancelled of it.
struct Cancelled {};

/// What a public function returns that was stopped.
inline Error cancelled() { return {ErrorCode::cancelled, "stopped on request", {}}; }

/// Tells the progress callback the stage and its fraction; does not return when that says to stop.
class Poll {
 public:
  explicit Poll(const Progress& progress) : progress_(progress) {}
  void stage(std::string_view name) {
    stage_ = name;
    (*this)(0);
  }
  std::string_view stage() const { return stage_; }
  void operator()(double fraction) const {
    if (progress_ && !progress_(stage_, fraction)) throw Cancelled{};
  }
  /// Polls once in 4096 rounds of a loop.
  void at(std::size_t round, std::size_t rounds) const {
    if (round % 4096 == 4095) (*this)(static_cast<double>(round) / static_cast<double>(rounds));
  }

  /// Polls where a round is a collision test.
  void at_test(std::size_t round, std::size_t rounds) const {
    if (round % 16 == 15) (*this)(static_cast<double>(round) / static_cast<double>(rounds));
  }

 private:
  const Progress& progress_;
  std::string_view stage_;
};

}  // namespace dymsum

namespace dymsum::base {

// Asking work on another thread to stop: std::stop_source and std::stop_token without callbacks, which the standard
// library of Debian 12's emscripten lacks.

/// What the work looks at. One that belongs to no source is never asked.
class StopToken {
 public:
  StopToken() = default;
  bool stop_requested() const { return requested_ != nullptr && requested_->load(std::memory_order_acquire); }

 private:
  friend class StopSource;
  explicit StopToken(std::shared_ptr<const std::atomic<bool>> requested) : requested_(std::move(requested)) {}
  std::shared_ptr<const std::atomic<bool>> requested_;
};

/// Who asks. By default nobody listens.
class StopSource {
 public:
  StopSource() = default;
  static StopSource create() {
    StopSource source;
    source.requested_ = std::make_shared<std::atomic<bool>>(false);
    return source;
  }
  StopToken token() const { return StopToken(requested_); }
  void request_stop() {
    if (requested_ != nullptr) requested_->store(true, std::memory_order_release);
  }
  bool stop_requested() const { return token().stop_requested(); }

 private:
  std::shared_ptr<std::atomic<bool>> requested_;
};

}  // namespace dymsum::base

namespace dymsum {

// How much time has passed, and how long the stages of a computation take.

class Stopwatch {
 public:
  /// The milliseconds since it was made or the last lap().
  double ms() const { return in_ms(Clock::now() - begin_); }
  /// The same, and begins anew.
  double lap() {
    const Clock::time_point now = Clock::now();
    const double ms = in_ms(now - begin_);
    begin_ = now;
    return ms;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double in_ms(Clock::duration d) { return std::chrono::duration<double, std::milli>(d).count(); }
  Clock::time_point begin_ = Clock::now();
};

/// Appends the time since the last stage to stats.stages, in milliseconds. One that does not run costs nothing: reading
/// the clock takes as long as a stage of a small computation.
template <class Stats>
class StageClock {
 public:
  StageClock(Stats& stats, bool runs) : stats_(stats) {
    if (runs) watch_.emplace();
  }
  void done(std::string_view stage) {
    if (watch_) stats_.stages.push_back({stage, watch_->lap()});
  }

 private:
  Stats& stats_;
  std::optional<Stopwatch> watch_;
};

}  // namespace dymsum
