#include "spatial/convolution/sum_space.h"

#include <algorithm>

namespace dymsum::spatial {

namespace {

using exact::inverse;
using exact::minus;
using exact::plus;
using exact::Residue;
using exact::times;

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
  for (const Way* way : {&source.u, &source.v}) {
    if (way->of == Way::Of::p && point.p == way->to && at.p == way->from) at.p = way->to;
    if (way->of == Way::Of::q && point.q == way->to && at.q == way->from) at.q = way->to;
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

Vec3 SumSpace::approx(Way w) const {
  if (w.of == Way::Of::p) return p_[w.to] - p_[w.from];
  if (w.of == Way::Of::q) return q_[w.to] - q_[w.from];
  return {w.from == 0 ? 1.0 : 0.0, w.from == 1 ? 1.0 : 0.0, w.from == 2 ? 1.0 : 0.0};
}

int SumSpace::det(Way u, Way v, Way w) const {
  const Vec3 a = approx(u), b = approx(v), c = approx(w);
  const auto size = [&](Vec3 d) { return std::abs(d.x) + std::abs(d.y) + std::abs(d.z) + 4 * sum_radius_; };
  const double A = size(a), B = size(b), C = size(c), value = dot(cross(a, b), c);
  if (computed_exactly(A, B, C)) return value > 0 ? 1 : value < 0 ? -1 : 0;
  const double error = A * B * C * 0x1p-48 + 8 * sum_radius_ * (A * B + B * C + C * A);
  return value > error ? 1 : value < -error ? -1 : exact_det(u, v, w);
}

Approx SumSpace::approximate(const PointSource& point) const {
  if (point.kind == PointSource::Kind::sum) return {approx(SumPoint{point.a, point.b}), sum_radius_};
  if (point.kind == PointSource::Kind::place) return exact_approximation(point);
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
    Residue way[3], mixed = 0;
    constexpr Residue kFactor[6] = {1,
                                    0x1234567890abcdefULL % exact::kResiduePrime,
                                    0x0fedcba987654321ULL % exact::kResiduePrime,
                                    0x1b873593cc9e2d51ULL % exact::kResiduePrime,
                                    0x02d51e1b8735932dULL % exact::kResiduePrime,
                                    0x0b4c9e2d511b8735ULL % exact::kResiduePrime};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
      way[i] = minus(times(n.n[j], m.n[l]), times(n.n[l], m.n[j]));
      mixed = plus(mixed, times(way[i], kFactor[i]));
      mixed = plus(mixed, times(minus(times(m.n[i], n.d), times(n.n[i], m.d)), kFactor[3 + i]));
    }
    const Residue lead = way[0] != 0 ? way[0] : way[1] != 0 ? way[1] : way[2];
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
