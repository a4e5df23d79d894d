#include "spatial/convex/exact_places.h"

#include <algorithm>

#include "exact/grid.h"
#include "spatial/convex/relative_map.h"

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

ExactPlaces::ExactPlaces(const SolidSum::Source& source, const SolidPose& p, const SolidPose& q) : source_(source) {
  const ExactPose a = ExactPose::of(p), b = ExactPose::of(q);
  for (int k = 0; k < 9; ++k) {
    matrix_[0][k] = a.matrix[k] * b.den;
    matrix_[1][k] = b.matrix[k] * a.den;
  }
  std::vector<double> all;
  for (const std::vector<Point3>& vertices : source.vertices)
    for (const Point3& v : vertices) all.insert(all.end(), {v.x, v.y, v.z});
  exponent_ = exact::common_exponent(all);
  const BigInteger den = a.den * b.den;
  unit_ = exponent_ >= 0 ? BigRational(BigInteger(BigInteger(1) << static_cast<unsigned>(exponent_)), den)
                         : BigRational(BigInteger(1), BigInteger(den << static_cast<unsigned>(-exponent_)));
}

BigVector ExactPlaces::of(int op, std::uint32_t v) const {
  const Point3& at = source_.vertices[op][v];
  const auto on = [&](double c) { return exact::grid_coordinate<exact::Big>(c, exponent_).value(); };
  const BigVector x{on(at.x), on(at.y), on(at.z)};
  BigVector y;
  for (int r = 0; r < 3; ++r) y[r] = matrix_[op][3 * r] * x[0] + matrix_[op][3 * r + 1] * x[1] + matrix_[op][3 * r + 2] * x[2];
  return y;
}

}  // namespace dymsum::spatial
