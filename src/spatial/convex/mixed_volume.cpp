#include "spatial/convex/mixed_volume.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "spatial/convex/exact_positions.h"
#include "spatial/mesh/wide_sum.h"

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

BigMat big_cofactors(const BigMat& m) {
  return {exact::cross(m[1], m[2]), exact::cross(m[2], m[0]), exact::cross(m[0], m[1])};
}

BigRational power_of_two(int e) {
  const BigInteger v = BigInteger(1) << static_cast<unsigned>(e < 0 ? -e : e);
  return e < 0 ? BigRational(BigInteger(1), v) : BigRational(v);
}

/// Twice the area vector of a face, in grid units.
template <class C>
auto twice_area(const Polytope& p, std::uint32_t f) {
  const HalfEdge first = p.first[f];
  const auto a = p.position<C>(p.origin[first]);
  using Term = decltype((a - a).x * (a - a).y - (a - a).x * (a - a).y);
  exact::Vector3<WideSum<Term>> total;
  for (HalfEdge h = p.next[first]; p.next[h] != first; h = p.next[h]) {
    const auto n = exact::cross(p.position<C>(p.origin[h]) - a, p.position<C>(p.target(h)) - a);
    total.x.add(n.x);
    total.y.add(n.y);
    total.z.add(n.z);
  }
  return exact::Vector3<typename WideSum<Term>::Value>{total.x.value(), total.y.value(), total.z.value()};
}

/// The sum over the faces f of operand op of the matrices 2 |f| n_f x^T, x the vertex of the other one that is extreme
/// along n_f, in the units of the grids: in small integers, whatever the poses.
template <class C, class D>
BigMat moments(const Overlay& o, int op) {
  const Polytope &mine = o.poly(op), &other = o.poly(1 - op);
  using Area = decltype(twice_area<C>(mine, 0).x);
  exact::Matrix3<WideSum<decltype(Area{} * D{})>> sum;
  for (std::uint32_t f = 0; f < mine.face_count(); ++f) {
    const auto area = twice_area<C>(mine, f);
    const auto x = other.position<D>(o.extreme(op, f));
    for (auto&& [row, a] : {std::pair{&sum[0], &area.x}, {&sum[1], &area.y}, {&sum[2], &area.z}}) {
      row->x.add(*a * x.x);
      row->y.add(*a * x.y);
      row->z.add(*a * x.z);
    }
  }
  const auto big = [](const auto& row) {
    return BigVec{exact::to_big(row.x.value()), exact::to_big(row.y.value()), exact::to_big(row.z.value())};
  };
  return {big(sum[0]), big(sum[1]), big(sum[2])};
}

BigMat moments(const Overlay& o, int op) {
  const int bits = std::max(o.poly(0).bits, o.poly(1).bits);
  using exact::Int;
  if (bits <= 26) return moments<Int<26>, Int<26>>(o, op);
  if (bits <= 61) return moments<Int<61>, Int<61>>(o, op);
  return moments<Big, Big>(o, op);
}

/// Sum over the faces f of operand op of 2 |f| h(n_f) of the other one, in the units of the grids, up to the
/// denominators of the poses: of (C a) . (N x) = a^T (C^T N) x for the cofactors C of one matrix and the other one N.
Big twice_mixed(const Overlay& o, int op, const BigMat& mine, const BigMat& other) {
  const BigMat across = exact::transposed(big_cofactors(mine)), columns = exact::transposed(other),
               sum = moments(o, op);
  Big total = Big::from_int64(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const BigVec row{exact::dot(across[i], columns[0]), exact::dot(across[i], columns[1]),
                     exact::dot(across[i], columns[2])};
    total = total + exact::dot(row, sum[i]);
  }
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
  return over(p.six_volume * determinant(m), BigInteger(6 * da * da * da)) * u * u * u +
         over(q.six_volume * determinant(n), BigInteger(6 * db * db * db)) * w * w * w +
         over(twice_mixed(o, 0, m, n), BigInteger(2 * da * da * db)) * u * u * w +
         over(twice_mixed(o, 1, n, m), BigInteger(2 * db * db * da)) * w * w * u;
}

// Seen from vertex 0 of each operand, all terms are at least zero. Let N be a bound of the norms of the two matrices of
// a pose. A face's term, area . (cofactors^T map) x, errs by less than 2^-47 |area| N N |x|: matrices by 2^-49 of their
// entries, at most sqrt(3) 2^-49 N each in norm, both vectors by 2^-50, and products and sums round a dozen times; |x|
// is at most sqrt(3). Volumes err by 2^-48 of themselves. Sums are of at most a few terms or compensated.
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
