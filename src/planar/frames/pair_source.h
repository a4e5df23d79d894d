// Exact positions of the vertices of a sum in motion.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "planar/frames/operand_pair.h"
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

}  // namespace dymsum::planar
