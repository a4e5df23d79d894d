// A window of positions - scales or angles - in which frames are made, with all that they look at and know. Positions
// are those of one family: scales of one ratio, say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "base/stop.h"

namespace dymsum::planar {

class FrameWindow {
 public:
  explicit FrameWindow(std::uint64_t family = 0) : family_(family) {}
  FrameWindow(const FrameWindow&) = delete;
  FrameWindow& operator=(const FrameWindow&) = delete;
  virtual ~FrameWindow() = default;

  bool serves(std::uint64_t family, double at) const { return family == family_ && covers(at); }
  /// Whether frames at a position of its family are made here.
  virtual bool covers(double at) const = 0;
  /// The position at which it ends for a motion that goes up, or down.
  virtual double end(bool up) const = 0;
  virtual std::size_t bytes() const = 0;

 private:
  std::uint64_t family_;
};

/// Makes a window, on any thread, from what never changes. Nothing where that would cost too much, or is stopped.
using MakeWindow = std::function<std::unique_ptr<FrameWindow>(const base::StopToken&)>;

}  // namespace dymsum::planar
