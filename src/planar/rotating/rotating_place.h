// The exact operands at one orientation, made when first asked for: positions and collision tests of a rotating sum.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>

#include "planar/boundary/collision.h"
#include "planar/turning/slice.h"

namespace dymsum::planar {

/// Exact positions at one orientation.
class TurnedSource final : public ExactSource {
 public:
  TurnedSource(std::shared_ptr<const OperandPair> base, Orientation theta)
      : base_(std::move(base)), theta_(std::move(theta)) {}
  Position position(const SumVertex& vertex) const override { return source().position(vertex); }
  Homogeneous homogeneous(const SumVertex& vertex) const override { return source().homogeneous(vertex); }
  std::optional<NearFrame> near_frame() const override { return source().near_frame(); }
  NearPosition near(const SumVertex& vertex) const override { return source().near(vertex); }
  int compare_x(const SumVertex& a, const SumVertex& b) const override;
  int compare_y(const SumVertex& a, const SumVertex& b) const override;

 private:
  const SumSource& source() const;
  int compare(const SumVertex& a, const SumVertex& b, int axis) const;
  std::optional<int> compare_corners(const SumVertex& a, const SumVertex& b, int axis) const;
  bool on_common_line(const SumVertex& a, const SumVertex& b, int axis) const;
  std::shared_ptr<const OperandPair> base_;
  Orientation theta_;
  mutable std::once_flag made_;
  mutable std::unique_ptr<const SumSource> source_;
};

/// Whether faces of a frame lie in the sum.
class RotatingPlace {
 public:
  RotatingPlace(std::shared_ptr<const OperandPair> base, Orientation theta)
      : base_(std::move(base)), theta_(std::move(theta)) {}

  /// Whether the face to the right of a sub-edge lies in the open sum: of a segment, from the crossing with one to that
  /// with another, without which it begins or ends with the segment.
  bool inside_right_of(const Segment& on, const std::optional<Segment>& from, const std::optional<Segment>& to);
  /// The walk edges of P and Q whose crossing was the reason, if that was it.
  std::optional<std::array<std::uint32_t, 2>> crossing_edges() const { return collision_->crossing_edges(); }
  std::uint64_t tests() const { return collision_ ? collision_->counts().tests : 0; }
  std::uint64_t exact_signs() const { return collision_ ? collision_->counts().exact : 0; }

 private:
  std::shared_ptr<const OperandPair> base_;
  Orientation theta_;
  std::optional<SumState> state_;
  std::optional<Collision> collision_;
};

}  // namespace dymsum::planar
