// Sums as operands of further sums.
#include <algorithm>
#include <string>

#include "dymsum/spatial_sum.h"

namespace dymsum {

Result<Mesh> as_mesh(const SpatialSum& sum) {
  Result<SpatialSum::Rounded> rounded = sum.rounded();
  if (!rounded) return rounded.error();
  std::vector<bool> on_face(sum.vertices.size());
  for (const SpatialFace& face : sum.faces)
    for (const auto& loop : face.loops)
      for (const std::uint32_t v : loop) on_face[v] = true;
  for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
    if (!on_face[v]) continue;
    const RationalPoint3 exact = sum.exact(v);
    const Point3 p{exact.x.to_double(), exact.y.to_double(), exact.z.to_double()};
    const auto holds = [](double nearest, const Rational& value) {
      const Result<Rational> back = Rational::of(nearest);
      return back && *back == value;
    };
    if (holds(p.x, exact.x) && holds(p.y, exact.y) && holds(p.z, exact.z)) continue;
    Error error{
        ErrorCode::unsupported_operand, "a vertex of the sum is no operand's: no doubles hold its position", {}};
    error.evidence.x = p.x;
    error.evidence.y = p.y;
    error.evidence.z = p.z;
    return error;
  }
  return Mesh::create(std::move(rounded->mesh));
}

Result<SpatialSum> minkowski_sum(std::span<const Mesh> operands, const SpatialOptions& options) {
  if (operands.empty()) return Error{ErrorCode::unsupported_operand, "a sum needs an operand", {}};
  std::vector<const Mesh*> order;
  for (const Mesh& mesh : operands) order.push_back(&mesh);
  const auto rank = [](const Mesh* mesh) { return mesh->has_thin_parts() ? 2 : convexity_error(*mesh) ? 1 : 0; };
  std::stable_sort(order.begin(), order.end(), [&](const Mesh* a, const Mesh* b) { return rank(a) < rank(b); });
  const Mesh origin = Mesh::with_thin_parts({{{0, 0, 0}}, {{0}}}).value();
  if (order.size() == 1) order.push_back(&origin);
  SpatialOptions between = options;
  between.semantics = Semantics::regular;
  Mesh so_far = *order[0];
  for (std::size_t k = 1;; ++k) {
    const bool last = k + 1 == order.size();
    Result<SpatialSum> sum = minkowski_sum(so_far, *order[k], last ? options : between);
    if (last || !sum) return sum;
    Result<Mesh> mesh = as_mesh(*sum);
    if (!mesh) {
      Error error = mesh.error();
      error.message = "the sum of " + std::to_string(k + 1) + " of the operands: " + error.message;
      return error;
    }
    so_far = std::move(mesh).value();
  }
}

}  // namespace dymsum
