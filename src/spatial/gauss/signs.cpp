#include "spatial/gauss/signs.h"

#include <algorithm>

namespace dymsum::spatial {
namespace {

using exact::Big;
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
