#include "spatial/convex/mixed_volume.h"

#include <algorithm>
#include <cmath>

#include "spatial/convex/compensated_sum.h"
#include "spatial/convex/exact_places.h"
#include "spatial/convex/posed_doubles.h"

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

// Seen from vertex 0 of each operand, all terms are at least zero. Let N be a bound of the norms of the two matrices of
// a pose. A face's term, area . (cofactors^T map) x, errs by less than 2^-47 |area| N N |x|: matrices by 2^-49 of their
// entries, at most sqrt(3) 2^-49 N each in norm, both vectors by 2^-50, and products and sums round a dozen times; |x| is at
// most sqrt(3). Volumes err by 2^-48 of themselves. Sums are of at most a few terms or compensated.
std::optional<double> mixed_volume(const Overlay& o, const PoseFactors& p, const PoseFactors& q) {
  const std::array<PosedDoubles, 2> pose{PosedDoubles(p), PosedDoubles(q)};
  std::array<double, 4> term{}, error{};
  std::array<int, 4> exponent{};
  for (int op = 0; op < 2; ++op) {
    const Polytope &mine = o.poly(op), &other = o.poly(1 - op);
    const PosedDoubles &m = pose[op], &n = pose[1 - op];
    const Mat3 across = transposed(m.cofactors) * n.map;
    CompensatedSum sum;
    for (std::uint32_t f = 0; f < mine.face_count(); ++f)
      sum.add(dot(mine.area[f], across * other.from_first[o.extreme(op, f)]));
    term[op] = mine.volume * m.determinant;
    error[op] = 0x1p-48 * term[op];
    exponent[op] = 3 * (mine.size + m.exponent);
    term[2 + op] = sum.value();
    error[2 + op] = 0x1p-47 * std::sqrt(3.0) * mine.total_area * spectral_bound(m.cofactors) * spectral_bound(n.map);
    exponent[2 + op] = 2 * mine.size + m.cofactors_exponent + other.size + n.exponent;
  }
  const int top = *std::max_element(exponent.begin(), exponent.end());
  double total = 0, most = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    total += std::ldexp(term[k], exponent[k] - top);
    most += std::ldexp(error[k], exponent[k] - top);
  }
  if (most > kMixedVolumeError * total) return std::nullopt;
  return std::ldexp(total, top);
}

}  // namespace dymsum::spatial
