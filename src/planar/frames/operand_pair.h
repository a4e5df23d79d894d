// What never changes while an operand moves: the operands, their lattice and walks as they were given; and how
// everything is placed at a scale.
#pragma once

#include <array>
#include <memory>

#include "planar/operand/operand.h"
#include "planar/operand/placed_pair.h"
#include "planar/operand/scale_value.h"

namespace dymsum::planar {

/// What numbers a pair may have: all of them for sums at rest, narrow ones (not Lattice::wide) for those that move.
enum class Spread { narrow, any };

class OperandPair : public std::enable_shared_from_this<OperandPair> {
 public:
  /// Of operands, with further source vertices behind their own that belong to no walk. Errors: unsupported_operand.
  static Result<std::shared_ptr<const OperandPair>> create(const std::array<std::shared_ptr<const Operand>, 2>& kept,
                                                           const std::array<std::vector<Point>, 2>& further,
                                                           std::uint32_t moved, int min_tier_bits,
                                                           Spread spread = Spread::narrow);

  std::uint32_t moved = 0;  ///< the operand that is scaled or turned
  int min_tier_bits = 0;
  std::shared_ptr<const Lattice> lattice;  ///< as they were given
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
