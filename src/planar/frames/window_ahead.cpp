#include "planar/frames/window_ahead.h"

#include <new>
#include <system_error>
#include <utility>

namespace dymsum::planar {

// Where memory or threads have run out there is no window, as where one would cost too much.
void WindowAhead::start(MakeWindow make) {
  busy_ = true;
  ready_ = false;
  {
    const std::lock_guard lock(mutex_);
    make_ = std::move(make);
  }
  wake_.notify_all();
  if (thread_.joinable()) return;
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  } catch (const std::system_error&) {
    make_ = nullptr;
    ready_ = true;
  }
}

void WindowAhead::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return make_ != nullptr; })) {
    MakeWindow make = std::exchange(make_, nullptr);
    lock.unlock();
    std::unique_ptr<FrameWindow> window;
    try {
      window = make(stop);
    } catch (const std::bad_alloc&) {
    }
    make = nullptr;
    lock.lock();
    window_ = std::move(window);
    ready_.store(true, std::memory_order_release);
    wake_.notify_all();
  }
}

std::unique_ptr<FrameWindow> WindowAhead::take() {
  if (!ready()) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return ready_.load(); });
  }
  busy_ = false;
  return std::move(window_);
}

}  // namespace dymsum::planar
