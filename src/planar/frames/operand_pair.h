// What never changes while an operand scales: the operands, their unscaled lattice and walks; and how everything is
// placed at a scale.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>

#include "dymsum/scaling_sum.h"
#include "planar/operand/scale_value.h"
#include "planar/result/sum_source.h"
#include "planar/sum/sum_engine.h"

namespace dymsum::planar {

class OperandPair : public std::enable_shared_from_this<OperandPair> {
 public:
  /// Errors: unsupported_operand.
  static Result<std::shared_ptr<const OperandPair>> create(const Region& p, const Region& q, std::uint32_t scaled,
                                                           int min_tier_bits);

  /// The same for operands, with further source vertices behind their own that belong to no walk.
  static Result<std::shared_ptr<const OperandPair>> create(const std::array<std::shared_ptr<const Operand>, 2>& kept,
                                                           const std::array<std::vector<Point>, 2>& further,
                                                           std::uint32_t scaled, int min_tier_bits);

  std::uint32_t scaled = 0;  ///< operand
  int min_tier_bits = 0;
  std::shared_ptr<const Lattice> lattice;  ///< at scale 1
  std::array<Operand, 2> operands;
  std::array<double, 2> width{}, height{};  ///< of the operands, in the lattice's doubles
  bool regular = true;                      ///< every component has area
  bool connected = true;                    ///< one component each

  LatticeScale lattice_scale(const ScaleValue& x, const ScaleValue& y) const;
  std::shared_ptr<const Lattice> lattice_at(const LatticeScale& scale) const;
  /// The walks with edge vectors of a lattice.
  std::shared_ptr<const Operand> operand_at(std::uint32_t op, const Lattice& at) const;
};

/// Exact positions at one scale; the lattice is made when first asked for.
class PairSource final : public ExactSource {
 public:
  PairSource(std::shared_ptr<const OperandPair> base, LatticeScale scale)
      : base_(std::move(base)), scale_(std::move(scale)) {}
  Position position(const SumVertex& vertex) const override { return source().position(vertex); }
  Homogeneous homogeneous(const SumVertex& vertex) const override { return source().homogeneous(vertex); }
  std::optional<NearFrame> near_frame() const override { return source().near_frame(); }
  NearPosition near(const SumVertex& vertex) const override { return source().near(vertex); }
  int compare_x(const SumVertex& a, const SumVertex& b) const override;
  int compare_y(const SumVertex& a, const SumVertex& b) const override;

 private:
  const SumSource& source() const;
  bool on_common_line(const SumVertex& a, const SumVertex& b, int axis) const;
  std::optional<int> compare_corners(const SumVertex& a, const SumVertex& b, int axis) const;
  std::shared_ptr<const OperandPair> base_;
  LatticeScale scale_;
  mutable std::once_flag made_;
  mutable std::unique_ptr<const SumSource> source_;
};

}  // namespace dymsum::planar
