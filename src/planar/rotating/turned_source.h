// Exact positions of the vertices of a sum at one orientation.
#pragma once

#include "dymsum/orientation.h"
#include "planar/frames/pair_source.h"

namespace dymsum::planar {

class TurnedSource final : public PairSource {
 public:
  TurnedSource(std::shared_ptr<const OperandPair> base, Orientation theta)
      : PairSource(std::move(base)), theta_(std::move(theta)) {}

 private:
  PlacedPair placed() const override;
  bool keeps_axes(std::uint32_t op) const override { return op != base().moved; }
  std::optional<int> compare_corners(const SumVertex& a, const SumVertex& b, int axis) const override;
  Orientation theta_;
};

}  // namespace dymsum::planar
