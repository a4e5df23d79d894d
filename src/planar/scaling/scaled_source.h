// Exact positions of the vertices of a sum at one scale.
#pragma once

#include "planar/frames/pair_source.h"

namespace dymsum::planar {

class ScaledSource final : public PairSource {
 public:
  ScaledSource(std::shared_ptr<const OperandPair> base, LatticeScale scale)
      : PairSource(std::move(base)), scale_(std::move(scale)) {}

 private:
  PlacedPair placed() const override { return base().placed_on_lattice(base().lattice_at(scale_)); }
  bool keeps_axes(std::uint32_t) const override { return true; }
  std::optional<int> compare_corners(const SumVertex& a, const SumVertex& b, int axis) const override;
  LatticeScale scale_;
};

}  // namespace dymsum::planar
