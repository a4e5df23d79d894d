#include "spatial/convex/exact_positions.h"

#include <algorithm>
#include <optional>

#include "exact/grid.h"
#include "spatial/gauss/relative_map.h"

namespace dymsum::spatial {

using exact::BigInteger;
using exact::BigRational;

ExactPose ExactPose::of(const SolidPose& pose) {
  const PoseFactors f = PoseFactors::of(pose);
  const std::array<std::int64_t, 9> n = pose.rotation.matrix();
  const BigInteger all = f.den[0] * f.den[1] * f.den[2];
  ExactPose e;
  e.den = all * pose.rotation.norm();
  for (int k = 0; k < 9; ++k) e.matrix[k] = n[k] * f.num[k % 3] * (all / f.den[k % 3]);
  BigInteger d = e.den;
  for (const BigInteger& m : e.matrix)
    if (d != 1) d = gcd(d, m);
  if (d == 1) return e;
  e.den /= d;
  for (BigInteger& m : e.matrix) m /= d;
  return e;
}

ExactPositions::ExactPositions(const spatial::ConvexOperands& source, const SolidPose& p, const SolidPose& q)
    : source_(source) {
  const ExactPose a = ExactPose::of(p), b = ExactPose::of(q);
  for (int k = 0; k < 9; ++k) {
    matrix_[0][k] = a.matrix[k] * b.den;
    matrix_[1][k] = b.matrix[k] * a.den;
  }
  std::vector<double> all;
  for (const spatial::ConvexOperands::Operand& operand : source.operand)
    for (const Point3& v : operand.vertices) all.insert(all.end(), {v.x, v.y, v.z});
  std::optional<int> least;
  if (!all.empty()) least = exact::common_exponent(all);
  for (const spatial::ConvexOperands::Operand& operand : source.operand)
    if (!operand.exact.empty()) least = std::min(least.value_or(operand.exponent), operand.exponent);
  exponent_ = least.value_or(0);
  const BigInteger den = a.den * b.den;
  unit_ = exponent_ >= 0 ? BigRational(BigInteger(BigInteger(1) << static_cast<unsigned>(exponent_)), den)
                         : BigRational(BigInteger(1), BigInteger(den << static_cast<unsigned>(-exponent_)));
}

BigVector ExactPositions::of(int op, std::uint32_t v) const {
  const spatial::ConvexOperands::Operand& operand = source_.operand[op];
  BigVector x, y;
  if (operand.exact.empty()) {
    const Point3& at = operand.vertices[v];
    const auto on = [&](double c) { return exact::grid_coordinate<exact::Big>(c, exponent_).value(); };
    x = {on(at.x), on(at.y), on(at.z)};
  } else {
    const exact::Vector3<exact::Big>& at = operand.exact[v];
    const auto on = [&](const exact::Big& c) {
      return BigInteger(c.value() << static_cast<unsigned>(operand.exponent - exponent_));
    };
    x = {on(at.x), on(at.y), on(at.z)};
  }
  for (int r = 0; r < 3; ++r)
    y[r] = matrix_[op][3 * r] * x[0] + matrix_[op][3 * r + 1] * x[1] + matrix_[op][3 * r + 2] * x[2];
  return y;
}

}  // namespace dymsum::spatial
