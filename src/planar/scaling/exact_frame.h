// One frame: the exact scale, and exact signs at it, made when first asked for.
#pragma once

#include <memory>

#include "planar/boundary/collision.h"
#include "planar/frames/operand_pair.h"

namespace dymsum::planar {

class ExactFrame {
 public:
  ExactFrame(std::shared_ptr<const OperandPair> base, const ScaleValue& s)
      : base_(std::move(base)), value_(s), scale_(base_->lattice_scale(s)) {}

  const ScaleValue& value() const { return value_; }
  const LatticeScale& scale() const { return scale_; }
  const OperandPair& base() const { return *base_; }
  /// The parameter of a window whose operand `moving` moves.
  double tau(std::uint32_t moving) const;
  /// What the window's coordinates are multiplied by.
  double blow_up(std::uint32_t moving) const { return moving == base_->moved ? 1 : value_.approx; }

  const Lattice& lattice();
  const Operand& operand(std::uint32_t op);
  Collision& collision();
  bool has_lattice() const { return lattice_ != nullptr; }
  bool has_collision() const { return collision_ != nullptr; }
  PlacedPair placed();
  std::uint64_t exact_signs = 0;

 private:
  std::shared_ptr<const OperandPair> base_;
  ScaleValue value_;
  LatticeScale scale_;
  std::shared_ptr<const Lattice> lattice_;
  std::shared_ptr<const Operand> scaled_;
  std::unique_ptr<Collision> collision_;
};

}  // namespace dymsum::planar
