// Results as the regions that they are times their least common denominator, and as closed sets: for comparing what is
// made of results with what is made of regions in integers.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "dymsum/planar_sum.h"
#include "exact_shape.h"
#include "pair_text.h"
#include "planar/position/exact_source.h"

namespace dymsum::oracles {

/// The least common denominator of all coordinates.
inline BigInt denominator_of(const PlanarSum& sum) {
  BigInt all = 1;
  const auto add = [&](const SumVertex& v) {
    const ExactSource::Position at = exact_source(sum)->position(v);
    for (const auto& c : {at.x, at.y})
      all = boost::multiprecision::lcm(all, BigInt(exact::BigInteger(denominator(c)).str()));
  };
  const auto add_ring = [&](const SumRing& ring) { std::for_each(ring.vertices.begin(), ring.vertices.end(), add); };
  for (const SumPart& part : sum.parts) {
    add_ring(part.outer);
    std::for_each(part.holes.begin(), part.holes.end(), add_ring);
  }
  for (const SumSegment& s : sum.segments) add(s.from), add(s.to);
  std::for_each(sum.points.begin(), sum.points.end(), add);
  return all;
}
/// The closed set of a result times an integer as a region; nothing where doubles do not hold it.
inline std::optional<RegionData> times_integer(const PlanarSum& sum, const BigInt& factor) {
  RegionData out;
  bool fits = true;
  const auto point = [&](const SumVertex& v) {
    const ExactSource::Position at = exact_source(sum)->position(v);
    const auto scaled = [&](const exact::BigRational& c) {
      const exact::BigRational product = c * exact::BigRational(exact::BigInteger(factor.str()));
      const double rounded = exact::round_to_double(product);
      fits &= exact::exact_value(rounded) == product;
      return rounded;
    };
    return Point{scaled(at.x), scaled(at.y)};
  };
  const auto ring = [&](const SumRing& r) {
    Ring points;
    for (const SumVertex& v : r.vertices) points.push_back(point(v));
    return points;
  };
  for (const SumPart& part : sum.parts) {
    out.parts.push_back({ring(part.outer), {}});
    for (const SumRing& hole : part.holes) out.parts.back().holes.push_back(ring(hole));
  }
  for (const SumSegment& s : sum.segments) out.polylines.push_back({point(s.from), point(s.to)});
  for (const SumVertex& v : sum.points) out.points.push_back(point(v));
  if (!fits) return std::nullopt;
  return out;
}

inline ExactShape<Big> canonical_shape(const PlanarSum& sum) { return canonical(exact_shape<Big>(sum)); }
inline ExactShape<Big> times_integer(const ExactShape<Big>& shape, const BigInt& factor) {
  const Big f(factor);
  return mapped(shape, {f, Big(0), Big(0), f, {Big(0), Big(0)}});
}

/// The closed set alone.
inline bool same_set(const PlanarSum& a, const PlanarSum& b) {
  ExactShape<Big> u = canonical_shape(a), v = canonical_shape(b);
  u.tight_points.clear(), u.tight_segments.clear(), v.tight_points.clear(), v.tight_segments.clear();
  return u == v;
}

}  // namespace dymsum::oracles
