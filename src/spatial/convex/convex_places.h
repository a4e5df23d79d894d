// The exact positions of the vertices of a convex sum, made from its operands when they are asked for.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "dymsum/convex_sum.h"
#include "spatial/convex/exact_places.h"

namespace dymsum::spatial {

class ConvexPlaces {
 public:
  ConvexPlaces(std::shared_ptr<const ConvexOperands> operands, const SolidPose& p, const SolidPose& q,
               std::vector<ConvexSum::Vertex> vertices);

  std::size_t size() const { return vertices_.size(); }
  /// Positions are numerators times unit().
  BigVector numerators(std::size_t vertex) const;
  std::vector<BigVector> numerators() const;
  const exact::BigRational& unit() const { return exactly().unit(); }

 private:
  const ExactPlaces& exactly() const;

  std::shared_ptr<const ConvexOperands> operands_;
  SolidPose p_pose_, q_pose_;
  std::vector<ConvexSum::Vertex> vertices_;
  mutable std::once_flag made_;
  mutable std::optional<ExactPlaces> exactly_;
};

}  // namespace dymsum::spatial
