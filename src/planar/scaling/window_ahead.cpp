#include "planar/scaling/window_ahead.h"

#include <new>
#include <system_error>
#include <utility>

namespace dymsum::planar {
namespace {

std::unique_ptr<WindowFrames> made(const std::shared_ptr<const OperandPair>& base, const WindowPlan& plan,
                                   const exact::BigRational& entry) {
  std::unique_ptr<WindowFrames> frames = window_frames(*base, plan);
  if (frames == nullptr || plan.settings.stop.stop_requested()) return nullptr;
  ExactFrame frame(base, scale_value(entry));
  FrameWork work;
  frames->follow(frame, work);
  return frames;
}

}  // namespace

// Where memory or threads have run out there is no window, as where one would cost too much.
void WindowAhead::start(WindowPlan plan, std::shared_ptr<const OperandPair> base, const exact::BigRational& entry) {
  ready_ = false;
  auto make = [this, plan = std::move(plan), base = std::move(base), entry](std::stop_token stop) mutable {
    try {
      plan.settings.stop = std::move(stop);
      frames_ = made(base, plan, entry);
    } catch (const std::bad_alloc&) {
    }
    ready_.store(true, std::memory_order_release);
  };
  try {
    thread_ = std::jthread(std::move(make));
  } catch (const std::system_error&) {
  }
}

std::unique_ptr<WindowFrames> WindowAhead::take() {
  thread_.join();
  return std::move(frames_);
}

}  // namespace dymsum::planar
