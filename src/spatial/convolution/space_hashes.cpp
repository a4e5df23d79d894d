// Residues of points, planes and lines of sums: names that all sources of one of them share.
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

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
