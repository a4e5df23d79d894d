// What the exact questions to a complex need.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/complex/complex.h"
#include "shape/complex/formulas.h"

namespace dymsum::shape {

/// A disc that touches a site at a position, and another one.
struct DiscSource {
  enum class Kind : std::uint8_t {
    corner,  ///< the point `site` with radius 0
    neck,    ///< the smallest disc between section.site and `other`, both of them vertices
    disc,    ///< at `mark` of `section`
  };
  Kind kind = Kind::disc;
  Section section = {};
  Mark mark = {};
  std::uint32_t other = kNoIndex;  ///< a site
  std::uint32_t point = 0;         ///< corner: the boundary point
};

/// A complex in grid units if T is exact, in interval units if not; see Walks.
template <class T>
struct DiscOf {
  T x, y, radius;
};
template <class T>
DiscOf<T> disc_of(const Walks& walks, const DiscSource& source);
template <class T>
T radius_of(const Walks& walks, const DiscSource& source);

struct ExactComplex {
  Walks walks;
  std::vector<DiscSource> discs;                     ///< per node
  std::vector<exact::Interval> radii;                ///< per node, in interval units
  std::vector<std::vector<std::uint32_t>> contacts;  ///< per node: sites, clockwise
};

}  // namespace dymsum::shape
