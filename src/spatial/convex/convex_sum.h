// What a sum of convex solids holds, and its facets from the overlay of their Gauss maps.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "dymsum/convex_sum.h"
#include "spatial/convex/exact_positions.h"
#include "spatial/convex/kept_solid.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

/// The facets of a sum without positions. Coplanar facets are one: in the outward direction of every face of P and Q
/// the facet is the sum of the features that are extreme there; every crossing of the interiors of two arcs gives a
/// parallelogram.
struct ConvexFacets {
  struct Facet {
    std::size_t first;  ///< its corners are corners[first], ...
    std::uint32_t count;
    bool changed;  ///< not there before the last move
    SolidFeature p, q;
  };
  std::vector<ConvexSum::Vertex> vertices;
  std::vector<std::uint32_t> corners;  ///< indices of vertices; of a facet counter-clockwise seen from outside
  std::vector<Facet> facets;
};
ConvexFacets assemble(const Overlay& overlay);

/// A corner of a facet of the generic sum, as vertices of P and Q: of face `id` of operand op with its extreme vertex,
/// or (op = 2) of a crossing.
std::pair<std::uint32_t, std::uint32_t> corner_of(const Overlay& overlay, int op, std::uint32_t id);

}  // namespace dymsum::spatial

namespace dymsum {

// What a ConvexSum holds.

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
