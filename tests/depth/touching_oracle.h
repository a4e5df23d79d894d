// What touches, by the definition: every feature of P against every feature of Q, in rationals, faces as they are.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "dymsum/penetration_depth.h"
#include "exact/big.h"

namespace dymsum::test {

using exact::BigRational;
using Position = std::array<BigRational, 3>;

/// Features at exact positions.
struct TouchingShape {
  std::vector<Position> at;
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< a < b
  std::vector<Face> faces;
};
TouchingShape touching_shape(const Mesh& mesh, const Position& moved);

/// Whether the relative interior of a feature holds a position.
bool feature_holds(const TouchingShape& shape, const SolidFeature& feature, const Position& x);

/// All pairs whose relative interiors meet, and the dimension of what they have in common.
std::map<std::pair<SolidFeature, SolidFeature>, int> touching_by_definition(const TouchingShape& p,
                                                                            const TouchingShape& q);

Position exact_position(const RationalPoint3& x);

}  // namespace dymsum::test
