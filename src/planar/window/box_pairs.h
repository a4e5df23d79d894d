// Pairs of boxes that meet: a sweep over their left sides in 15-bit numbers, eight at a time, in each of several
// horizontal strips.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/box_lanes.h"
#include "base/scratch.h"
#include "base/stop.h"

namespace dymsum::planar {

class BoxPairs {
 public:
  using Pair = std::array<std::uint32_t, 2>;

  /// Takes boxes within [0, extent] in both axes; what lies beyond counts as at the rim.
  explicit BoxPairs(double extent, Scratch* memory = nullptr);

  void reserve(std::size_t n) { boxes_.reserve(n); }
  /// The next box, number 0, 1, ...
  void add(double x0, double y0, double x1, double y1) {
    boxes_.push_back({quantum(x0), quantum(y0), quantum(x1), quantum(y1)});
  }

  /// Every two boxes that meet, once, and some that nearly do; only some of them if there are more than `most`, or if
  /// a stop is requested. O(n log n + pairs of a strip that meet in x / 8).
  Array<Pair> find(std::size_t most = ~std::size_t{0}, const base::StopToken& stop = {});

 private:
  struct Box {
    std::int16_t x0, y0, x1, y1;
  };
  // Monotone, so boxes that meet do so in quanta too.
  std::int16_t quantum(double v) const {
    return static_cast<std::int16_t>(std::clamp(v * per_unit_, 0.0, double{kBoxQuanta - 1}));
  }

  int strips() const;
  void sweep(Array<std::uint64_t>& order, std::int16_t low, std::size_t most);

  double per_unit_ = 0;
  Scratch* memory_;
  Array<Box> boxes_;
  Array<Pair> pairs_;
  Array<std::int16_t> sides_;  // of the boxes of a strip in their order: left, low, high
  std::size_t count_ = 0;
};

}  // namespace dymsum::planar
