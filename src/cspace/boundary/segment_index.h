// Segments by index: those of edges of the fixed operand first, then those of edges of the turning one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "planar/operand/operand.h"

namespace dymsum::planar {

class SegmentIndex {
 public:
  /// How many vertices the walks of the operands have.
  SegmentIndex(std::uint32_t fixed, std::uint32_t turning) : n0_(fixed), n1_(turning) {}
  std::size_t count() const { return std::size_t{2} * n0_ * n1_; }
  std::uint32_t of(const WalkSegment& s) const {
    return s.side == 0 ? s.edge * n1_ + s.vertex : n0_ * n1_ + s.edge * n0_ + s.vertex;
  }
  WalkSegment segment(std::uint32_t index) const {
    if (index < n0_ * n1_) return {0, index / n1_, index % n1_};
    return {1, (index - n0_ * n1_) / n0_, (index - n0_ * n1_) % n0_};
  }

 private:
  std::uint32_t n0_, n1_;
};

}  // namespace dymsum::planar
