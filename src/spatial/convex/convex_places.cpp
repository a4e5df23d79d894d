#include "spatial/convex/convex_places.h"

#include <array>
#include <utility>

namespace dymsum::spatial {
namespace {

BigVector sum_of(const BigVector& a, const BigVector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

}  // namespace

ConvexPositions::ConvexPositions(std::shared_ptr<const ConvexOperands> operands, const SolidPose& p, const SolidPose& q,
                                 std::vector<ConvexSum::Vertex> vertices)
    : operands_(std::move(operands)), p_pose_(p), q_pose_(q), vertices_(std::move(vertices)) {}

const ExactPositions& ConvexPositions::exactly() const {
  std::call_once(made_, [this] { exactly_.emplace(*operands_, p_pose_, q_pose_); });
  return *exactly_;
}

BigVector ConvexPositions::numerators(std::size_t vertex) const {
  const ConvexSum::Vertex& v = vertices_.at(vertex);
  return sum_of(exactly().of(0, v.p), exactly().of(1, v.q));
}

std::vector<BigVector> ConvexPositions::numerators() const {
  std::array<std::vector<std::optional<BigVector>>, 2> table;  // vertices of the sum share those of the operands
  for (std::size_t op = 0; op < 2; ++op) table[op].resize(operands_->operand[op].size());
  const auto at = [&](std::size_t op, std::uint32_t v) -> const BigVector& {
    if (!table[op][v]) table[op][v] = exactly().of(static_cast<int>(op), v);
    return *table[op][v];
  };
  std::vector<BigVector> all;
  all.reserve(vertices_.size());
  for (const ConvexSum::Vertex& v : vertices_) all.push_back(sum_of(at(0, v.p), at(1, v.q)));
  return all;
}

}  // namespace dymsum::spatial
