#include "planar/window/frame_window.h"

#include <algorithm>
#include <utility>

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

}  // namespace dymsum::planar
