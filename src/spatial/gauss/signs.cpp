#include "spatial/gauss/signs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>

#include "exact/rounding_bound.h"

namespace dymsum::spatial {
namespace {

using exact::Big;
using exact::BigInteger;
using exact::i128;

/// N of a quaternion; of components of at most 2^62: entries at most 4 2^124.
template <class T>
std::array<T, 9> rotation_matrix(T w, T x, T y, T z) {
  return {w * w + x * x - y * y - z * z, 2 * (x * y - w * z),           2 * (x * z + w * y),
          2 * (x * y + w * z),           w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
          2 * (x * z - w * y),           2 * (y * z + w * x),           w * w - x * x - y * y + z * z};
}

/// Three numbers over one denominator as integers without common divisor: num[k] times the other two denominators.
std::array<BigInteger, 3> over_one_denominator(const std::array<BigInteger, 3>& num,
                                               const std::array<BigInteger, 3>& den) {
  std::array<BigInteger, 3> v{num[0] * den[1] * den[2], num[1] * den[0] * den[2], num[2] * den[0] * den[1]};
  const BigInteger d = gcd(gcd(v[0], v[1]), v[2]);
  for (BigInteger& c : v) c /= d;
  return v;
}

/// The same in machine words; nothing where a number has more than 20 bits.
std::optional<std::array<std::int64_t, 3>> words_over_one_denominator(const std::array<BigInteger, 3>& num,
                                                                      const std::array<BigInteger, 3>& den) {
  constexpr std::int64_t kMost = std::int64_t{1} << 20;
  std::array<std::int64_t, 3> n, d;
  for (std::size_t k = 0; k < 3; ++k) {
    if (num[k] > kMost || den[k] > kMost) return std::nullopt;
    n[k] = static_cast<std::int64_t>(num[k]);
    d[k] = static_cast<std::int64_t>(den[k]);
  }
  std::array<std::int64_t, 3> v{n[0] * d[1] * d[2], n[1] * d[0] * d[2], n[2] * d[0] * d[1]};
  const std::int64_t common = std::gcd(std::gcd(v[0], v[1]), v[2]);
  for (std::int64_t& c : v) c /= common;
  return v;
}

/// The least w with |values| < 2^w.
template <std::size_t N>
int width(const std::array<i128, N>& values) {
  int most = 0;
  for (const i128 v : values) {
    const i128 size = v < 0 ? -v : v;
    const auto high = static_cast<std::uint64_t>(size >> 64), low = static_cast<std::uint64_t>(size);
    most = std::max(most, static_cast<int>(high != 0 ? 64 + std::bit_width(high) : std::bit_width(low)));
  }
  return most;
}

double frobenius(const Mat3& m) { return std::sqrt(dot(m[0], m[0]) + dot(m[1], m[1]) + dot(m[2], m[2])); }

}  // namespace

PoseFactors PoseFactors::of(const SolidPose& pose) {
  PoseFactors f;
  f.rotation = pose.rotation;
  for (int k = 0; k < 3; ++k) {
    if (pose.scale[k] == Scale()) continue;
    f.scaled = true;
    f.num[k] = exact::numerator_of(pose.scale[k].exact());
    f.den[k] = exact::denominator_of(pose.scale[k].exact());
  }
  return f;
}

RelativeMap::RelativeMap(const PoseFactors& p, const PoseFactors& q) {
  set_rotation(p.rotation, q.rotation);
  rotation_ = !p.scaled && !q.scaled;
  if (!rotation_) set_scaled(p, q);
  approximate();
}

// R = R_P^-1 R_Q by the product of quaternions, without reduction: 2^30 2^30 4 = 2^62.
void RelativeMap::set_rotation(const Rotation& p, const Rotation& q) {
  const auto [aw, ax, ay, az] = p.quaternion();
  const auto [bw, bx, by, bz] = q.quaternion();
  if (q == Rotation() || p == Rotation()) {
    bits_ = 62;
    fixed_[0] = q == Rotation() ? rotation_matrix<i128>(aw, -ax, -ay, -az) : rotation_matrix<i128>(bw, bx, by, bz);
  } else {
    bits_ = 126;
    fixed_[0] = rotation_matrix<i128>(aw * bw + ax * bx + ay * by + az * bz, aw * bx - ax * bw - ay * bz + az * by,
                                      aw * by + ax * bz - ay * bw - az * bx, aw * bz - ax * by + ay * bx - az * bw);
  }
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) fixed_[1][3 * c + r] = fixed_[0][3 * r + c];
}

// D_P^-1 R D_Q and D_Q^-1 R^T D_P, each with positive factors that make integers of them.
void RelativeMap::set_scaled(const PoseFactors& p, const PoseFactors& q) {
  if (set_scaled_in_words(p, q)) return;
  const std::array<std::array<BigInteger, 3>, 2> left{over_one_denominator(p.den, p.num),
                                                      over_one_denominator(q.den, q.num)};
  const std::array<std::array<BigInteger, 3>, 2> right{over_one_denominator(q.num, q.den),
                                                       over_one_denominator(p.num, p.den)};
  unsigned most = 0;
  big_.resize(18);
  for (int index = 0; index < 2; ++index)
    for (int k = 0; k < 9; ++k) {
      const BigInteger v = exact::to_big(fixed_[index][k]).value() * left[index][k / 3] * right[index][k % 3];
      if (v != 0) most = std::max(most, static_cast<unsigned>(msb(BigInteger(abs(v)))) + 1);
      big_[9 * index + k] = Big(v);
    }
  set_big(most);
}

/// The same integers; false, and nothing is changed, where machine words may not hold them.
bool RelativeMap::set_scaled_in_words(const PoseFactors& p, const PoseFactors& q) {
  const auto p_down = words_over_one_denominator(p.den, p.num), q_down = words_over_one_denominator(q.den, q.num);
  const auto p_up = words_over_one_denominator(p.num, p.den), q_up = words_over_one_denominator(q.num, q.den);
  if (!p_down || !q_down || !p_up || !q_up) return false;
  const auto bits = [](const std::array<std::int64_t, 3>& v) { return width(std::array<i128, 3>{v[0], v[1], v[2]}); };
  if (width(fixed_[0]) + std::max(bits(*p_down) + bits(*q_up), bits(*q_down) + bits(*p_up)) > 126) return false;
  for (std::size_t k = 0; k < 9; ++k) {
    fixed_[0][k] *= static_cast<i128>((*p_down)[k / 3]) * (*q_up)[k % 3];
    fixed_[1][k] *= static_cast<i128>((*q_down)[k / 3]) * (*p_up)[k % 3];
  }
  bits_ = std::max(width(fixed_[0]), width(fixed_[1])) <= 62 ? 62 : 126;
  return true;
}

/// Sets the map from big_, whose entries are below 2^most; empty afterwards where 126 bits do.
void RelativeMap::set_big(unsigned most) {
  bits_ = most <= 62 ? 62 : most <= 126 ? 126 : static_cast<int>(most);
  if (bits_ > 126) return;
  for (int index = 0; index < 2; ++index)
    for (int k = 0; k < 9; ++k) fixed_[index][k] = exact::narrowed<exact::Int<126>>(big_[9 * index + k]).raw();
  big_.clear();
}

RelativeMap RelativeMap::turned(const std::array<BigInteger, 4>& quaternion) {
  const auto& [w, x, y, z] = quaternion;
  const std::array<BigInteger, 9> m = rotation_matrix<BigInteger>(w, -x, -y, -z);
  RelativeMap map;
  map.big_.resize(18);
  unsigned most = 0;
  for (int k = 0; k < 9; ++k) {
    if (m[k] != 0) most = std::max(most, static_cast<unsigned>(msb(BigInteger(abs(m[k])))) + 1);
    map.big_[k] = Big(m[k]);
    map.big_[9 + 3 * (k % 3) + k / 3] = Big(m[k]);
  }
  map.set_big(most);
  map.approximate();
  return map;
}

namespace {

// The error of a sign's form, times the sum of |u_i m_ij v_j|, which is at most the Frobenius norm: two unit vectors (8
// each), an entry (2), two products and the sums of three.
constexpr double kSignError = exact::rounding_bound(2 * 8 + 2 + 2 + 4, 32);
// The error of the norm of c T - I for T = L L_before^-1, times c and both norms. Entries of T err by 2 * 2 of the
// maps', 1 of the product and 2 of the sum, times the Frobenius norms, each at most sqrt(3) times the norm; c T and the
// difference are rounded, 2 of twice 3.
constexpr double kTurnError = exact::rounding_bound(3 * 7 + 2 * 3, 64);
// The same for a rotation, where c makes the norms 1: rows that are equally long are known to be so by 4 of their
// lengths besides.
constexpr double kRotationError = exact::rounding_bound(3 * (7 + 4) + 2 * 3, 1 << 15);

}  // namespace

void RelativeMap::approximate() {
  for (int index = 0; index < 2; ++index) {
    int top = 0;
    std::array<double, 9> d;
    if (bits_ <= 126) {
      double most = 0;
      for (int k = 0; k < 9; ++k) {
        d[k] = to_double(exact::Int<126>::from_raw(fixed_[index][k]));
        most = std::max(most, std::abs(d[k]));
      }
      top = std::ilogb(most);
      for (double& v : d) v *= exact::power_of_two(-top);
    } else {
      for (int k = 0; k < 9; ++k)
        if (sign(big_[9 * index + k]) != 0)
          top = std::max(top, static_cast<int>(msb(BigInteger(abs(big_[9 * index + k].value())))));
      // 2^-top of a number of up to thousands of bits, rounded once.
      const exact::BigRational unit(BigInteger(1), BigInteger(1) << static_cast<unsigned>(top));
      for (int k = 0; k < 9; ++k) d[k] = exact::round_to_double(exact::BigRational(big_[9 * index + k].value()) * unit);
    }
    approx_[index] = {Vec3{d[0], d[1], d[2]}, Vec3{d[3], d[4], d[5]}, Vec3{d[6], d[7], d[8]}};
    // Rows of a multiple of a rotation are equally long.
    norm_[index] = rotation_ ? length(approx_[index][0]) * exact::kOutwards : spectral_bound(approx_[index]);
    per_norm_[index] = 1 / norm_[index];
    error_[index] = kSignError * frobenius(approx_[index]);
  }
}

double spectral_bound(const Mat3& m) {
  const Mat3 s = transposed(m) * m, s2 = s * s, s4 = s2 * s2;
  return std::sqrt(std::sqrt(std::sqrt(frobenius(s4)))) * exact::kOutwards;
}

// Directions of Q's edges, seen from P, move by T = L L_before^-1 (up to a factor), normals by T^-T. On the straight
// path I + t E from the identity to T, E = T - I, a vector v is at most |E v| away from where it started, so it has
// turned by at most asin |E|; the inverse of I + t E differs from I by at most |E| / (1 - |E|). The sine of the angle
// bounds both.
//
// For a rotation by phi nothing is turned further than phi, and |E| in the Frobenius norm is 2 sqrt(2) sin(phi / 2).
double RelativeMap::angle_from(const RelativeMap& before) const {
  constexpr double kLarge = 4;
  Mat3 t = approx_[0] * before.approx_[1];
  const double trace = t[0].x + t[1].y + t[2].z;
  const bool turned = rotation_ && before.rotation_;
  if (!turned && !(trace > 0)) return kLarge;
  const double c = turned ? before.per_norm_[1] * per_norm_[0] : 3 / trace;
  for (int r = 0; r < 3; ++r) t[r] = c * t[r];
  t[0].x -= 1;
  t[1].y -= 1;
  t[2].z -= 1;
  if (turned) {
    const double half_sine = (frobenius(t) + kRotationError) / std::sqrt(8.0);
    return half_sine < 1 ? 2 * std::asin(half_sine) * exact::kOutwards : kLarge;
  }
  const double e = spectral_bound(t) + kTurnError * c * norm_[0] * before.norm_[1];
  if (!(e < 0.4)) return kLarge;
  return std::asin(e / (1 - e)) * exact::kOutwards;
}

namespace {

using exact::Int;

// Coordinates |X| <= 2^B and maps of W bits: normals 2B + 3, mapped edges B + W + 3, their product and the components
// of their cross product.
template <int B, int W>
struct ContactWidths {
  using Normal = typename exact::SpatialWidths<B>::Normal;
  using Edge = typename exact::SpatialWidths<B>::Edge;
  using Map = Int<W>;
  using Mapped = decltype(Map{} * Edge{} + Map{} * Edge{} + Map{} * Edge{});
  using Side = decltype(Normal{} * Mapped{} + Normal{} * Mapped{} + Normal{} * Mapped{});
  static_assert(Mapped::kBits == B + W + 3 && Side::kBits == 3 * B + W + 8);
};
static_assert(ContactWidths<26, 62>::Side::kBits == 148 && sizeof(ContactWidths<26, 62>::Side) == 24);
static_assert(ContactWidths<61, 126>::Side::kBits == 317 && sizeof(ContactWidths<61, 126>::Side) == 40);

}  // namespace

void Signs::set(const RelativeMap& map) {
  move(map);
  for (int op = 0; op < 2; ++op) {
    const std::vector<Vec3>& normal = poly_[op]->normal;
    row_[op].resize(normal.size());
    const Mat3& m = map_.approx(op);
    for (std::size_t f = 0; f < normal.size(); ++f) row_[op][f] = row_times(normal[f], m);
  }
}

int Signs::true_sign(int op, std::uint32_t f, HalfEdge h) const {
  const double v = value_now(op, f, h);
  if (v > map_.error(op)) return 1;
  if (v < -map_.error(op)) return -1;
  if (plainly_zero(op, f, h)) return 0;
  count_exact();
  return with_types([&](auto c, auto m) {
    using C = decltype(c);
    using M = decltype(m);
    return exact::sign(exact::dot(poly_[op]->template normal_vector<C>(f),
                                  exact::apply(map_.matrix<M>(op), poly_[1 - op]->template edge_vector<C>(h))));
  });
}

int Signs::near_zero_sign(int op, std::uint32_t f, HalfEdge h) const {
  const int tie = plain_tie(op, f, h);
  return tie != 0 ? tie : exact_sign(op, f, h);
}

namespace {

bool terms_zero(Vec3 a, Vec3 b) { return (a.x == 0 || b.x == 0) && (a.y == 0 || b.y == 0) && (a.z == 0 || b.z == 0); }

}  // namespace

/// The form of a sign in doubles, from . M^T with: of an edge mapped and a normal, or the other way round.
struct Signs::Form {
  Mat3 m;
  Vec3 from, with;
  std::array<bool, 3> zero;  // the components of the mapped vector whose terms all have a factor zero
};

Signs::Form Signs::form(int op, std::uint32_t f, HalfEdge h) const {
  const Vec3 n = poly_[op]->normal[f], e = poly_[1 - op]->along(h);
  Form x{op == 0 ? map_.approx(0) : transposed(map_.approx(1)), op == 0 ? e : n, op == 0 ? n : e, {}};
  for (std::size_t k = 0; k < 3; ++k) x.zero[k] = terms_zero(x.m[k], x.from);
  return x;
}

/// Whether the value is zero because every one of its terms has a factor zero, as for edges and faces along the axes
/// that a solid is scaled along or turned about. Doubles that stand for numbers of the two narrow kinds are zero only
/// where those are.
bool Signs::plainly_zero(const Form& x) const {
  if (!has_integers()) return false;
  return (x.zero[0] || x.with.x == 0) && (x.zero[1] || x.with.y == 0) && (x.zero[2] || x.with.z == 0);
}
bool Signs::plainly_zero(int op, std::uint32_t f, HalfEdge h) const { return plainly_zero(form(op, f, h)); }

/// The sign where the value is plainly zero and doubles determine which way the infinitesimal rotation goes; 0
/// otherwise.
int Signs::plain_tie(int op, std::uint32_t f, HalfEdge h) const {
  const Form x = form(op, f, h);
  if (!plainly_zero(x)) return 0;
  // The first component of mapped x with that is not zero, see below; its error is that of a value.
  std::array<double, 3> a;
  for (std::size_t k = 0; k < 3; ++k) a[k] = x.zero[k] ? 0 : dot(x.m[k], x.from);
  const std::array<double, 3> b{x.with.x, x.with.y, x.with.z};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    if ((x.zero[i] || b[j] == 0) && (x.zero[j] || b[i] == 0)) continue;
    const double c = a[i] * b[j] - a[j] * b[i];
    return c > map_.error(op) ? 1 : c < -map_.error(op) ? -1 : 0;
  }
  return 0;
}

// With Q rotated by epsilon about w = (1, delta, delta^2), epsilon << delta << 1, in P's coordinates: a mapped edge E
// of Q becomes E + epsilon w x E, and n . (w x E) = w . (E x n). A mapped normal N of Q becomes N + epsilon w x N, and
// (w x N) . e = w . (N x e). The vectors are perpendicular and not zero where the first term vanishes, so the second
// one never does.
int Signs::exact_sign(int op, std::uint32_t f, HalfEdge h) const {
  count_exact();
  return with_types([&](auto c, auto m) {
    using C = decltype(c);
    using M = decltype(m);
    const auto n = poly_[op]->template normal_vector<C>(f);
    const auto e = poly_[1 - op]->template edge_vector<C>(h);
    if (op == 0) {
      const auto mapped = exact::apply(map_.matrix<M>(0), e);
      if (const int s = exact::sign(exact::dot(n, mapped))) return s;
      return exact::leading_sign(exact::cross(mapped, n));
    }
    const auto mapped = exact::apply(exact::transposed(map_.matrix<M>(1)), n);
    if (const int s = exact::sign(exact::dot(mapped, e))) return s;
    return exact::leading_sign(exact::cross(mapped, e));
  });
}

}  // namespace dymsum::spatial
