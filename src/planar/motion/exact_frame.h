// One frame: the exact scale, and exact signs at it, made when first asked for.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "planar/boundary/collision.h"
#include "planar/motion/operand_pair.h"
#include "planar/motion/orientation_sum.h"

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

// Whether faces of a frame of a rotating sum lie in the sum, exactly: the operands at one orientation, made when first
// asked for.

class ExactOverlap {
 public:
  ExactOverlap(std::shared_ptr<const OperandPair> base, Orientation theta)
      : base_(std::move(base)), theta_(std::move(theta)) {}

  /// Whether the face to the right of a sub-edge lies in the open sum: of a segment, from the crossing with one to that
  /// with another, without which it begins or ends with the segment.
  bool inside_right_of(const Segment& on, const std::optional<Segment>& from, const std::optional<Segment>& to);
  /// The walk edges of P and Q whose crossing was the reason, if that was it.
  std::optional<std::array<std::uint32_t, 2>> crossing_edges() const { return collision_->crossing_edges(); }
  std::uint64_t tests() const { return collision_ ? collision_->counts().tests : 0; }
  std::uint64_t exact_signs() const { return collision_ ? collision_->counts().signs.exact() : 0; }

 private:
  std::shared_ptr<const OperandPair> base_;
  Orientation theta_;
  std::optional<PlacedPair> placed_;
  std::optional<Collision> collision_;
};

}  // namespace dymsum::planar
