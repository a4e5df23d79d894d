#include "planar/scaling/window_ahead.h"

#include <new>
#include <utility>

namespace dymsum::planar {

void WindowAhead::start(WindowPlan plan, std::shared_ptr<const OperandPair> base, const exact::BigRational& entry) {
  ready_ = false;
  thread_ = std::jthread([this, plan = std::move(plan), base = std::move(base), entry](std::stop_token stop) mutable {
    plan.settings.stop = stop;
    try {
      std::unique_ptr<WindowFrames> frames = window_frames(*base, plan);
      if (frames != nullptr && !stop.stop_requested()) {
        ExactFrame frame(base, scale_value(entry));
        FrameWork work;
        frames->follow(frame, work);
      }
      frames_ = std::move(frames);
    } catch (const std::bad_alloc&) {
      // Then there is no window, as where it would cost too much.
    }
    ready_.store(true, std::memory_order_release);
  });
}

std::unique_ptr<WindowFrames> WindowAhead::take() {
  thread_.join();
  return std::move(frames_);
}

}  // namespace dymsum::planar
