#include "spatial/convolution/grid_space.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <stdexcept>

#include "base/parallel.h"
#include "exact/big.h"
#include "exact/fraction.h"
#include "exact/leading_digits.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::exact {

/// One residue for all: equal values have to have equal ones, and roots have none in general.
inline Residue residue(const RootValue&) { return 0; }
inline BinaryParts binary_parts(const RootValue& v) { return binary_parts(to_double(v)); }

}  // namespace dymsum::exact

namespace dymsum::spatial {

namespace {

using exact::Big;
using exact::cross;
using exact::dot;
using exact::Int;
using exact::sign;
using exact::Vector3;

template <class C>
C component(const Vector3<C>& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

template <class C>
C small(std::int64_t v) {
  if constexpr (std::is_same_v<C, Big>) {
    return Big::from_int64(v);
  } else {
    return C::from_int64(v);
  }
}

// The widths of the table in sum_space.h, checked for the fixed tiers.
template <int B>
constexpr bool widths_hold() {
  using E = decltype(Int<B>{} + Int<B>{});
  using N = decltype(E{} * E{} - E{} * E{});
  using D = decltype(dot(Vector3<N>{}, Vector3<E>{}));
  using Cross = decltype(N{} * N{} - N{} * N{});
  using X3 = decltype(D{} * Cross{} + D{} * Cross{} + D{} * Cross{});
  using W3 = decltype(dot(Vector3<N>{}, Vector3<Cross>{}));
  using Side3 = decltype(dot(Vector3<N>{}, Vector3<X3>{}) - D{} * W3{});
  return E::kBits == B + 1 && N::kBits == 2 * B + 3 && D::kBits == 3 * B + 6 && X3::kBits == 7 * B + 15 &&
         W3::kBits == 6 * B + 12 && Side3::kBits <= 9 * B + 21;
}
/// Points from the first one on, over the largest integer that divides all their coordinates; none where that is 1. At
/// a scale of a thousand digits, or under a matrix over a common denominator, an operand's coordinates are multiples of
/// one long factor, which its directions, and normals and determinants of these, then do without.
[[maybe_unused]] std::vector<Vector3<Big>> shortened(const std::vector<Vector3<Big>>& points) {
  using exact::BigInteger;
  BigInteger factor = 0;
  std::vector<Vector3<Big>> result;
  for (const Vector3<Big>& v : points) {
    const Vector3<Big>& d = result.emplace_back(v - points[0]);
    for (const Big& c : {d.x, d.y, d.z})
      if (factor != 1) factor = gcd(factor, c.value());
  }
  if (factor <= 1) return {};
  const auto over = [&](const Big& c) { return Big(BigInteger(c.value() / factor)); };
  for (Vector3<Big>& v : result) v = {over(v.x), over(v.y), over(v.z)};
  return result;
}

using exact::Fraction;
using exact::RootValue;

/// Numbers whose signs cost so much that intervals of seventy digits are asked first.
template <class C>
constexpr bool kHasWide = std::is_same_v<C, RootValue> || std::is_same_v<C, Fraction>;

/// Whether every coordinate has a residue: no denominator is a multiple of the prime.
template <class C>
bool have_residues(const std::vector<Vector3<C>>& points) {
  if constexpr (std::is_same_v<C, Fraction>) {
    const auto has_none = [](const Fraction& c) { return exact::residue(Big(c.below())) == 0; };
    return std::none_of(points.begin(), points.end(),
                        [&](const Vector3<Fraction>& v) { return has_none(v.x) || has_none(v.y) || has_none(v.z); });
  }
  return true;
}

static_assert(widths_hold<26>() && widths_hold<61>() && widths_hold<72>() && widths_hold<124>() && widths_hold<250>());

}  // namespace

template <class C>
GridSpace<C>::GridSpace(std::vector<Point> p, std::vector<Point> q, int bits, const Line (&lines)[3])
    : p_int_(std::move(p)), q_int_(std::move(q)), bits_(bits) {
  std::copy(std::begin(lines), std::end(lines), lines_);
  balance_axes();
  // Without residues of all, none has one: equal values have equal ones.
  const bool has_residues = have_residues(p_int_) && have_residues(q_int_);
  const auto fill = [&](const std::vector<Point>& from, std::vector<Vec3>& to,
                        std::vector<std::array<exact::Residue, 3>>& residues) {
    for (const Point& v : from) {
      to.push_back(near(v));
      if (has_residues) residues.push_back({exact::residue(v.x), exact::residue(v.y), exact::residue(v.z)});
      else residues.push_back({0, 0, 0});
    }
  };
  if constexpr (std::is_same_v<C, Big>) p_short_ = shortened(p_int_), q_short_ = shortened(q_int_);
  fill(p_int_, p_, p_residue_);
  fill(q_int_, q_, q_residue_);
  const auto largest = [](const std::vector<Vec3>& at) {
    double most = 0;
    for (const Vec3& v : at) most = std::max({most, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return most;
  };
  // The next power of two: rounding at 2^-53 of it does not matter.
  span_ = std::exp2(std::ceil(std::log2(std::max(largest(p_) + largest(q_), 1.0))) + 1);
  // Up to 51 bits, both coordinates and their sum are doubles. Else each is within 2^-52 of its size, and so is the
  // sum.
  sum_radius_ = bits <= 51 ? 0 : span_ * 0x1p-51;
}

/// Steps along an axis with fewer bits are longer, so that doubles along all axes are of about one size. They are whole
/// where doubles hold the largest ones, so that coordinates of few bits stay integers.
template <class C>
void GridSpace<C>::balance_axes() {
  constexpr int kMostDigits = 250;  // products of three coordinates, and volumes of doubles, stay far from overflow
  constexpr int kNone = INT_MIN;
  for (Line& line : lines_) line.unit = line.exponent;
  const bool one_grid = lines_[0].exponent == lines_[1].exponent && lines_[1].exponent == lines_[2].exponent;
  if (one_grid && bits_ <= kMostDigits) return;
  int top[3] = {kNone, kNone, kNone};
  for (const std::vector<Point>* points : {&p_int_, &q_int_}) {
    for (const Point& v : *points) {
      for (int axis = 0; axis < 3; ++axis) {
        const exact::BinaryParts c = exact::binary_parts(component(v, axis));
        if (!c.is_zero()) top[axis] = std::max(top[axis], c.exponent);
      }
    }
  }
  const int most = std::max({top[0], top[1], top[2]});
  for (int axis = 0; axis < 3; ++axis) {
    if (most == kNone || top[axis] == kNone) continue;
    shift_[axis] = std::min(most, kMostDigits) - (one_grid ? most : top[axis]);
    lines_[axis].unit -= shift_[axis];
  }
  for (int axis = 0; axis < 3; ++axis) normal_shift_[axis] = shift_[(axis + 1) % 3] + shift_[(axis + 2) % 3];
}

template <class C>
template <class X>
Vec3 GridSpace<C>::near(const Vector3<X>& v) const {
  return {exact::binary_parts(v.x).scaled(shift_[0]), exact::binary_parts(v.y).scaled(shift_[1]),
          exact::binary_parts(v.z).scaled(shift_[2])};
}

template <class C>
Vector3<typename GridSpace<C>::Edge> GridSpace<C>::direction(DirectionSource w) const {
  if constexpr (std::is_same_v<C, Fraction>)
    if (w.of != DirectionSource::Of::axis) return kept_direction(w);
  const auto between = [&](const std::vector<Point>& points, const std::vector<Point>& shorter) {
    const std::vector<Point>& of = shorter.empty() ? points : shorter;
    return of[w.to] - of[w.from];
  };
  if (w.of == DirectionSource::Of::p) return between(p_int_, p_short_);
  if (w.of == DirectionSource::Of::q) return between(q_int_, q_short_);
  return {small<Edge>(w.from == 0), small<Edge>(w.from == 1), small<Edge>(w.from == 2)};
}

template <class C>
Vector3<typename GridSpace<C>::Edge> GridSpace<C>::kept_direction(DirectionSource w) const {
  if constexpr (std::is_same_v<C, Fraction>) {
    const bool in_p = w.of == DirectionSource::Of::p;
    const std::vector<Point>& of = in_p ? p_int_ : q_int_;
    const std::uint64_t key = (static_cast<std::uint64_t>(std::min(w.from, w.to)) << 32) | std::max(w.from, w.to);
    auto& kept = directions_[in_p ? 0 : 1];
    const auto found = [&]() -> std::optional<Vector3<Edge>> {
      const std::lock_guard lock(directions_mutex_);
      const auto at = kept.find(key);
      return at == kept.end() ? std::nullopt : std::optional(at->second);
    };
    std::optional<Vector3<Edge>> upward = found();
    if (!upward) {
      upward = exact::integral(of[std::max(w.from, w.to)] - of[std::min(w.from, w.to)]);
      const std::lock_guard lock(directions_mutex_);
      kept.emplace(key, *upward);
    }
    return w.from < w.to ? *upward : Vector3<Edge>{-upward->x, -upward->y, -upward->z};
  } else {
    return {};
  }
}

template <class C>
Vector3<typename GridSpace<C>::Edge> GridSpace<C>::along(const SumEdge& e) const {
  return e.from.q == e.to.q ? direction({DirectionSource::Of::p, e.from.p, e.to.p})
                            : direction({DirectionSource::Of::q, e.from.q, e.to.q});
}

template <class C>
Vector3<typename GridSpace<C>::Normal> GridSpace<C>::normal(const PlaneSource& source) const {
  if (source.v.of == DirectionSource::Of::axis) {
    // u x axis: components of u, one of them turned over.
    const auto u = direction(source.u);
    const Normal x = u.x, y = u.y, z = u.z, zero = small<Normal>(0);
    const exact::Vector3<Normal> n = source.v.from == 0   ? exact::Vector3<Normal>{zero, z, -u.y}
                                     : source.v.from == 1 ? exact::Vector3<Normal>{-u.z, zero, x}
                                                          : exact::Vector3<Normal>{y, -u.x, zero};
    return source.reversed ? exact::Vector3<Normal>{Normal(-n.x), Normal(-n.y), Normal(-n.z)} : n;
  }
  return source.reversed ? cross(direction(source.v), direction(source.u))
                         : cross(direction(source.u), direction(source.v));
}

template <class C>
PlaneId GridSpace<C>::add_planes(std::span<const PlaneSource> sources, int threads) {
  const auto first = static_cast<PlaneId>(n_.size());
  const std::size_t all = n_.size() + sources.size();
  n_.resize(all), plane_residues_.resize(all), planes_.resize(all);
  plane_sources_.insert(plane_sources_.end(), sources.begin(), sources.end());
  constexpr std::size_t kPart = 512;
  base::parallel_parts((sources.size() + kPart - 1) / kPart, threads, [&](std::size_t part) {
    for (std::size_t k = part * kPart; k < std::min(sources.size(), (part + 1) * kPart); ++k)
      set_plane(first + static_cast<PlaneId>(k), sources[k]);
  });
  return first;
}

template <class C>
void GridSpace<C>::set_plane(PlaneId id, const PlaneSource& source) {
  const auto n = normal(source);
  n_[id] = n;
  plane_residues_[id] = residue_of(source);
  const exact::BinaryParts parts[3] = {exact::binary_parts(n.x), exact::binary_parts(n.y), exact::binary_parts(n.z)};
  int top = INT_MIN;
  for (int axis = 0; axis < 3; ++axis)
    if (!parts[axis].is_zero()) top = std::max(top, parts[axis].exponent + normal_shift_[axis]);
  const auto scaled = [&](int axis) { return parts[axis].scaled(normal_shift_[axis] - top); };
  Plane plane{{scaled(0), scaled(1), scaled(2)}, 0, 0, 0};
  plane.d = dot(plane.n, approx(source.at));
  plane.norm1 = (std::abs(plane.n.x) + std::abs(plane.n.y) + std::abs(plane.n.z)) * (1 + 0x1p-50);
  // Conversions of normals err by 2^-52 of each term, those of sums by 2^-51, products and sums by 2^-53: of the
  // offset, that of a sum, as well as of any other height 10 of these for every term at most. Underflows by less than
  // the last summand.
  plane.slack = (plane.norm1 * span_ + std::abs(plane.d)) * 0x1p-48 + 0x1p-1000;
  planes_[id] = plane;
}

namespace {

template <class C>
constexpr bool kOneType = std::is_same_v<C, Big> || kHasWide<C>;

}  // namespace

template <class C>
auto GridSpace<C>::of_edge(const PointSource& point) const {
  const SumEdge& edge = edges_[point.a];
  const auto from = sum(edge.from);
  const auto d = along(edge);
  const auto& n = n_[point.b];
  const auto h = dot(n, from) - offset(point.b);
  const auto w = dot(n, d);
  const auto x = from.x * w - d.x * h, y = from.y * w - d.y * h, z = from.z * w - d.z * h;
  return Homogeneous<decltype(from.x * w - d.x * h), decltype(dot(n, d))>{{x, y, z}, w};
}

template <class C>
auto GridSpace<C>::of_planes(const PointSource& point) const {
  const auto &a = n_[point.a], &b = n_[point.b], &c = n_[point.c];
  const auto bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const auto da = offset(point.a), db = offset(point.b), dc = offset(point.c);
  const auto x = da * bc.x + db * ca.x + dc * ab.x, y = da * bc.y + db * ca.y + dc * ab.y,
             z = da * bc.z + db * ca.z + dc * ab.z;
  const auto w = dot(a, bc);
  return Homogeneous<decltype(da * bc.x + db * ca.x + dc * ab.x), decltype(dot(a, bc))>{{x, y, z}, w};
}

template <class C>
typename GridSpace<C>::template Homogeneous<C, C> GridSpace<C>::of_any(const PointSource& point) const {
  if constexpr (kOneType<C>) {
    if (point.kind == PointSource::Kind::sum) return {sum({point.a, point.b}), C::from_int64(1)};
    return point.kind == PointSource::Kind::edge ? of_edge(point) : of_planes(point);
  } else {
    return {};
  }
}

// A question about points of one type is compiled once.
template <class C>
template <class F>
auto GridSpace<C>::with_point(const PointSource& point, F f) const {
  if constexpr (kOneType<C>) {
    return f(of_any(point));
  } else {
    using W = Int<1>;
    if (point.kind == PointSource::Kind::sum) return f(Homogeneous<Edge, W>{sum({point.a, point.b}), W::from_int64(1)});
    return point.kind == PointSource::Kind::edge ? f(of_edge(point)) : f(of_planes(point));
  }
}

namespace {

template <class C>
constexpr exact::Rung kExactRung = kOneType<C> ? exact::Rung::big : exact::Rung::integers;

/// Integers of up to 124 bits cost no more than pairs of doubles that are queried first: most signs that doubles leave
/// open are zeros, which pairs leave open too.
template <class C>
constexpr bool has_fine() {
  if constexpr (kOneType<C>) return true;
  else return C::kBits > 124;
}

}  // namespace

template <class C>
const FineSpace* GridSpace<C>::fine() const {
  if constexpr (has_fine<C>()) {
    std::call_once(fine_once_, [&] {
      const int top = std::ilogb(span_) + 1;
      const auto of = [&](const std::vector<Point>& points) {
        std::vector<FineSpace::Vector> result;
        result.reserve(points.size());
        const auto coordinate = [&](const C& c, int axis) {
          if constexpr (kOneType<C>) return fine_coordinate(c, shift_[axis] - top);
          else return exact::leading_digits(c, shift_[axis] - top);
        };
        for (const Point& v : points) result.push_back({coordinate(v.x, 0), coordinate(v.y, 1), coordinate(v.z, 2)});
        return result;
      };
      fine_ = std::make_unique<FineSpace>(of(p_int_), of(q_int_), plane_sources_, edges_);
    });
  }
  return fine_.get();
}

template <class C>
const WideSpace* GridSpace<C>::wide() const {
  if constexpr (kHasWide<C>) {
    std::call_once(wide_once_, [&] {
      const int top = std::ilogb(span_) + 1;
      const auto of = [&](const std::vector<Point>& points) {
        std::vector<WideSpace::Vector> result;
        result.reserve(points.size());
        for (const Point& v : points)
          result.push_back({wide_coordinate(v.x, shift_[0] - top), wide_coordinate(v.y, shift_[1] - top),
                            wide_coordinate(v.z, shift_[2] - top)});
        return result;
      };
      wide_ = std::make_unique<WideSpace>(of(p_int_), of(q_int_), plane_sources_, edges_);
    });
  }
  return wide_.get();
}

template <class C>
template <class Query>
std::optional<int> GridSpace<C>::by_intervals(Query query) const {
  if constexpr (has_fine<C>()) {
    if (const std::optional<int> s = query(*fine())) {
      count(exact::Rung::double_pairs);
      return s;
    }
  }
  if constexpr (kHasWide<C>) {
    if (const std::optional<int> s = query(*wide())) {
      count(exact::Rung::integers);
      return s;
    }
  }
  return std::nullopt;
}

template <class C>
template <class Query, class Exactly>
int GridSpace<C>::by_rungs(Query query, Exactly exactly) const {
  if (const std::optional<int> s = by_intervals(query)) return *s;
  count(kExactRung<C>);
  return exactly();
}

template <class C>
int GridSpace<C>::exact_side(PlaneId plane, SumPoint point) const {
  return by_rungs([&](const auto& space) { return space.side(plane_sources_[plane], point); },
                  [&] { return sign(dot(n_[plane], sum(point) - sum(plane_sources_[plane].at))); });
}

template <class C>
int GridSpace<C>::exact_side(PlaneId plane, const PointSource& point) const {
  return by_rungs([&](const auto& space) { return space.side(plane_sources_[plane], point); },
                  [&] {
                    const Offset d = offset(plane);
                    return with_point(point,
                                      [&](const auto& h) { return sign(dot(n_[plane], h.x) - d * h.w) * sign(h.w); });
                  });
}

template <class C>
int GridSpace<C>::exact_twist(const SumEdge& a, const SumEdge& b) const {
  return by_rungs([&](const auto& space) { return space.twist(a, b); },
                  [&] { return sign(dot(cross(along(a), along(b)), sum(b.from) - sum(a.from))); });
}

template <class C>
int GridSpace<C>::exact_rise(PlaneId plane, const SumEdge& edge) const {
  return sign(dot(n_[plane], along(edge)));
}

template <class C>
int GridSpace<C>::exact_det(PlaneId a, PlaneId b, PlaneId c) const {
  return by_rungs([&](const auto& space) { return space.det(a, b, c); },
                  [&] { return sign(dot(n_[a], cross(n_[b], n_[c]))); });
}

template <class C>
int GridSpace<C>::exact_cross(PlaneId a, PlaneId b, int axis) const {
  const auto &n = n_[a], &m = n_[b];
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return sign(component(n, i) * component(m, j) - component(n, j) * component(m, i));
}

template <class C>
int GridSpace<C>::exact_dot(PlaneId a, PlaneId b) const {
  return sign(dot(n_[a], n_[b]));
}

template <class C>
int GridSpace<C>::exact_normal(PlaneId plane, int axis) const {
  return sign(component(n_[plane], axis));
}

template <class C>
int GridSpace<C>::same_plane(PlaneId a, PlaneId b) const {
  if (a == b) return 1;
  const auto c = cross(n_[a], n_[b]);
  if (sign(c.x) != 0 || sign(c.y) != 0 || sign(c.z) != 0) return 0;
  int axis = 0;
  while (sign(component(n_[a], axis)) == 0) ++axis;
  const auto na = component(n_[a], axis), nb = component(n_[b], axis);
  if (sign(offset(a) * nb - offset(b) * na) != 0) return 0;
  return sign(na) * sign(nb);
}

template <class C>
bool GridSpace<C>::same_point(const PointSource& a, const PointSource& b) const {
  if (a == b) return true;
  return with_point(a, [&](const auto& x) {
    return with_point(b, [&](const auto& y) {
      return x.x.x * y.w == y.x.x * x.w && x.x.y * y.w == y.x.y * x.w && x.x.z * y.w == y.x.z * x.w;
    });
  });
}

template <class C>
int GridSpace<C>::exact_order(const PointSource& a, const PointSource& b, int axis) const {
  return by_rungs([&](const auto& space) { return space.order(a, b, axis); },
                  [&] {
                    return with_point(a, [&](const auto& x) {
                      return with_point(b, [&](const auto& y) {
                        return sign(component(y.x, axis) * x.w - component(x.x, axis) * y.w) * sign(x.w) * sign(y.w);
                      });
                    });
                  });
}

template <class C>
int GridSpace<C>::exact_det(DirectionSource u, DirectionSource v, DirectionSource w) const {
  return sign(dot(cross(direction(u), direction(v)), direction(w)));
}

template <class C>
int GridSpace<C>::exact_dot(DirectionSource u, DirectionSource v, DirectionSource w, DirectionSource x) const {
  return sign(dot(cross(direction(u), direction(v)), cross(direction(w), direction(x))));
}

template <class C>
int GridSpace<C>::exact_leading(DirectionSource w) const {
  return exact::leading_sign(direction(w));
}

template <class C>
int GridSpace<C>::exact_turn(DirectionSource r, DirectionSource u, DirectionSource v, DirectionSource w,
                             DirectionSource x) const {
  return sign(dot(direction(r), cross(cross(direction(u), direction(v)), cross(direction(w), direction(x)))));
}

template <class C>
int GridSpace<C>::exact_side(const PlaneSource& plane, const Flag& flag) const {
  // A step does not change a sign that is not zero.
  if (const std::optional<int> s = by_intervals([&](const auto& space) -> std::optional<int> {
        const std::optional<int> found = space.side(plane, flag.at);
        return found && *found != 0 ? found : std::nullopt;
      }))
    return *s;
  count(kExactRung<C>);
  const auto m = normal(plane);
  const Offset d = dot(m, sum(plane.at));
  const auto height = [&](const auto& h) { return sign(dot(m, h.x) - d * h.w) * sign(h.w); };
  const int at =
      flag.at.kind == PointSource::Kind::position ? height(positions_[flag.at.a].at) : with_point(flag.at, height);
  if (at != 0) return at;
  if (flag.direction != 0) {
    const int along = flag.direction * sign(dot(m, cross(n_[flag.plane], n_[flag.cut])));
    if (along != 0) return along;
  }
  if (flag.left != 0) {
    // n x (n x c) = n (n . c) - c (n . n).
    const auto &n = n_[flag.plane], &c = n_[flag.cut];
    const int left = flag.direction * sign(dot(m, n) * dot(n, c) - dot(m, c) * dot(n, n));
    if (left != 0) return left;
  }
  return flag.side == 0 ? 0 : flag.side * sign(dot(m, n_[flag.plane]));
}

template <class C>
int GridSpace<C>::exact_normal(const PlaneSource& plane, int axis) const {
  return sign(component(normal(plane), axis));
}

template <class C>
Approx GridSpace<C>::exact_approximation(const PointSource& point) const {
  if (point.kind == PointSource::Kind::position) return positions_[point.a].approx;
  count(kExactRung<C>);
  return with_point(point, [&](const auto& h) {
    // Both within 2^-51, the quotient rounded once more.
    const exact::BinaryParts den = exact::binary_parts(h.w);
    const auto quotient = [&](const auto& x, int axis) {
      const exact::BinaryParts num = exact::binary_parts(x);
      return std::ldexp(num.mantissa / den.mantissa, num.exponent - den.exponent + shift_[axis]);
    };
    const Vec3 at{quotient(h.x.x, 0), quotient(h.x.y, 1), quotient(h.x.z, 2)};
    const double size = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    return Approx{at, size * 0x1p-50};
  });
}

namespace {

template <class X, class W>
exact::BigRational quotient(const X& x, const W& w) {
  return exact::ratio(exact::to_big(x), exact::to_big(w));
}
exact::BigRational quotient(const Fraction& x, const Fraction& w) {
  return exact::ratio(Big(x.above() * w.below()), Big(x.below() * w.above()));
}

template <class X, class W>
std::array<exact::BigInteger, 4> integers_of(const Vector3<X>& x, const W& w) {
  return {exact::to_big(x.x).value(), exact::to_big(x.y).value(), exact::to_big(x.z).value(), exact::to_big(w).value()};
}
std::array<exact::BigInteger, 4> integers_of(const Vector3<Fraction>& x, const Fraction& w) {
  exact::BigInteger below = w.below();
  for (const Fraction* c : {&x.x, &x.y, &x.z})
    if (c->below() != below) below = lcm(below, c->below());
  const auto whole = [&](const Fraction& c) { return exact::BigInteger(c.above() * (below / c.below())); };
  return {whole(x.x), whole(x.y), whole(x.z), whole(w)};
}

}  // namespace

template <class C>
exact::BigRational GridSpace<C>::exact_coordinate(const PointSource& point, int axis) const {
  return with_point(point, [&](const auto& h) { return quotient(component(h.x, axis), h.w); });
}

template <class C>
std::array<exact::BigInteger, 4> GridSpace<C>::homogeneous(const PointSource& point) const {
  return with_point(point, [&](const auto& h) {
    std::array<exact::BigInteger, 4> v = integers_of(h.x, h.w);
    if (v[3].sign() < 0)
      for (exact::BigInteger& c : v) c = -c;
    return v;
  });
}

template <class C>
std::optional<PointSource> GridSpace<C>::add_position(const std::array<exact::BigRational, 3>& world) {
  std::array<exact::BigRational, 3> at, near;
  exact::BigInteger w = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Line& line = lines_[axis];
    const exact::BigInteger power = exact::BigInteger(1) << std::abs(line.exponent);
    at[axis] = world[axis] - exact::exact_value(line.p_offset) - exact::exact_value(line.q_offset);
    if (line.exponent >= 0) at[axis] /= power;
    else at[axis] *= power;
    near[axis] = at[axis];
    const exact::BigInteger step = exact::BigInteger(1) << std::abs(shift_[axis]);
    if (shift_[axis] >= 0) near[axis] *= step;
    else near[axis] /= step;
    if (abs(near[axis]) > exact::exact_value(span_)) return std::nullopt;
    w = lcm(w, denominator(at[axis]));
  }
  const auto over_w = [&](std::size_t axis) {
    return Big(exact::BigInteger(numerator(at[axis]) * (w / denominator(at[axis]))));
  };
  const double x = exact::round_to_double(near[0]), y = exact::round_to_double(near[1]),
               z = exact::round_to_double(near[2]);
  const bool is_near =
      exact::exact_value(x) == near[0] && exact::exact_value(y) == near[1] && exact::exact_value(z) == near[2];
  // Rounded to the nearest, or to a multiple of 2^-1074.
  const double size = std::max({std::abs(x), std::abs(y), std::abs(z)});
  positions_.push_back(
      {{{over_w(0), over_w(1), over_w(2)}, Big(w)}, {{x, y, z}, is_near ? 0 : size * 0x1p-50 + 0x1p-1000}});
  return PointSource{PointSource::Kind::position, static_cast<std::uint32_t>(positions_.size() - 1), 0, 0};
}

// Every width of coordinates that make_sum_space and the others choose from.
template class GridSpace<Int<26>>;
template class GridSpace<Int<61>>;
#ifndef __EMSCRIPTEN__  // kWidthOf72, AnyInteger
template class GridSpace<Int<72>>;
template class GridSpace<Big>;
#endif
template class GridSpace<Int<124>>;
template class GridSpace<Int<250>>;
template class GridSpace<RootValue>;
template class GridSpace<Fraction>;

}  // namespace dymsum::spatial
