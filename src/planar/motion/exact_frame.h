// One frame, exactly: the operands where they stand, signs and collision tests there, and the positions of the sum's
// vertices. All of it is made when first requested.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>

#include "planar/boundary/collision.h"
#include "planar/motion/operand_pair.h"
#include "planar/result/sum_source.h"

namespace dymsum::planar {

class ExactFrame {
 public:
  ExactFrame(std::shared_ptr<const OperandPair> base, const ScaleValue& s)
      : base_(std::move(base)), value_(s), at_(base_->lattice_scale(s)) {}
  ExactFrame(std::shared_ptr<const OperandPair> base, Orientation theta)
      : base_(std::move(base)), at_(std::move(theta)) {}

  const OperandPair& base() const { return *base_; }
  const Placement& at() const { return at_; }
  const Lattice& lattice();
  const Operand& operand(std::uint32_t op);
  Collision& collision();
  bool has_lattice() const { return lattice_ != nullptr; }
  bool has_collision() const { return collision_ != nullptr; }
  PlacedPair placed();
  /// Whether the face to the right of a sub-edge lies in the open sum: of a segment, from the crossing with one to that
  /// with another, without which it begins or ends with the segment.
  bool inside_right_of(const Segment& on, const std::optional<Segment>& from, const std::optional<Segment>& to);
  std::uint64_t exact_signs = 0;  ///< without those of collision tests
  std::uint64_t all_signs() const { return exact_signs + (has_collision() ? collision_->counts().signs.exact() : 0); }

  /// What a scaling has: the scale, the parameter of a window whose operand `moving` moves, and what the window's
  /// coordinates are multiplied by.
  const ScaleValue& value() const { return value_; }
  const LatticeScale& scale() const { return std::get<LatticeScale>(at_); }
  double tau(std::uint32_t moving) const;
  double blow_up(std::uint32_t moving) const { return moving == base_->moved ? 1 : value_.approx; }

 private:
  std::shared_ptr<const OperandPair> base_;
  ScaleValue value_;
  Placement at_;
  std::shared_ptr<const Lattice> lattice_;
  std::array<std::shared_ptr<const Operand>, 2> operands_;
  std::unique_ptr<Collision> collision_;
};

/// Exact positions of the vertices of a frame's sum. The operands are placed when first requested. Most comparisons of
/// coordinates are decided without them.
class FrameSource final : public ExactSource {
 public:
  FrameSource(std::shared_ptr<const OperandPair> base, Placement at) : base_(std::move(base)), at_(std::move(at)) {}
  Position position(const SumVertex& vertex) const override { return source().position(vertex); }
  Homogeneous homogeneous(const SumVertex& vertex) const override { return source().homogeneous(vertex); }
  std::optional<NearFrame> near_frame() const override { return source().near_frame(); }
  NearPosition near(const SumVertex& vertex) const override { return source().near(vertex); }
  int compare_x(const SumVertex& a, const SumVertex& b) const override { return compare(a, b, 0); }
  int compare_y(const SumVertex& a, const SumVertex& b) const override { return compare(a, b, 1); }

 private:
  int compare(const SumVertex& a, const SumVertex& b, int axis) const;
  bool on_common_line(const SumVertex& a, const SumVertex& b, int axis) const;
  std::optional<int> compare_corners(const SumVertex& a, const SumVertex& b, int axis) const;
  const SumSource& source() const;

  std::shared_ptr<const OperandPair> base_;
  Placement at_;
  mutable std::once_flag made_;
  mutable std::unique_ptr<const SumSource> source_;
};

}  // namespace dymsum::planar
