// Positions along a site, as what they are: an end, the position of a disc that touches another site at its end, or the
// position of a disc that touches two other sites. Two marks with the same name are the same position.
#pragma once

#include <cstdint>

#include "exact/interval.h"
#include "shape/complex/walks.h"

namespace dymsum::shape {

/// A site, or a part of a vertex: directions are determined by the tangent of half their angle from an axis, 0 = +x, 1
/// = +y, 2 = -x, 3 = -y, whose opposite is not in the part.
struct Section {
  std::uint32_t site = 0;
  std::uint8_t axis = 0;
};

struct Mark {
  enum class Kind : std::uint8_t {
    minus_infinity,
    start,     ///< of the section
    tangent,   ///< the disc that touches the line of edge i at its start (root 0) or end (root 1)
    crossing,  ///< the disc that touches i < j; of two, root 0 is the first. j = kNoIndex: the disc is a half-plane
    toward,    ///< the smallest disc that touches i
    away,      ///< opposite to it; vertices only
    end,
    plus_infinity,
  };
  Kind kind = Kind::start;
  std::uint8_t root = 0;
  std::int8_t lead = 0;  ///< crossing: the signs of the quadratic's coefficients of x^2 and x
  std::int8_t slope = 0;
  std::uint32_t i = kNoIndex, j = kNoIndex;
  exact::Interval near = {};  ///< contains the parameter, unless it is infinite

  bool is_infinite() const { return kind == Kind::minus_infinity || kind == Kind::plus_infinity; }
  /// The same name.
  bool same(const Mark& o) const { return kind == o.kind && root == o.root && i == o.i && j == o.j; }
};

}  // namespace dymsum::shape
