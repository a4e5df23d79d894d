// Edges in the order of their directions.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/own_memory.h"
#include "exact/rounding_bound.h"
#include "planar/operand/lattice.h"

namespace dymsum::planar {

/// Walk edges of one component (or of its outer loop, or without its filled holes) by direction, counter-clockwise from
/// +x.
struct DirectionList {
  DirectionList() = default;
  explicit DirectionList(const OwnMemory& memory) : edges(memory), keys(memory), rank(memory), next(memory) {}

  OwnArray<std::uint32_t> edges;
  OwnArray<double> keys;         ///< pseudo-angles in [0, 4]
  OwnArray<std::uint32_t> rank;  ///< walk edge - base -> position in edges, or kNoRank
  OwnArray<std::uint32_t> next;  ///< position of an edge -> position of the edge after it in its walk
  std::uint32_t base = 0;
};
inline constexpr std::uint32_t kNoRank = 0xffffffff;

/// 0 for directions in [0, pi), 1 for the others.
inline int half_plane(double x, double y) { return y > 0 || (y == 0 && x > 0) ? 0 : 1; }

/// Monotone in the angle, in [0, 4].
inline double pseudo_angle(double x, double y) {
  const double c = x / (std::abs(x) + std::abs(y));
  return half_plane(x, y) == 0 ? 1 - c : 3 + c;
}
/// The error of the pseudo-angle of a vector whose components carry three roundings each, of a scaled one: a change of
/// x by d of itself changes x / (|x| + |y|) by |x y| / (|x| + |y|)^2 d <= d / 4, so components make 2 * 3 / 4, sum and
/// quotient 1 each, and the final sum, which is less than 4, makes 2. Two of them are compared, and the bound's own sum
/// makes 2.
inline constexpr double kAngleError = exact::rounding_bound(2 * 6 + 2, 32);

/// The order of directions: by half plane (angles [0, pi) first), then counter-clockwise. -1, 0, 1.
int compare_directions(const Lattice& lattice, const Edge& d, const Edge& e);

/// The same with the pseudo-angles as a filter in front.
inline int compare_directions(const Lattice& lattice, double key_d, const Edge& d, double key_e, const Edge& e) {
  if (key_d < key_e - kAngleError) return -1;
  if (key_d > key_e + kAngleError) return 1;
  return compare_directions(lattice, d, e);
}

class OwnEdges;
struct Operand;
struct Component;

/// Ranks and followers of `edges`. Requires: base and the size of rank.
void number(DirectionList& list, const Operand& o);

/// All edges of a component, those with equal directions in the order of the walk; in the operand's memory.
DirectionList sort_by_direction(const OwnEdges& edges, const Operand& o, const Component& c);

/// Those of the loops l, counted through the operand, with keep[l] set, in the memory of `list`.
DirectionList sublist(const DirectionList& all, const Operand& o, const Component& c,
                      const std::vector<std::uint8_t>& keep, DirectionList list = {});

}  // namespace dymsum::planar
