// What a ConvexSum holds.
#pragma once

#include <memory>
#include <optional>

#include "dymsum/convex_sum.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convex/kept_solid.h"
#include "spatial/gauss/overlay.h"

namespace dymsum {

class ConvexSum::State {
 public:
  State(std::shared_ptr<const spatial::Polytope> p, std::shared_ptr<const spatial::Polytope> q,
        std::shared_ptr<const spatial::ConvexOperands> source)
      : p(std::move(p)), q(std::move(q)), source(std::move(source)), overlay(*this->p, *this->q) {}

  std::shared_ptr<const spatial::Polytope> p, q;
  std::shared_ptr<const spatial::ConvexOperands> source;
  spatial::Overlay overlay;
  SolidPose p_pose, q_pose;
  spatial::PoseFactors p_factors, q_factors;
  MotionWork work;
  std::optional<spatial::KeptSolid> kept;  ///< from the first call of solid() on

  const spatial::Polytope& poly(int op) const { return op == 0 ? *p : *q; }
  const MotionWork& report();
  /// Keeps the poses and parses them; the map between the operands.
  spatial::RelativeMap move(const SolidPose& p_to, const SolidPose& q_to);
};

namespace spatial {

/// The number tier of two operands, as ConvexSum::tier_bits tells it.
int tier_bits(const Polytope& p, const Polytope& q);

/// What the rooms behind ConvexSum may do with it.
struct ConvexSumInternals {
  using State = ConvexSum::State;
  /// The sum at the identity; out_of_memory where more than `memory` bytes would be held (0: no limit).
  static Result<ConvexSum> of(std::shared_ptr<const Polytope> p, std::shared_ptr<const Polytope> q,
                              std::shared_ptr<const ConvexOperands> operands, std::uint64_t memory);
};
using ConvexState = ConvexSumInternals::State;

}  // namespace spatial
}  // namespace dymsum
