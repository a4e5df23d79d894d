#include "spatial/events/meeting_point.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/doubles.h"

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

BigVector corner_at(const ScalingPair& all, SumPoint c, const ExactMeeting& at) {
  const BigVector &f = all.exact_fixed(c), &m = all.exact_moved(c);
  return {f[0] * at.w + m[0] * at.s, f[1] * at.w + m[1] * at.s, f[2] * at.w + m[2] * at.s};
}

double largest(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// n . (e x g) for a facet edge e of the facet and a gap g from its beginning, and a bound of its error.
Sized side_of_facet_edge(const MovingFacets& all, const SumFacet& facet, Vec3 n, int k, const NearMeeting& at) {
  const auto [a, b] = facet_edge_of(facet, k);
  const Vec3 p = all.at(a, at.s), e = all.at(b, at.s) - p, g = at.x - p;
  const double reach = std::max(largest(all.moved(a)), largest(all.moved(b)));
  const double blur = 2 * (at.radius + at.s_radius * reach) + all.span(at.s) * 0x1p-48;
  const double E = std::abs(e.x) + std::abs(e.y) + std::abs(e.z), G = std::abs(g.x) + std::abs(g.y) + std::abs(g.z);
  return {dot(n, cross(e, g)), 8 * (blur * (E + G) + blur * blur + E * G * 0x1p-48)};
}

/// The vectors from a facet edge's beginning to its end and to a point, times the point's weight.
struct AlongFacetEdge {
  BigVector direction, gap;
};
AlongFacetEdge along_facet_edge(const MovingFacets& all, const SumEdge& facet_edge, const ExactMeeting& at) {
  const BigVector a = corner_at(all, facet_edge.from, at);
  return {minus(corner_at(all, facet_edge.to, at), a), minus(at.x, a)};
}

bool may_lie_on(const MovingFacets& all, const SumEdge& facet_edge, const NearMeeting& at) {
  const Vec3 a = all.at(facet_edge.from, at.s), b = all.at(facet_edge.to, at.s);
  const double reach = std::max(largest(all.moved(facet_edge.from)), largest(all.moved(facet_edge.to)));
  const double blur = 2 * (at.radius + at.s_radius * reach) + all.span(at.s) * 0x1p-48;
  const auto outside = [&](double x, double u, double v) {
    return x < std::min(u, v) - blur || x > std::max(u, v) + blur;
  };
  return !outside(at.x.x, a.x, b.x) && !outside(at.x.y, a.y, b.y) && !outside(at.x.z, a.z, b.z);
}
bool lies_on(const MovingFacets& all, const SumEdge& facet_edge, const ExactMeeting& at) {
  const AlongFacetEdge to = along_facet_edge(all, facet_edge, at);
  if (!is_zero(cross(to.direction, to.gap))) return false;
  const BigInteger along = dot(to.direction, to.gap);
  return along >= 0 && along <= dot(to.direction, to.direction);
}

}  // namespace

std::optional<ExactMeeting> meeting_of(const FourPlanes& planes) {
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

std::optional<ExactMeeting> meeting_of(const ScalingPair& all, SumPoint corner, const MovingPlane& plane) {
  const BigInteger a = dot(plane.n, all.exact_fixed(corner)) - plane.d0,
                   b = dot(plane.n, all.exact_moved(corner)) - plane.d1;
  if (b == 0) return std::nullopt;
  ExactMeeting at;
  at.s = b < 0 ? a : BigInteger(-a), at.w = abs(b);
  at.x = corner_at(all, corner, at);
  return at;
}

bool stays_in(const ScalingPair& all, SumPoint corner, const MovingPlane& plane) {
  return dot(plane.n, all.exact_fixed(corner)) == plane.d0 && dot(plane.n, all.exact_moved(corner)) == plane.d1;
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

Meets meeting_near(const ScalingPair& all, SumPoint corner, const PlaneRow& row, double span, NearMeeting& at) {
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

int provably_holds(const MovingFacets& all, std::uint32_t f, const NearMeeting& at) {
  const SumFacet& facet = all.facets()[f];
  const Vec3 n = normal_of(all.row(f));
  int holds = 1;
  for (int k = 0; k < facet.corners; ++k) {
    const Sized side = side_of_facet_edge(all, facet, n, k, at);
    if (side.v < -side.size) return -1;
    if (!(side.v > side.size)) holds = 0;
  }
  return holds;
}

PositionInFacet position_in(const MovingFacets& all, std::uint32_t f, const ExactMeeting& at, const NearMeeting& near) {
  const SumFacet& facet = all.facets()[f];
  const PlaneRow& row = all.row(f);
  const Vec3 n = normal_of(row);
  const double height = dot(n, near.x) + row[3] * near.s - row[4];
  if (std::abs(height) > 8 * (near.radius + near.s_radius * std::abs(row[3])) + 8 * all.span(near.s) * 0x1p-46)
    return {};
  const MovingPlane& plane = all.plane(f);
  if (dot(plane.n, at.x) != plane.d0 * at.w + plane.d1 * at.s) return {};
  PositionInFacet position{true, 0};
  for (int k = 0; k < facet.corners; ++k) {
    const Sized side = side_of_facet_edge(all, facet, n, k, near);
    if (side.v > side.size) continue;
    if (side.v < -side.size) return {};
    const AlongFacetEdge to = along_facet_edge(all, facet_edge_of(facet, k), at);
    const int sign = dot(plane.n, cross(to.direction, to.gap)).sign();
    if (sign < 0) return {};
    if (sign == 0) position.on = static_cast<std::uint8_t>(position.on | (1U << k));
  }
  return position;
}

bool may_hold(const MovingFacets& all, const MeetingFeatures& features, const NearMeeting& at) {
  for (const std::uint32_t b : features.facet_edges)
    if (!may_lie_on(all, all.facet_edges()[b], at)) return false;
  for (const std::uint32_t f : features.facets)
    if (provably_holds(all, f, at) < 0) return false;
  return true;
}

bool hold(const MovingFacets& all, const MeetingFeatures& features, const ExactMeeting& at, const NearMeeting& near) {
  for (const std::uint32_t b : features.facet_edges)
    if (!lies_on(all, all.facet_edges()[b], at)) return false;
  for (const std::uint32_t f : features.facets)
    if (!position_in(all, f, at, near).holds) return false;
  return true;
}

namespace {

/// A facet edge as place + l way, l from 0 to `length` at a scale.
struct Line {
  Vec3 position, direction;
  double length;
};
Line line_of(const MovingFacets& all, const SumEdge& facet_edge, double s) {
  const bool scales = is_of_p(facet_edge) == (all.moving() == 0);
  return {all.at(facet_edge.from, s),
          scales ? all.moved(facet_edge.to) - all.moved(facet_edge.from)
                 : all.fixed(facet_edge.to) - all.fixed(facet_edge.from),
          scales ? s : 1};
}

/// How far along a line something is: -1 provably before its beginning, 1 provably after its end.
int beyond(double l, double error, double length) {
  return l < -error ? -1 : l > length * (1 + 0x1p-50) + error ? 1 : 0;
}

}  // namespace

bool LastingCrossing::stays_beside(const PlaneRow& row) const {
  if (!known) return false;
  const Vec3 n = normal_of(row);
  int sides[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const double v = dot(n, at[k]) + row[3] * scale[k] - row[4];
    const double size = sum_of_sizes(n) * sum_of_sizes(at[k]) + std::abs(row[3] * scale[k]) + std::abs(row[4]);
    const double error = 2 * sum_of_sizes(n) * blur + size * 0x1p-48;
    sides[k] = v > error ? 1 : v < -error ? -1 : 0;
  }
  return sides[0] * sides[1] > 0;
}

// a + l d = b + m h for the gap from a to b: gap x h = l (d x h) and gap x d = m (d x h).
LastingCrossing lasting_crossing_of(const MovingFacets& all, const SumEdge& one, const SumEdge& other, double low,
                                    double high) {
  LastingCrossing result;
  result.scale = {low, high};
  int ends[2][2];
  // Components of ways, places and gaps are off by less than this; it is more than what rounding adds to products.
  const double off = all.span(high) * 0x1p-49;
  for (std::size_t k = 0; k < 2; ++k) {
    const Line e = line_of(all, one, result.scale[k]), h = line_of(all, other, result.scale[k]);
    const Vec3 gap = h.position - e.position, n = cross(e.direction, h.direction);
    const double E = sum_of_sizes(e.direction), H = sum_of_sizes(h.direction), G = sum_of_sizes(gap),
                 N = sum_of_sizes(n);
    const double square = dot(n, n), square_error = 16 * off * (E + H) * N + 16 * off * off * (E + H) * (E + H);
    if (!(square > 2 * square_error)) return result;
    const auto along = [&](Vec3 across, double A, double& error) {
      const double l = dot(cross(gap, across), n) / square;
      error = 32 * off * ((G + A + off) * N + (G + off) * (A + off) * (E + H + off)) + 2 * std::abs(l) * square_error;
      error = error / (square - square_error) + std::abs(l) * 0x1p-48;
      return l;
    };
    double l_error = 0, m_error = 0;
    const double l = along(h.direction, H, l_error), m = along(e.direction, E, m_error);
    ends[0][k] = beyond(l, l_error, e.length), ends[1][k] = beyond(m, m_error, h.length);
    result.at[k] = e.position + l * e.direction;
    result.blur = std::max(result.blur, E * l_error + 4 * (1 + std::abs(l)) * off);
  }
  result.known = true;
  result.misses = ends[0][0] * ends[0][1] > 0 || ends[1][0] * ends[1][1] > 0;
  return result;
}

namespace {

bool is_same(const ExactMeeting& a, const ExactMeeting& b) {
  const auto equal = [&](const BigInteger& x, const BigInteger& y) { return x * b.w == y * a.w; };
  return equal(a.s, b.s) && equal(a.x[0], b.x[0]) && equal(a.x[1], b.x[1]) && equal(a.x[2], b.x[2]);
}

}  // namespace

bool MeetingList::is_covered(const NearMeeting& at) {
  const double step = std::ldexp(1.0, std::ilogb(span_) - 28), s_step = std::ldexp(1.0, std::ilogb(high_) - 28);
  if (at.radius > step || at.s_radius > s_step) return false;
  const auto cell = [](double v, double width) { return std::floor(v / width); };
  const double x = cell(at.x.x, step), y = cell(at.x.y, step), z = cell(at.x.z, step), s = cell(at.s, s_step);
  const auto [known, fresh] = covered_.try_emplace({static_cast<std::int64_t>(x), static_cast<std::int64_t>(y),
                                                    static_cast<std::int64_t>(z), static_cast<std::int64_t>(s)},
                                                   false);
  const Vec3 centre{(x + 0.5) * step, (y + 0.5) * step, (z + 0.5) * step};
  if (fresh)
    known->second = overlap_.at(centre, (s + 0.5) * s_step, 2 * step, 2 * s_step) == ScaledOverlap::Answer::overlap;
  return known->second;
}

void MeetingList::add(ExactMeeting at) {
  MeetingEvent event{std::move(at), {}};
  event.near = near(event.at);
  if (!is_in_window(event.near)) return;
  const auto bits = [](double v) { return base::bit_cast<std::int64_t>(v); };
  const GridCell key{bits(event.near.x.x), bits(event.near.x.y), bits(event.near.x.z), bits(event.near.s)};
  if (covered_at_.contains(key)) return;
  const auto [first, last] = found_at_.equal_range(key);
  for (auto k = first; k != last; ++k)
    if (is_same(found_[k->second].at, event.at)) return;
  if (overlap_.at(event.near.x, event.near.s, event.near.radius, event.near.s_radius) ==
      ScaledOverlap::Answer::overlap) {
    covered_at_.insert(key);
    return;
  }
  found_at_.emplace(key, found_.size());
  found_.push_back(std::move(event));
}

}  // namespace dymsum::spatial
