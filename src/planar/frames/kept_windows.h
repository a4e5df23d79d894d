// Windows that were left, for when the motion comes back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>

#include "planar/frames/frame_window.h"

namespace dymsum::planar {

class KeptWindows {
 public:
  /// The most recently used one that covers a position of a family; it is kept no longer. None: nothing.
  std::unique_ptr<FrameWindow> take(std::uint64_t family, double at);
  bool covers(std::uint64_t family, double at) const;
  /// Keeps one. The least recently used ones go until all of them hold at most `most_bytes`.
  void keep(std::unique_ptr<FrameWindow> window, std::uint64_t most_bytes);
  std::uint64_t bytes() const { return bytes_; }
  std::size_t size() const { return windows_.size(); }

 private:
  struct Kept {
    std::unique_ptr<FrameWindow> window;
    std::uint64_t bytes = 0;
  };
  std::list<Kept> windows_;  // the most recently used first
  std::uint64_t bytes_ = 0;
};

}  // namespace dymsum::planar
