#include "spatial/convex/mixed_volume.h"

#include "spatial/convex/exact_places.h"

namespace dymsum::spatial {
namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using BigVec = exact::Vector3<Big>;
using BigMat = exact::Matrix3<Big>;

BigMat big_matrix(const ExactPose& pose) {
  const auto at = [&](int k) { return Big(pose.matrix[static_cast<std::size_t>(k)]); };
  return {BigVec{at(0), at(1), at(2)}, BigVec{at(3), at(4), at(5)}, BigVec{at(6), at(7), at(8)}};
}

BigMat big_cofactors(const BigMat& m) { return {exact::cross(m[1], m[2]), exact::cross(m[2], m[0]), exact::cross(m[0], m[1])}; }

/// Twice the area vector of a face, in grid units.
BigVec twice_area(const Polytope& p, std::uint32_t f) {
  const HalfEdge first = p.first[f];
  const BigVec a = p.place<Big>(p.origin[first]);
  BigVec total{Big::from_int64(0), Big::from_int64(0), Big::from_int64(0)};
  for (HalfEdge h = p.next[first]; p.next[h] != first; h = p.next[h])
    total = total + exact::cross(p.place<Big>(p.origin[h]) - a, p.place<Big>(p.target(h)) - a);
  return total;
}

BigRational power_of_two(int e) {
  const BigInteger v = BigInteger(1) << static_cast<unsigned>(e < 0 ? -e : e);
  return e < 0 ? BigRational(BigInteger(1), v) : BigRational(v);
}

/// Six times the volume of a polytope, in cubed grid units.
Big six_volume(const Polytope& p) {
  Big six = Big::from_int64(0);
  for (std::uint32_t f = 0; f < p.face_count(); ++f) six = six + exact::dot(twice_area(p, f), p.place<Big>(p.origin[p.first[f]]));
  return six;
}

/// Sum over the faces f of operand op of 2 |f| h(n_f) of the other one, in the units of the grids, up to the denominators of the poses.
Big twice_mixed(const Overlay& o, int op, const BigMat& mine, const BigMat& other) {
  const BigMat cof = big_cofactors(mine);
  Big total = Big::from_int64(0);
  for (std::uint32_t f = 0; f < o.poly(op).face_count(); ++f)
    total = total + exact::dot(exact::apply(cof, twice_area(o.poly(op), f)), exact::apply(other, o.poly(1 - op).place<Big>(o.extreme(op, f))));
  return total;
}

}  // namespace

exact::BigRational exact_mixed_volume(const Overlay& o, const SolidPose& p_pose, const SolidPose& q_pose) {
  const ExactPose a = ExactPose::of(p_pose), b = ExactPose::of(q_pose);
  const BigMat m = big_matrix(a), n = big_matrix(b);
  const Polytope &p = o.poly(0), &q = o.poly(1);
  const auto determinant = [](const BigMat& x) { return exact::dot(x[0], exact::cross(x[1], x[2])); };
  const auto over = [](const Big& v, const BigInteger& den) { return BigRational(v.value()) / BigRational(den); };
  const BigRational u = power_of_two(p.exponent), w = power_of_two(q.exponent);
  const BigInteger da = a.den, db = b.den;
  return over(six_volume(p) * determinant(m), BigInteger(6 * da * da * da)) * u * u * u +
         over(six_volume(q) * determinant(n), BigInteger(6 * db * db * db)) * w * w * w +
         over(twice_mixed(o, 0, m, n), BigInteger(2 * da * da * db)) * u * u * w +
         over(twice_mixed(o, 1, n, m), BigInteger(2 * db * db * da)) * w * w * u;
}

Mat3 pose_matrix(const PoseFactors& pose) {
  const std::array<std::int64_t, 9> n = pose.rotation.matrix();
  const double norm = static_cast<double>(pose.rotation.norm());
  std::array<double, 3> scale{1, 1, 1};
  if (pose.scaled)
    for (int k = 0; k < 3; ++k) scale[k] = exact::round_to_double(BigRational(pose.num[k], pose.den[k]));
  Mat3 m;
  for (int r = 0; r < 3; ++r)
    m[r] = {static_cast<double>(n[3 * r]) / norm * scale[0], static_cast<double>(n[3 * r + 1]) / norm * scale[1],
            static_cast<double>(n[3 * r + 2]) / norm * scale[2]};
  return m;
}

Mat3 cofactors(const Mat3& m) { return {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])}; }

double mixed_volume(const Overlay& o, const PoseFactors& p, const PoseFactors& q) {
  const std::array<Mat3, 2> m{pose_matrix(p), pose_matrix(q)};
  double total = 0;
  for (int op = 0; op < 2; ++op) {
    const Mat3 cof = cofactors(m[op]), across = transposed(cof) * m[1 - op];
    total += o.poly(op).volume * dot(m[op][0], cof[0]);
    for (std::uint32_t f = 0; f < o.poly(op).face_count(); ++f)
      total += dot(o.poly(op).area[f], across * o.poly(1 - op).at[o.extreme(op, f)]);
  }
  return total;
}

}  // namespace dymsum::spatial
