#include "planar/scaling/kept_windows.h"

#include <algorithm>
#include <utility>

namespace dymsum::planar {

bool KeptWindows::covers(double scale) const {
  return std::any_of(windows_.begin(), windows_.end(), [&](const Kept& k) { return k.frames->covers(scale); });
}

std::unique_ptr<WindowFrames> KeptWindows::take(double scale) {
  const auto at =
      std::find_if(windows_.begin(), windows_.end(), [&](const Kept& k) { return k.frames->covers(scale); });
  if (at == windows_.end()) return nullptr;
  std::unique_ptr<WindowFrames> frames = std::move(at->frames);
  bytes_ -= at->bytes;
  windows_.erase(at);
  return frames;
}

void KeptWindows::keep(std::unique_ptr<WindowFrames> frames, std::uint64_t most_bytes) {
  const std::uint64_t bytes = frames->bytes();
  windows_.push_front({std::move(frames), bytes});
  bytes_ += bytes;
  while (bytes_ > most_bytes) {
    bytes_ -= windows_.back().bytes;
    windows_.pop_back();
  }
}

}  // namespace dymsum::planar
