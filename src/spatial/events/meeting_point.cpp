#include "spatial/events/meeting_point.h"

#include <algorithm>

namespace dymsum::spatial {

using exact::BigInteger;

namespace {

/// A value and the sum of the sizes of its terms, to which its error is proportional.
struct Sized {
  double v = 0, size = 0;
};
Sized operator*(Sized a, Sized b) { return {a.v * b.v, a.size * b.size}; }
Sized operator-(Sized a, Sized b) { return {a.v - b.v, a.size + b.size}; }
Sized operator+(Sized a, Sized b) { return {a.v + b.v, a.size + b.size}; }
/// Entries are within 2^-53; a product of two 3 roundings, a minor 4, a product of two minors 9, a sum of six 14.
constexpr double kDeterminantError = 0x1p-48;

/// Determinants of four of the five columns of four rows, by minors of two rows each.
template <class T>
class Determinants {
 public:
  template <class Entry>
  explicit Determinants(Entry entry) {
    for (std::size_t half = 0; half < 2; ++half)
      for (std::size_t a = 0; a < 5; ++a)
        for (std::size_t b = a + 1; b < 5; ++b)
          minor_[half][a][b] =
              entry(2 * half, a) * entry(2 * half + 1, b) - entry(2 * half, b) * entry(2 * half + 1, a);
  }
  /// Columns 0 to 3, with column `out` replaced by the last one (none for 4).
  T with(std::size_t out) const {
    std::array<std::size_t, 4> c{0, 1, 2, 3};
    if (out < 4) c[out] = 4;
    return term(c, 0, 1, 2, 3) - term(c, 0, 2, 1, 3) + term(c, 0, 3, 1, 2) + term(c, 1, 2, 0, 3) - term(c, 1, 3, 0, 2) +
           term(c, 2, 3, 0, 1);
  }

 private:
  T term(const std::array<std::size_t, 4>& c, std::size_t i, std::size_t j, std::size_t k, std::size_t l) const {
    return of(0, c[i], c[j]) * of(1, c[k], c[l]);
  }
  T of(std::size_t half, std::size_t a, std::size_t b) const {
    return a < b ? minor_[half][a][b] : T{} - minor_[half][b][a];
  }
  T minor_[2][5][5];
};

ExactMeeting with_positive_weight(ExactMeeting at) {
  if (at.w < 0) {
    at.w = -at.w, at.s = -at.s;
    for (BigInteger& x : at.x) x = -x;
  }
  return at;
}

BigInteger big_dot3(const BigVector& a, const BigVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
BigVector corner_at(const MovingFacets& all, SumPoint c, const ExactMeeting& at) {
  const BigVector &f = all.exact_fixed(c), &m = all.exact_moved(c);
  return {f[0] * at.w + m[0] * at.s, f[1] * at.w + m[1] * at.s, f[2] * at.w + m[2] * at.s};
}

double largest(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// n . (e x g) for a border e of the facet and a gap g from its beginning, and a bound of its error.
Sized side_of_border(const MovingFacets& all, const SumFacet& facet, Vec3 n, int k, const NearMeeting& at) {
  const SumPoint a = facet.corner[k], b = facet.corner[(k + 1) % facet.corners];
  const Vec3 p = all.at(a, at.s), e = all.at(b, at.s) - p, g = at.x - p;
  const double reach = std::max(largest(all.moved(a)), largest(all.moved(b)));
  const double blur = 2 * (at.radius + at.s_radius * reach) + all.span(at.s) * 0x1p-48;
  const double E = std::abs(e.x) + std::abs(e.y) + std::abs(e.z), G = std::abs(g.x) + std::abs(g.y) + std::abs(g.z);
  return {dot(n, cross(e, g)), 8 * (blur * (E + G) + blur * blur + E * G * 0x1p-48)};
}

Vec3 normal_of(const PlaneRow& row) { return {row[0], row[1], row[2]}; }

}  // namespace

std::optional<ExactMeeting> meeting_of(const std::array<const MovingPlane*, 4>& planes) {
  const Determinants<BigInteger> det([&](std::size_t r, std::size_t c) -> BigInteger {
    const MovingPlane& p = *planes[r];
    return c < 3 ? p.n[c] : c == 3 ? BigInteger(-p.d1) : p.d0;
  });
  ExactMeeting at;
  at.w = det.with(4);
  if (at.w == 0) return std::nullopt;
  at.x = {det.with(0), det.with(1), det.with(2)};
  at.s = det.with(3);
  return with_positive_weight(std::move(at));
}

std::optional<ExactMeeting> meeting_of(const MovingFacets& all, SumPoint corner, const MovingPlane& plane) {
  const BigInteger a = big_dot3(plane.n, all.exact_fixed(corner)) - plane.d0,
                   b = big_dot3(plane.n, all.exact_moved(corner)) - plane.d1;
  if (b == 0) return std::nullopt;
  ExactMeeting at;
  at.s = b < 0 ? a : BigInteger(-a), at.w = abs(b);
  at.x = corner_at(all, corner, at);
  return at;
}

bool stays_in(const MovingFacets& all, SumPoint corner, const MovingPlane& plane) {
  return big_dot3(plane.n, all.exact_fixed(corner)) == plane.d0 &&
         big_dot3(plane.n, all.exact_moved(corner)) == plane.d1;
}

Meets meeting_near(const std::array<const PlaneRow*, 4>& rows, double span, NearMeeting& at) {
  const Determinants<Sized> det([&](std::size_t r, std::size_t c) -> Sized {
    return {(*rows[r])[c], std::abs((*rows[r])[c])};
  });
  const Sized w = det.with(4);
  const double least = std::abs(w.v) - w.size * kDeterminantError;
  if (!(least > 0)) return Meets::unsure;
  const auto solve = [&](std::size_t k, double& radius) {
    const Sized n = det.with(k);
    const double value = n.v / w.v;
    radius = std::max(radius,
                      (n.size + std::abs(value) * w.size) * kDeterminantError / least * 2 + std::abs(value) * 0x1p-50);
    return value;
  };
  at.radius = span * 0x1p-50, at.s_radius = 0;
  at.s = solve(3, at.s_radius);
  at.x = {solve(0, at.radius), solve(1, at.radius), solve(2, at.radius)};
  return Meets::near;
}

Meets meeting_near(const MovingFacets& all, SumPoint corner, const PlaneRow& row, double span, NearMeeting& at) {
  const Vec3 f = all.fixed(corner), m = all.moved(corner);
  const double a = row[0] * f.x + row[1] * f.y + row[2] * f.z - row[4],
               b = row[0] * m.x + row[1] * m.y + row[2] * m.z + row[3];
  const auto size = [&](Vec3 v) { return std::abs(row[0] * v.x) + std::abs(row[1] * v.y) + std::abs(row[2] * v.z); };
  const double ea = (size(f) + std::abs(row[4])) * 0x1p-49, eb = (size(m) + std::abs(row[3])) * 0x1p-49;
  const double least = std::abs(b) - eb;
  if (!(least > 0)) return std::abs(a) > ea && b == 0 && eb == 0 ? Meets::no : Meets::unsure;
  at.s = -a / b;
  at.s_radius = (ea + std::abs(at.s) * eb) / least * 2 + std::abs(at.s) * 0x1p-50;
  at.x = f + at.s * m;
  at.radius = largest(m) * at.s_radius + span * 0x1p-48;
  return Meets::near;
}

NearMeeting near(const ExactMeeting& at) {
  NearMeeting result;
  const auto value = [&](const BigInteger& n) { return exact::round_to_double(n, at.w); };
  result.x = {value(at.x[0]), value(at.x[1]), value(at.x[2])};
  result.s = value(at.s);
  result.radius = largest(result.x) * 0x1p-52, result.s_radius = result.s * 0x1p-52;
  return result;
}

bool may_hold(const MovingFacets& all, std::uint32_t f, const NearMeeting& at) {
  const SumFacet& facet = all.facets()[f];
  const Vec3 n = normal_of(all.row(f));
  for (int k = 0; k < facet.corners; ++k) {
    const Sized side = side_of_border(all, facet, n, k, at);
    if (side.v < -side.size) return false;
  }
  return true;
}

int surely_holds(const MovingFacets& all, std::uint32_t f, const NearMeeting& at) {
  const SumFacet& facet = all.facets()[f];
  const Vec3 n = normal_of(all.row(f));
  int holds = 1;
  for (int k = 0; k < facet.corners; ++k) {
    const Sized side = side_of_border(all, facet, n, k, at);
    if (side.v < -side.size) return -1;
    if (!(side.v > side.size)) holds = 0;
  }
  return holds;
}

bool may_hold(const MovingFacets& all, const MovingBorder& border, const NearMeeting& at) {
  const Vec3 a = all.at(border.a, at.s), b = all.at(border.b, at.s);
  const double reach = std::max(largest(all.moved(border.a)), largest(all.moved(border.b)));
  const double blur = 2 * (at.radius + at.s_radius * reach) + all.span(at.s) * 0x1p-48;
  const auto outside = [&](double x, double u, double v) {
    return x < std::min(u, v) - blur || x > std::max(u, v) + blur;
  };
  return !outside(at.x.x, a.x, b.x) && !outside(at.x.y, a.y, b.y) && !outside(at.x.z, a.z, b.z);
}

PlaceInFacet place_in(const MovingFacets& all, std::uint32_t f, const ExactMeeting& at, const NearMeeting& near) {
  const SumFacet& facet = all.facets()[f];
  const PlaneRow& row = all.row(f);
  const Vec3 n = normal_of(row);
  const double height = dot(n, near.x) + row[3] * near.s - row[4];
  if (std::abs(height) > 8 * (near.radius + near.s_radius * std::abs(row[3])) + 8 * all.span(near.s) * 0x1p-46)
    return {};
  const MovingPlane& plane = all.plane(f);
  if (big_dot3(plane.n, at.x) != plane.d0 * at.w + plane.d1 * at.s) return {};
  PlaceInFacet place{true, 0};
  for (int k = 0; k < facet.corners; ++k) {
    const Sized side = side_of_border(all, facet, n, k, near);
    if (side.v > side.size) continue;
    if (side.v < -side.size) return {};
    const BigVector a = corner_at(all, facet.corner[k], at),
                    b = corner_at(all, facet.corner[(k + 1) % facet.corners], at);
    const BigVector e{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, g{at.x[0] - a[0], at.x[1] - a[1], at.x[2] - a[2]};
    const BigVector turn{e[1] * g[2] - e[2] * g[1], e[2] * g[0] - e[0] * g[2], e[0] * g[1] - e[1] * g[0]};
    const int sign = big_dot3(plane.n, turn).sign();
    if (sign < 0) return {};
    if (sign == 0) place.on = static_cast<std::uint8_t>(place.on | (1U << k));
  }
  return place;
}

bool lies_on(const MovingFacets& all, const MovingBorder& border, const ExactMeeting& at) {
  const BigVector a = corner_at(all, border.a, at), b = corner_at(all, border.b, at);
  const BigVector e{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, g{at.x[0] - a[0], at.x[1] - a[1], at.x[2] - a[2]};
  if (e[1] * g[2] != e[2] * g[1] || e[2] * g[0] != e[0] * g[2] || e[0] * g[1] != e[1] * g[0]) return false;
  const BigInteger along = big_dot3(e, g);
  return along >= 0 && along <= big_dot3(e, e);
}

}  // namespace dymsum::spatial
