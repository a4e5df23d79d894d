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
