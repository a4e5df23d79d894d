// A window of angles as moving sums keep it, and what such windows are made of.
#pragma once

#include <cmath>
#include <memory>

#include "planar/frames/frame_window.h"
#include "planar/turning/rotating_window.h"

namespace dymsum::planar {

/// What never changes while an operand turns. Windows and the thread that makes them share it.
struct TurnedOperands {
  /// The smaller operand, which moves in windows, as operand 1.
  explicit TurnedOperands(std::shared_ptr<const OperandPair> base)
      : pair(std::move(base)), forms(*pair), catalog(forms) {}
  TurnedOperands(const TurnedOperands&) = delete;
  TurnedOperands& operator=(const TurnedOperands&) = delete;

  std::shared_ptr<const OperandPair> pair;
  TurningForms forms;
  TurnCatalog catalog;
};

struct TurnedWindow final : FrameWindow {
  TurnedWindow(std::shared_ptr<const TurnedOperands> of, RotatingWindow w)
      : operands(std::move(of)), window(std::move(w)) {}

  /// Angles come round; doubles of them err, so a window's ends are left a little early.
  bool covers(double angle) const override {
    return std::abs(std::remainder(angle - window.middle, kTurn)) <= window.half - kAngleDifference;
  }
  double end(bool up) const override { return up ? window.middle + window.half : window.middle - window.half; }
  std::size_t bytes() const override { return window.bytes(); }

  std::shared_ptr<const TurnedOperands> operands;  // outlive the window
  RotatingWindow window;
};

}  // namespace dymsum::planar
