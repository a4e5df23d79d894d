#include "planar/window/frame_window.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "base/memory_budget.h"

namespace dymsum::planar {

bool KeptWindows::covers(std::uint64_t family, double at) const {
  return std::any_of(windows_.begin(), windows_.end(), [&](const Kept& k) { return k.window->serves(family, at); });
}

std::unique_ptr<FrameWindow> KeptWindows::take(std::uint64_t family, double at) {
  const auto found =
      std::find_if(windows_.begin(), windows_.end(), [&](const Kept& k) { return k.window->serves(family, at); });
  if (found == windows_.end()) return nullptr;
  std::unique_ptr<FrameWindow> window = std::move(found->window);
  bytes_ -= found->bytes;
  windows_.erase(found);
  return window;
}

void KeptWindows::keep(std::unique_ptr<FrameWindow> window, std::uint64_t most_bytes) {
  const std::uint64_t bytes = window->bytes();
  windows_.push_front({std::move(window), bytes});
  bytes_ += bytes;
  while (bytes_ > most_bytes) {
    bytes_ -= windows_.back().bytes;
    windows_.pop_back();
  }
}

/// The thread with what it shares, all under the mutex.
struct WindowAhead::Worker {
  void run();

  std::mutex mutex;
  std::condition_variable wake;                // to the thread: there is something to do, and back: it is done
  MakeWindow make;                             // what is under way; the thread reads it without the mutex
  std::shared_ptr<base::MemoryBudget> budget;  // of who requested it
  std::unique_ptr<FrameWindow> window;         // what came of it, once ready
  base::StopSource stop;                       // of the work that goes on
  bool works = false, rests = false, ends = false;
  std::atomic<bool> ready = false;
  std::thread thread;
};

namespace {

// Where memory has run out the work goes on to its end.
base::StopSource new_stop() {
  try {
    return base::StopSource::create();
  } catch (const std::bad_alloc&) {
    return base::StopSource();
  }
}

// Where memory has run out there is no window, as where one would cost too much.
std::unique_ptr<FrameWindow> made(const MakeWindow& make, const std::shared_ptr<base::MemoryBudget>& budget,
                                  const base::StopToken& stop) {
  const base::UseBudget use(budget);
  try {
    return make(stop);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

}  // namespace

// A window that was stopped for a fork is begun again.
void WindowAhead::Worker::run() {
  std::unique_lock lock(mutex);
  for (;;) {
    wake.wait(lock, [this] { return ends || (make != nullptr && !rests); });
    if (ends) return;
    stop = new_stop();
    works = true;
    lock.unlock();
    std::unique_ptr<FrameWindow> next = made(make, budget, stop.token());
    lock.lock();
    works = false;
    if (next != nullptr || !stop.stop_requested()) {
      make = nullptr;
      window = std::move(next);
      ready.store(true, std::memory_order_release);
    }
    wake.notify_all();
  }
}

WindowAhead::WindowAhead() = default;

WindowAhead::~WindowAhead() {
  if (worker_ == nullptr) return;
  {
    const std::lock_guard lock(worker_->mutex);
    worker_->ends = true;
    worker_->stop.request_stop();
  }
  worker_->wake.notify_all();
  worker_->thread.join();
  forget();
}

void WindowAhead::start(MakeWindow make) {
  busy_ = true;
  if (worker_ == nullptr && !begin()) return;
  {
    const std::lock_guard lock(worker_->mutex);
    worker_->make = std::move(make);
    worker_->budget = base::current_budget();
    worker_->ready = false;
  }
  worker_->wake.notify_all();
}

bool WindowAhead::begin() {
  try {
    worker_ = std::make_unique<Worker>();
    watch();
    worker_->thread = std::thread(&Worker::run, worker_.get());
    return true;
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  forget();
  worker_ = nullptr;
  return false;
}

bool WindowAhead::ready() const {
  return busy_ && (worker_ == nullptr || worker_->ready.load(std::memory_order_acquire));
}

std::unique_ptr<FrameWindow> WindowAhead::take() {
  busy_ = false;
  if (worker_ == nullptr) return nullptr;
  std::unique_lock lock(worker_->mutex);
  worker_->wake.wait(lock, [this] { return worker_->ready.load(); });
  return std::move(worker_->window);
}

// The mutex is held over the fork, so that in the child nobody else has it.
void WindowAhead::before_fork() {
  std::unique_lock lock(worker_->mutex);
  worker_->rests = true;
  worker_->stop.request_stop();
  worker_->wake.wait(lock, [this] { return !worker_->works; });
  lock.release();
}

void WindowAhead::after_fork_in_parent() {
  worker_->rests = false;
  worker_->mutex.unlock();
  worker_->wake.notify_all();
}

// A thread that is not there cannot be joined, nor what it waits for be destroyed: the little that it has is left.
void WindowAhead::after_fork_in_child() {
  busy_ = false;
  static_cast<void>(worker_.release());
}

}  // namespace dymsum::planar
