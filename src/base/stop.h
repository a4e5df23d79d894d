// Asking work on another thread to stop: std::stop_source and std::stop_token without callbacks, which the standard
// library of Debian 12's emscripten lacks.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

namespace dymsum::base {

/// What the work looks at. One that belongs to no source is never asked.
class StopToken {
 public:
  StopToken() = default;
  bool stop_requested() const { return asked_ != nullptr && asked_->load(std::memory_order_acquire); }

 private:
  friend class StopSource;
  explicit StopToken(std::shared_ptr<const std::atomic<bool>> asked) : asked_(std::move(asked)) {}
  std::shared_ptr<const std::atomic<bool>> asked_;
};

/// Who asks. By default nobody listens.
class StopSource {
 public:
  StopSource() = default;
  static StopSource create() {
    StopSource source;
    source.asked_ = std::make_shared<std::atomic<bool>>(false);
    return source;
  }
  StopToken token() const { return StopToken(asked_); }
  void request_stop() {
    if (asked_ != nullptr) asked_->store(true, std::memory_order_release);
  }
  bool stop_requested() const { return token().stop_requested(); }

 private:
  std::shared_ptr<std::atomic<bool>> asked_;
};

}  // namespace dymsum::base
