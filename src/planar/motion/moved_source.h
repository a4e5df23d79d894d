// Exact positions of the vertices of a sum in motion.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "dymsum/orientation.h"
#include "planar/motion/operand_pair.h"
#include "planar/result/sum_source.h"

namespace dymsum::planar {

/// The operands are placed when first asked for. Most comparisons of coordinates are decided without them.
class PairSource : public ExactSource {
 public:
  explicit PairSource(std::shared_ptr<const OperandPair> base) : base_(std::move(base)) {}
  Position position(const SumVertex& vertex) const final { return source().position(vertex); }
  Homogeneous homogeneous(const SumVertex& vertex) const final { return source().homogeneous(vertex); }
  std::optional<NearFrame> near_frame() const final { return source().near_frame(); }
  NearPosition near(const SumVertex& vertex) const final { return source().near(vertex); }
  int compare_x(const SumVertex& a, const SumVertex& b) const final { return compare(a, b, 0); }
  int compare_y(const SumVertex& a, const SumVertex& b) const final { return compare(a, b, 1); }

 protected:
  const OperandPair& base() const { return *base_; }

 private:
  virtual PlacedPair placed() const = 0;
  /// Whether upright and level edges of an operand are so in the sum.
  virtual bool keeps_axes(std::uint32_t op) const = 0;
  /// The order of two sums of vertices, where it can be told without placing the operands.
  virtual std::optional<int> compare_corners(const SumVertex& a, const SumVertex& b, int axis) const = 0;

  int compare(const SumVertex& a, const SumVertex& b, int axis) const;
  bool on_common_line(const SumVertex& a, const SumVertex& b, int axis) const;
  const SumSource& source() const;

  std::shared_ptr<const OperandPair> base_;
  mutable std::once_flag made_;
  mutable std::unique_ptr<const SumSource> source_;
};

// Exact positions of the vertices of a sum at one scale.

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

// Exact positions of the vertices of a sum at one orientation.

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
