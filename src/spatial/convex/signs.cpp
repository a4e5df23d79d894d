#include "spatial/convex/signs.h"

namespace dymsum::spatial {
namespace {

using exact::Big;
using exact::Int;

// Coordinates |X| <= 2^B and maps of W bits: normals 2B + 3, mapped edges B + W + 3, their product and the components of their cross product.
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
  ++exact_signs_;
  return with_types([&](auto c, auto m) {
    using C = decltype(c);
    using M = decltype(m);
    return exact::sign(exact::dot(poly_[op]->template normal_vector<C>(f), exact::apply(map_.matrix<M>(op), poly_[1 - op]->template edge_vector<C>(h))));
  });
}

// With Q turned by epsilon about w = (1, delta, delta^2), epsilon << delta << 1, in P's coordinates: a mapped edge E of Q becomes
// E + epsilon w x E, and n . (w x E) = w . (E x n). A mapped normal N of Q becomes N + epsilon w x N, and (w x N) . e = w . (N x e). The vectors are
// perpendicular and not zero where the first term vanishes, so the second one never does.
int Signs::exact_sign(int op, std::uint32_t f, HalfEdge h) const {
  ++exact_signs_;
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
