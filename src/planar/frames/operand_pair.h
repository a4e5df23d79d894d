// What never changes while an operand moves: the operands, their lattice and walks as they were given; and how
// everything is placed at a scale.
#pragma once

#include <array>
#include <memory>

#include "planar/operand/scale_value.h"
#include "planar/sum/placed_sum.h"

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
  PlacedPair placed_on_lattice(std::shared_ptr<const Lattice> at) const;
};

}  // namespace dymsum::planar
