// What the tests of uncertain regions have in common: subsets, members, exact points.
#pragma once

#include <utility>
#include <vector>

#include "dymsum/planar_boolean.h"
#include "dymsum/set_check.h"
#include "dymsum/shapes.h"
#include "oracles/membership.h"
#include "oracles/numbers.h"
#include "oracles/random.h"
#include "oracles/tiny_regions.h"

namespace dymsum::oracles {

inline Region polygon(Ring outer, std::vector<Ring> holes = {}) {
  return *Region::create({{{std::move(outer), std::move(holes)}}, {}, {}});
}
inline Region box(double x0, double y0, double x1, double y1) { return shapes::rectangle(x0, y0, x1, y1); }
inline Region origin() { return *Region::create({{}, {}, {{0, 0}}}); }

/// Segments and points count as well.
inline bool lies_in(const PlanarOperand& inner, const PlanarOperand& outer) {
  SetCheckOptions options;
  options.semantics = Semantics::closed;
  return check_set(outer, inner, options).value().contained();
}

inline Rational ratio(std::int64_t num, std::int64_t den = 1) { return *Rational::of(num, den); }
inline RationalPoint at_point(double x, double y) { return {*Rational::of(x), *Rational::of(y)}; }
inline Big big(const Rational& r) { return Big(BigInt(r.numerator()), BigInt(r.denominator())); }
inline Pt<Big> big(const RationalPoint& p) { return {big(p.x), big(p.y)}; }

/// A valid region on a grid, of parts alone where requested.
inline Region small_region(Random& random, int grid, bool parts_only = true) {
  for (;;) {
    const Result<Region> made = Region::create(parts_only ? random_parts(random, grid) : random_region(random, grid));
    if (made) return *made;
  }
}

/// One of its vertices elsewhere on the grid, where that leaves a region.
inline Region with_a_vertex_moved(const Region& region, Random& random, int grid) {
  for (int tries = 0; tries < 20; ++tries) {
    RegionData data = region.data();
    if (data.parts.empty()) return region;
    Ring& ring = data.parts[static_cast<std::size_t>(random.below(static_cast<int>(data.parts.size())))].outer;
    ring[static_cast<std::size_t>(random.below(static_cast<int>(ring.size())))] = {
        static_cast<double>(random.below(grid + 1)), static_cast<double>(random.below(grid + 1))};
    if (const Result<Region> made = Region::create(std::move(data))) return *made;
  }
  return region;
}

inline std::vector<Region> small_variants(Random& random, int grid, int count) {
  std::vector<Region> variants{small_region(random, grid)};
  while (static_cast<int>(variants.size()) < count) variants.push_back(with_a_vertex_moved(variants[0], random, grid));
  return variants;
}

/// All vertices of a set, exactly.
inline std::vector<RationalPoint> vertices_of(const PlanarSum& set) {
  std::vector<RationalPoint> all;
  const auto ring = [&](const SumRing& r) {
    for (const SumVertex& v : r.vertices) all.push_back(set.exact(v));
  };
  for (const SumPart& part : set.parts) {
    ring(part.outer);
    for (const SumRing& hole : part.holes) ring(hole);
  }
  for (const SumSegment& s : set.segments) {
    all.push_back(set.exact(s.from));
    all.push_back(set.exact(s.to));
  }
  for (const SumVertex& v : set.points) all.push_back(set.exact(v));
  return all;
}

/// Half steps of a grid, and vertices of sets.
inline std::vector<RationalPoint> positions_to_try(Random& random, int from, int to, int count) {
  std::vector<RationalPoint> all;
  for (int k = 0; k < count; ++k)
    all.push_back({ratio(2 * from + random.below(2 * (to - from) + 1), 2),
                   ratio(2 * from + random.below(2 * (to - from) + 1), 2)});
  return all;
}

}  // namespace dymsum::oracles
