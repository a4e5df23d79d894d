// The exact positions of the vertices of a convex sum, made from its operands when they are requested.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "dymsum/convex_sum.h"
#include "spatial/convex/exact_positions.h"

namespace dymsum::spatial {

class ConvexPositions {
 public:
  ConvexPositions(std::shared_ptr<const ConvexOperands> operands, const SolidPose& p, const SolidPose& q,
                  std::vector<ConvexSum::Vertex> vertices);

  std::size_t size() const { return vertices_.size(); }
  /// Positions are numerators times unit().
  BigVector numerators(std::size_t vertex) const;
  std::vector<BigVector> numerators() const;
  const exact::BigRational& unit() const { return exactly().unit(); }

 private:
  const ExactPositions& exactly() const;

  std::shared_ptr<const ConvexOperands> operands_;
  SolidPose p_pose_, q_pose_;
  std::vector<ConvexSum::Vertex> vertices_;
  mutable std::once_flag made_;
  mutable std::optional<ExactPositions> exactly_;
};

}  // namespace dymsum::spatial
