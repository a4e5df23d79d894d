// Scales of one ratio: diag(s, r s) times an operand is s times the operand stretched by diag(1, r), so that windows of
// uniform scales serve them.
#pragma once

#include <list>
#include <memory>
#include <optional>

#include "planar/scaling/window_builder.h"

namespace dymsum::planar {

/// What scales of one ratio have in common: diag(x, y) with the larger one 1. Of uniform scales both are.
struct Stretch {
  ScaleValue x, y;
  bool uniform() const { return x == y; }
  friend bool operator==(const Stretch&, const Stretch&) = default;
};
/// Of diag(x, y).
Stretch stretch_of(const ScaleValue& x, const ScaleValue& y);

struct RatioSweep {
  std::uint64_t family;  ///< of its windows; 0 is that of uniform scales
  Stretch stretch;
  std::shared_ptr<const OperandPair> base;  ///< the stretched one
  WindowBuilder windows;
};

/// The sweeps of the last few ratios.
class RatioSweeps {
 public:
  /// That of a ratio, if it is known.
  RatioSweep* find(const Stretch& stretch);
  /// Makes one. Nothing where windows cannot serve: for ratios beyond 2^OperandPair::kStretchBits.
  RatioSweep* make(const OperandPair& base, const Stretch& stretch);

 private:
  std::list<RatioSweep> sweeps_;  // the most recently used first
  std::uint64_t made_ = 0;
};

}  // namespace dymsum::planar
