// The exact coordinates of a sum as plain data that tests can transform and compare.
#pragma once

#include <vector>

#include "dymsum/planar_sum.h"
#include "numbers.h"

namespace dymsum::oracles {

template <class N>
using ExactRing = std::vector<Pt<N>>;

template <class N>
struct ExactPart {
  ExactRing<N> outer;
  std::vector<ExactRing<N>> holes;
  friend bool operator==(const ExactPart& a, const ExactPart& b) { return a.outer == b.outer && a.holes == b.holes; }
  friend bool operator<(const ExactPart& a, const ExactPart& b) {
    return a.outer != b.outer ? a.outer < b.outer : a.holes < b.holes;
  }
};

/// The set and its tight features. canonical() makes equal sets with equally cut rings equal.
template <class N>
struct ExactShape {
  std::vector<ExactPart<N>> parts;
  std::vector<Seg<N>> segments, tight_segments;
  std::vector<Pt<N>> points, tight_points;
  friend bool operator==(const ExactShape& a, const ExactShape& b) {
    return a.parts == b.parts && a.segments == b.segments && a.tight_segments == b.tight_segments &&
           a.points == b.points && a.tight_points == b.tight_points;
  }
};

/// Throws Overflow when N is Small and too small.
template <class N>
ExactShape<N> exact_shape(const PlanarSum& sum);

/// Every ring rotated to its smallest rotation, everything sorted, segments from the smaller end.
template <class N>
ExactShape<N> canonical(ExactShape<N> shape);

/// Each point c becomes (xx c.x + xy c.y, yx c.x + yy c.y) + move; canonical. A reflecting map turns the rings round
/// again.
template <class N>
struct Affine {
  N xx, xy, yx, yy;
  Pt<N> move;
};
template <class N>
ExactShape<N> mapped(const ExactShape<N>& shape, const Affine<N>& map);

/// Twice the signed area.
template <class N>
N doubled_area(const ExactRing<N>& ring);

}  // namespace dymsum::oracles
