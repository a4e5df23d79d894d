#include "spatial/convex/exact_positions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "exact/grid.h"
#include "spatial/gauss/signs.h"

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

namespace {

Mat3 columns_scaled(const Mat3& m, const std::array<double, 3>& s) {
  Mat3 scaled;
  for (std::size_t r = 0; r < 3; ++r) scaled[r] = {m[r].x * s[0], m[r].y * s[1], m[r].z * s[2]};
  return scaled;
}

Mat3 rotation_in_doubles(const Rotation& rotation) {
  const std::array<std::int64_t, 9> n = rotation.matrix();
  const auto norm = static_cast<double>(rotation.norm());
  const auto at = [&](std::size_t k) { return static_cast<double>(n[k]) / norm; };
  return {Vec3{at(0), at(1), at(2)}, Vec3{at(3), at(4), at(5)}, Vec3{at(6), at(7), at(8)}};
}

}  // namespace

int exponent_of(const Mat3& m) {
  double most = 0;
  for (const Vec3& row : m) most = std::max({most, std::abs(row.x), std::abs(row.y), std::abs(row.z)});
  return std::ilogb(most);
}

Mat3 scaled_by_power(const Mat3& m, int exponent) {
  Mat3 scaled;
  for (std::size_t r = 0; r < 3; ++r)
    scaled[r] = {std::ldexp(m[r].x, exponent), std::ldexp(m[r].y, exponent), std::ldexp(m[r].z, exponent)};
  return scaled;
}

// Roundings of an entry: numerator, norm, their quotient, at most two factors, at most two products: 7 of 2^-53.
// Factors are between 2^-64 and 2^64 and entries of a rotation that are not zero at least 2^-62, so nothing underflows.
PosedDoubles::PosedDoubles(const PoseFactors& pose) {
  map = cofactors = rotation_in_doubles(pose.rotation);
  if (pose.scaled) {
    std::array<double, 3> s;
    for (std::size_t k = 0; k < 3; ++k) s[k] = exact::round_to_double(exact::BigRational(pose.num[k], pose.den[k]));
    map = columns_scaled(map, s);
    cofactors = columns_scaled(cofactors, {s[1] * s[2], s[2] * s[0], s[0] * s[1]});
    determinant = s[0] * s[1] * s[2];
  }
  exponent = exponent_of(map);
  cofactors_exponent = exponent_of(cofactors);
  map = scaled_by_power(map, -exponent);
  cofactors = scaled_by_power(cofactors, -cofactors_exponent);
  determinant = std::ldexp(determinant, -3 * exponent);
}

}  // namespace dymsum::spatial
