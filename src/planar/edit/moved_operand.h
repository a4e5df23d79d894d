// The operand of a region of which some vertices moved, from the operand before.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planar/edit/walk_changes.h"

namespace dymsum::planar {

/// The operands of one region from step to step. The one that is in use is never changed, as results refer to it; the
/// one before it becomes the next one by the moves that it lacks. So a step costs what it moves.
class OperandSteps {
 public:
  /// What make_operand makes of the region, of which `moved` vertices moved, in ascending order. Requires: no rings
  /// touch before or after. Null where the walk does not stay what it is: vertices that are straight or spikes before
  /// or after, coordinates in other units. Cost: a few operations a vertex that moved, and for each its steps among the
  /// directions; where an extreme vertex moves, O(n); where results still refer to the operand before the last one, a
  /// copy.
  std::shared_ptr<const Operand> next(const std::shared_ptr<const Operand>& before, const Region& after,
                                      std::span<const std::uint32_t> moved);
  /// What next() made, if it did; then moves() are those from the operand before it.
  const std::shared_ptr<Operand>& made() const { return made_; }
  const OperandMoves& moves() const { return moves_; }
  /// An operand is in use from now on: the one that next() made, or another one.
  void use(const std::shared_ptr<const Operand>& operand);

 private:
  std::shared_ptr<Operand> last_, used_, made_;  // the one in use was made from last_; made_ may be the next one
  OperandMoves lacks_, moves_;                   // the moves from last_ to used_, and from that to made_
};

}  // namespace dymsum::planar
