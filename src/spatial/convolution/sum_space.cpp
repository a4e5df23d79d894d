#include "spatial/convolution/sum_space.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "spatial/convolution/grid_space.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {
namespace {

// One product and one sum of doubles round by at most 2^-53 of the result each; 16 times that covers every expression
// below.
constexpr double kRounding = 0x1p-49;

struct Value {
  double v = 0, error = 0;
};

/// The height of a point over a plane and its bound.
Value height(const Plane& plane, Vec3 at, double radius) {
  return {dot(plane.n, at) - plane.d, plane.slack + plane.norm1 * radius};
}

int sign_of(Value h) { return h.v > h.error ? 1 : h.v < -h.error ? -1 : 0; }

}  // namespace

EdgeId SumSpace::add_edges(std::span<const SumEdge> edges) {
  const auto first = static_cast<EdgeId>(edges_.size());
  edges_.insert(edges_.end(), edges.begin(), edges.end());
  return first;
}

bool SumSpace::made_from(PlaneId plane, SumPoint point) const {
  const PlaneSource& source = plane_sources_[plane];
  // From `at` along u, along v, or along both, where these are of different operands.
  SumPoint at = source.at;
  for (const DirectionSource* direction : {&source.u, &source.v}) {
    if (direction->of == DirectionSource::Of::p && point.p == direction->to && at.p == direction->from)
      at.p = direction->to;
    if (direction->of == DirectionSource::Of::q && point.q == direction->to && at.q == direction->from)
      at.q = direction->to;
  }
  return at == point;
}

int SumSpace::side(PlaneId plane, SumPoint point) const {
  const int s = sign_of(height(planes_[plane], approx(point), sum_radius_));
  return s != 0 || made_from(plane, point) ? s : exact_side(plane, point);
}

int SumSpace::side(PlaneId plane, const PointSource& point, const Approx& at) const {
  const int s = sign_of(height(planes_[plane], at.at, at.radius));
  if (s != 0) return s;
  if (point.kind == PointSource::Kind::planes && (point.a == plane || point.b == plane || point.c == plane)) return 0;
  if (point.kind == PointSource::Kind::edge && (point.b == plane || made_from(plane, EdgeId{point.a}))) return 0;
  if (point.kind == PointSource::Kind::sum && made_from(plane, SumPoint{point.a, point.b})) return 0;
  return exact_side(plane, point);
}

int SumSpace::det(PlaneId a, PlaneId b, PlaneId c) const {
  const Vec3 &n = planes_[a].n, &m = planes_[b].n, &k = planes_[c].n;
  // Components are at most 1 and relatively within 2^-51 of the exact ones: six products of three, rounded along the
  // way.
  const double v = dot(cross(n, m), k);
  if (v > 0x1p-45) return 1;
  if (v < -0x1p-45) return -1;
  return exact_det(a, b, c);
}

Vec3 SumSpace::approx(DirectionSource w) const {
  if (w.of == DirectionSource::Of::p) return p_[w.to] - p_[w.from];
  if (w.of == DirectionSource::Of::q) return q_[w.to] - q_[w.from];
  return {w.from == 0 ? 1.0 : 0.0, w.from == 1 ? 1.0 : 0.0, w.from == 2 ? 1.0 : 0.0};
}

int SumSpace::det(DirectionSource u, DirectionSource v, DirectionSource w) const {
  const Vec3 a = approx(u), b = approx(v), c = approx(w);
  const auto size = [&](Vec3 d) { return std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + 4 * sum_radius_; };
  const double A = size(a), B = size(b), C = size(c), value = dot(cross(a, b), c);
  if (computed_exactly(A, B, C)) return value > 0 ? 1 : value < 0 ? -1 : 0;
  const double error = A * B * C * 0x1p-48 + 8 * sum_radius_ * (A * B + B * C + C * A);
  return value > error ? 1 : value < -error ? -1 : exact_det(u, v, w);
}

Approx SumSpace::approximate(const PointSource& point) const {
  if (point.kind == PointSource::Kind::sum) return {approx(SumPoint{point.a, point.b}), sum_radius_};
  if (point.kind == PointSource::Kind::position) return exact_approximation(point);
  const double limit = span_ * 0x1p-30;
  if (point.kind == PointSource::Kind::edge) {
    const SumEdge& edge = edges_[point.a];
    const Plane& plane = planes_[point.b];
    const Vec3 from = approx(edge.from), to = approx(edge.to);
    const Value a = height(plane, from, sum_radius_), b = height(plane, to, sum_radius_);
    // The point is from + t (to - from), t = a / (a - b) in [0, 1] wherever an edge is cut.
    const double gap = a.v - b.v, gap_error = a.error + b.error + std::abs(gap) * kRounding;
    if (std::abs(gap) > 8 * gap_error) {
      const double t = a.v / gap;
      const double t_error =
          (a.error + std::abs(t) * gap_error) / (std::abs(gap) - gap_error) + std::abs(t) * kRounding;
      const Vec3 d = to - from;
      const double reach = std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + 4 * sum_radius_;
      const double radius = sum_radius_ + reach * t_error + (1 + std::abs(t)) * (span_ * kRounding + 4 * sum_radius_);
      if (radius < limit) return {from + t * d, radius};
    }
    return exact_approximation(point);
  }
  const Plane &a = planes_[point.a], &b = planes_[point.b], &c = planes_[point.c];
  const Vec3 bc = cross(b.n, c.n), ca = cross(c.n, a.n), ab = cross(a.n, b.n);
  const double w = dot(a.n, bc);
  constexpr double w_error = 0x1p-45;
  if (std::abs(w) > 8 * w_error) {
    // Cramer's rule: components of the products are at most 2, each off by 2^-47; offsets are off by less than 2^-49 of
    // the span times the sizes of the normal's components.
    const Vec3 x = a.d * bc + b.d * ca + c.d * ab;
    const double x_error =
        (std::abs(a.d) + std::abs(b.d) + std::abs(c.d)) * 0x1p-45 + (a.norm1 + b.norm1 + c.norm1) * span_ * 0x1p-48;
    const Vec3 at = (1 / w) * x;
    const double size = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    const double radius = (x_error + size * w_error) / (std::abs(w) - w_error) + size * kRounding;
    if (radius < limit) return {at, radius};
  }
  return exact_approximation(point);
}

exact::BigRational SumSpace::world_coordinate(const PointSource& point, int axis) const {
  const Line& line = lines_[axis];
  exact::BigRational v = exact_coordinate(point, axis);
  const exact::BigInteger power = exact::BigInteger(1) << std::abs(line.exponent);
  if (line.exponent >= 0) v *= power;
  else v /= power;
  return v + exact::exact_value(line.p_offset) + exact::exact_value(line.q_offset);
}

// Spaces for coordinates of all sizes: the narrowest integers that hold them.

namespace {

using exact::Big;
using exact::Fraction;
using exact::Int;
using exact::Vector3;

std::vector<double> coordinates(const std::vector<Point3>& points, double Point3::*axis) {
  std::vector<double> values;
  for (const Point3& p : points) values.push_back(p.*axis);
  return values;
}

using Line = SumSpace::Line;

/// The grid along one axis; `bits` is raised to what it needs.
Line common_line(const std::vector<Point3>& p, const std::vector<Point3>& q, double Point3::*axis, int& bits) {
  const std::vector<double> a = coordinates(p, axis), b = coordinates(q, axis);
  Line line;
  line.exponent = exact::common_exponent(a, b);
  const auto offset = [&](const std::vector<double>& values) {
    if (values.empty()) return 0.0;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double midpoint = exact::grid_center(*low, *high, line.exponent);
    bits = std::max(bits, exact::bits_needed(*low, *high, midpoint, line.exponent));
    return midpoint;
  };
  line.p_offset = offset(a);
  line.q_offset = offset(b);
  return line;
}

template <class C>
std::vector<Vector3<C>> on_grid(const std::vector<Point3>& points, const Line (&lines)[3], double Line::*offset) {
  std::vector<Vector3<C>> result;
  result.reserve(points.size());
  for (const Point3& v : points) {
    result.push_back({exact::grid_coordinate<C>(v.x, lines[0].*offset, lines[0].exponent),
                      exact::grid_coordinate<C>(v.y, lines[1].*offset, lines[1].exponent),
                      exact::grid_coordinate<C>(v.z, lines[2].*offset, lines[2].exponent)});
  }
  return result;
}

/// Coordinates in 128 bits, where products and sums of mapped positions stay within 126.
std::optional<std::vector<Vector3<exact::i128>>> mapped_in_words(const MappedPositions& p) {
  std::array<exact::i128, 9> m;
  int bits = 0;
  for (std::size_t k = 0; k < 9; ++k) {
    bits = std::max(bits, bit_length(Big(p.matrix[k])));
    if (bits > 124) return std::nullopt;
    m[k] = exact::narrowed<Int<124>>(Big(p.matrix[k])).raw();
  }
  if (p.positions.bits > 61 || p.positions.bits + bits > 124) return std::nullopt;
  std::vector<Vector3<exact::i128>> result;
  result.reserve(p.positions.grid.size());
  for (const auto& [x, y, z] : p.positions.grid)
    result.push_back({m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z, m[6] * x + m[7] * y + m[8] * z});
  for (const Vector3<Big>& v : p.further) {
    if (bit_length(v) > 124) return std::nullopt;
    const auto word = [](const Big& c) { return exact::narrowed<Int<124>>(c).raw(); };
    result.push_back({word(v.x), word(v.y), word(v.z)});
  }
  return result;
}

std::vector<Vector3<Big>> mapped_of_any_size(const MappedPositions& p) {
  exact::Matrix3<Big> m;
  for (std::size_t r = 0; r < 3; ++r) m[r] = {Big(p.matrix[3 * r]), Big(p.matrix[3 * r + 1]), Big(p.matrix[3 * r + 2])};
  std::vector<Vector3<Big>> result;
  const std::size_t count = p.positions.bits <= 61 ? p.positions.grid.size() : p.positions.big.size();
  for (std::uint32_t v = 0; v < count; ++v) result.push_back(exact::apply(m, p.positions.position<Big>(v)));
  result.insert(result.end(), p.further.begin(), p.further.end());
  return result;
}

int bits_of(const std::vector<Vector3<exact::i128>>& points) {
  exact::i128 most = 0;
  for (const Vector3<exact::i128>& v : points)
    for (const exact::i128 c : {v.x, v.y, v.z}) most = std::max(most, c < 0 ? -c : c);
  int bits = 0;
  while (bits < 126 && (exact::i128{1} << bits) < most) ++bits;
  return bits;
}

/// The number as a C, which holds it.
template <class C, class Word>
C number_of(const Word& v) {
  if constexpr (std::is_same_v<C, AnyInteger>) return C(exact::to_big(v));
  else if constexpr (std::is_same_v<Word, Big>) return exact::narrowed<C>(v);
  else return C::from_raw(exact::raw_cast<C::kBits>(v));
}

template <class C, class Word>
std::vector<Vector3<C>> narrowed_points(const std::vector<Vector3<Word>>& points) {
  std::vector<Vector3<C>> result;
  result.reserve(points.size());
  for (const Vector3<Word>& v : points) result.push_back({number_of<C>(v.x), number_of<C>(v.y), number_of<C>(v.z)});
  return result;
}

/// f(C{}) with the narrowest type of coordinates of so many bits.
template <class F>
std::unique_ptr<SumSpace> with_width(int bits, F f) {
  if (bits <= 26) return f(Int<26>{});
  if (bits <= 61) return f(Int<61>{});  // doubles of about one size
  if constexpr (kWidthOf72)
    if (bits <= 72) return f(Int<72>{});  // heights of slices: all digits of a double, next to operands of few
  if (bits <= 124) return f(Int<124>{});  // turned by quaternions; what rounding leaves of zeros, as in sin(pi)
  if (bits <= 250) return f(Int<250>{});  // turned by quaternions and of all digits, or with what rounding leaves
  if (bits <= kMostGridBits) return f(AnyInteger{});
  throw std::invalid_argument("coordinates of more than " + std::to_string(kMostGridBits) +
                              " bits on their common grid");
}

}  // namespace

std::unique_ptr<SumSpace> make_sum_space(const std::vector<Point3>& p, const std::vector<Point3>& q) {
  int bits = 0;
  const Line lines[3] = {common_line(p, q, &Point3::x, bits), common_line(p, q, &Point3::y, bits),
                         common_line(p, q, &Point3::z, bits)};
  return with_width(bits, [&]<class C>(C) -> std::unique_ptr<SumSpace> {
    return std::make_unique<GridSpace<C>>(on_grid<C>(p, lines, &Line::p_offset), on_grid<C>(q, lines, &Line::q_offset),
                                          bits, lines);
  });
}

std::unique_ptr<SumSpace> make_sum_space(const MappedPositions& p, const MappedPositions& q, int exponent) {
  const Line lines[3] = {{exponent, 0, 0}, {exponent, 0, 0}, {exponent, 0, 0}};
  const auto a = mapped_in_words(p), b = mapped_in_words(q);
  if (a && b) {
    const int bits = std::max(bits_of(*a), bits_of(*b));
    return with_width(bits, [&]<class C>(C) -> std::unique_ptr<SumSpace> {
      return std::make_unique<GridSpace<C>>(narrowed_points<C>(*a), narrowed_points<C>(*b), bits, lines);
    });
  }
  const std::vector<Vector3<Big>> big_p = mapped_of_any_size(p), big_q = mapped_of_any_size(q);
  int bits = 0;
  for (const std::vector<Vector3<Big>>* points : {&big_p, &big_q})
    for (const Vector3<Big>& v : *points) bits = std::max(bits, bit_length(v));
  return with_width(bits, [&]<class C>(C) -> std::unique_ptr<SumSpace> {
    return std::make_unique<GridSpace<C>>(narrowed_points<C>(big_p), narrowed_points<C>(big_q), bits, lines);
  });
}

std::unique_ptr<SumSpace> make_sum_space(const std::vector<Vector3<Fraction>>& p,
                                         const std::vector<Vector3<Fraction>>& q, int exponent) {
  const Line lines[3] = {{exponent, 0, 0}, {exponent, 0, 0}, {exponent, 0, 0}};
  int bits = 0;
  bool whole = true;
  for (const std::vector<Vector3<Fraction>>* points : {&p, &q}) {
    for (const Vector3<Fraction>& v : *points) {
      for (const Fraction* c : {&v.x, &v.y, &v.z}) {
        whole = whole && c->below() == 1;
        bits = std::max({bits, bit_length(Big(c->above())), bit_length(Big(c->below()))});
      }
    }
  }
  if (!whole || bits > kMostGridBits) return std::make_unique<GridSpace<Fraction>>(p, q, std::max(bits, 52), lines);
  return with_width(bits, [&]<class C>(C) -> std::unique_ptr<SumSpace> {
    const auto whole_points = [](const std::vector<Vector3<Fraction>>& points) {
      const auto number = [](const Fraction& c) { return number_of<C>(Big(c.above())); };
      std::vector<Vector3<C>> result;
      for (const Vector3<Fraction>& v : points) result.push_back({number(v.x), number(v.y), number(v.z)});
      return result;
    };
    return std::make_unique<GridSpace<C>>(whole_points(p), whole_points(q), bits, lines);
  });
}

std::unique_ptr<SumSpace> make_root_space(std::vector<Vector3<exact::RootValue>> p,
                                          std::vector<Vector3<exact::RootValue>> q, int bits) {
  const Line lines[3] = {};
  return std::make_unique<GridSpace<exact::RootValue>>(std::move(p), std::move(q), std::max(bits, 52), lines);
}

// Residues of points, planes and lines of sums: names that all sources of one of them share.

using exact::inverse;
using exact::minus;
using exact::plus;
using exact::Residue;
using exact::times;

/// All of a plane is whole numbers made from coordinates: so are its residues, from theirs.
SumSpace::PlaneResidue SumSpace::residue_of(const PlaneSource& source) const {
  using Residues = std::array<Residue, 3>;
  const auto direction = [&](const DirectionSource& w) {
    if (w.of == DirectionSource::Of::axis) return Residues{w.from == 0, w.from == 1, w.from == 2};
    const std::vector<Residues>& at = w.of == DirectionSource::Of::p ? p_residue_ : q_residue_;
    Residues d;
    for (std::size_t i = 0; i < 3; ++i) d[i] = minus(at[w.to][i], at[w.from][i]);
    return d;
  };
  const Residues u = direction(source.reversed ? source.v : source.u),
                 v = direction(source.reversed ? source.u : source.v);
  PlaneResidue plane{{}, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    plane.n[i] = minus(times(u[j], v[k]), times(u[k], v[j]));
    plane.d = plus(plane.d, times(plane.n[i], plus(p_residue_[source.at.p][i], q_residue_[source.at.q][i])));
  }
  return plane;
}

Residue SumSpace::hash_of_zero_weight(const PointSource& point) const {
  // The weight is a multiple of the prime. In lowest terms numerators and denominators decide.
  Residue hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const exact::BigRational v = exact_coordinate(point, axis);
    const Residue den = exact::residue(exact::Big(boost::multiprecision::denominator(v)));
    const Residue num = exact::residue(exact::Big(boost::multiprecision::numerator(v)));
    // A point whose own denominator the prime divides has this hash in every form; others get the common one.
    if (den == 0) return 0;
    constexpr Residue kFactor[3] = {1, 0x1234567890abcdefULL % exact::kResiduePrime,
                                    0x0fedcba987654321ULL % exact::kResiduePrime};
    hash = plus(hash, times(kFactor[axis], times(num, inverse(den))));
  }
  return hash;
}

std::vector<Residue> SumSpace::point_hashes(std::span<const PointSource> points) const {
  using Kind = PointSource::Kind;
  const auto coordinate = [&](SumPoint s, int i) { return plus(p_residue_[s.p][i], q_residue_[s.q][i]); };
  std::vector<std::array<Residue, 4>> values(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const PointSource& point = points[k];
    auto& [x, y, z, w] = values[k];
    if (point.kind == Kind::sum) {
      const SumPoint s{point.a, point.b};
      x = coordinate(s, 0), y = coordinate(s, 1), z = coordinate(s, 2), w = 1;
    } else if (point.kind == Kind::edge) {
      const SumEdge& edge = edges_[point.a];
      const PlaneResidue& r = plane_residues_[point.b];
      Residue from[3], d[3], h = minus(0, r.d), rise = 0;
      for (int i = 0; i < 3; ++i) {
        from[i] = coordinate(edge.from, i);
        d[i] = minus(coordinate(edge.to, i), from[i]);
        h = plus(h, times(r.n[i], from[i]));
        rise = plus(rise, times(r.n[i], d[i]));
      }
      w = rise;
      for (int i = 0; i < 3; ++i) values[k][i] = minus(times(from[i], rise), times(d[i], h));
    } else {
      const PlaneResidue* r[3] = {&plane_residues_[point.a], &plane_residues_[point.b], &plane_residues_[point.c]};
      x = y = z = w = 0;
      for (int i = 0; i < 3; ++i) {
        const PlaneResidue &m = *r[(i + 1) % 3], &n = *r[(i + 2) % 3];
        const Residue c0 = minus(times(m.n[1], n.n[2]), times(m.n[2], n.n[1]));
        const Residue c1 = minus(times(m.n[2], n.n[0]), times(m.n[0], n.n[2]));
        const Residue c2 = minus(times(m.n[0], n.n[1]), times(m.n[1], n.n[0]));
        x = plus(x, times(r[i]->d, c0)), y = plus(y, times(r[i]->d, c1)), z = plus(z, times(r[i]->d, c2));
        if (i == 0) w = plus(plus(times(r[0]->n[0], c0), times(r[0]->n[1], c1)), times(r[0]->n[2], c2));
      }
    }
  }
  // All inverses by one: products from the front, then back.
  std::vector<Residue> product(points.size()), result(points.size());
  Residue all = 1;
  for (std::size_t k = 0; k < points.size(); ++k) {
    product[k] = all;
    if (values[k][3] != 0) all = times(all, values[k][3]);
  }
  Residue back = inverse(all);
  for (std::size_t k = points.size(); k-- > 0;) {
    const auto& [x, y, z, w] = values[k];
    if (w == 0) {
      result[k] = hash_of_zero_weight(points[k]);
      continue;
    }
    const Residue i = times(back, product[k]);
    back = times(back, w);
    result[k] = plus(plus(times(x, i), times(times(y, i), 0x1234567890abcdefULL % exact::kResiduePrime)),
                     times(times(z, i), 0x0fedcba987654321ULL % exact::kResiduePrime));
  }
  return result;
}

std::vector<Residue> SumSpace::plane_hashes(PlaneId first, std::size_t count) const {
  // n and d over the first component of n that is not zero: the same for every multiple.
  std::vector<Residue> product(count), result(count);
  const auto leading = [&](const PlaneResidue& r) {
    return r.n[0] != 0 ? r.n[0] : r.n[1] != 0 ? r.n[1] : r.n[2] != 0 ? r.n[2] : 1;
  };
  Residue all = 1;
  for (std::size_t k = 0; k < count; ++k) {
    product[k] = all;
    all = times(all, leading(plane_residues_[first + k]));
  }
  Residue back = inverse(all);
  for (std::size_t k = count; k-- > 0;) {
    const PlaneResidue& r = plane_residues_[first + k];
    const Residue i = times(back, product[k]);
    back = times(back, leading(r));
    result[k] = plus(plus(times(r.n[0], i), times(times(r.n[1], i), 0x1234567890abcdefULL % exact::kResiduePrime)),
                     plus(times(times(r.n[2], i), 0x0fedcba987654321ULL % exact::kResiduePrime),
                          times(times(r.d, i), 0x1b873593cc9e2d51ULL % exact::kResiduePrime)));
  }
  return result;
}

void SumSpace::line_hashes(PlaneId plane, std::span<const PlaneId> cuts, std::vector<Residue>& hashes) const {
  // n x m and m d - n d' are the line's coordinates up to one factor: they are divided by the first component of n x m
  // that is not zero.
  const PlaneResidue& n = plane_residues_[plane];
  hashes.resize(cuts.size());
  thread_local std::vector<std::array<Residue, 2>> values;
  values.resize(cuts.size());
  Residue all = 1;
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const PlaneResidue& m = plane_residues_[cuts[k]];
    Residue direction[3], mixed = 0;
    constexpr Residue kFactor[6] = {1,
                                    0x1234567890abcdefULL % exact::kResiduePrime,
                                    0x0fedcba987654321ULL % exact::kResiduePrime,
                                    0x1b873593cc9e2d51ULL % exact::kResiduePrime,
                                    0x02d51e1b8735932dULL % exact::kResiduePrime,
                                    0x0b4c9e2d511b8735ULL % exact::kResiduePrime};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
      direction[i] = minus(times(n.n[j], m.n[l]), times(n.n[l], m.n[j]));
      mixed = plus(mixed, times(direction[i], kFactor[i]));
      mixed = plus(mixed, times(minus(times(m.n[i], n.d), times(n.n[i], m.d)), kFactor[3 + i]));
    }
    const Residue lead = direction[0] != 0 ? direction[0] : direction[1] != 0 ? direction[1] : direction[2];
    values[k] = {lead, mixed};
    hashes[k] = all;  // the product of all before
    if (lead != 0) all = times(all, lead);
  }
  Residue back = inverse(all);
  for (std::size_t k = cuts.size(); k-- > 0;) {
    const auto [lead, mixed] = values[k];
    if (lead == 0) {
      hashes[k] = 0;
      continue;
    }
    hashes[k] = times(mixed, times(back, hashes[k]));
    back = times(back, lead);
  }
}

}  // namespace dymsum::spatial
