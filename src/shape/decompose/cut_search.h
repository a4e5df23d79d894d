// Cuts of a region at its reflex vertices, one after the other.
#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "base/poll.h"
#include "dymsum/decomposition.h"
#include "shape/decompose/wall_set.h"

namespace dymsum::shape {

/// A position at which a cut passes the boundary of a hole.
struct Passage {
  bool at_vertex;
  std::uint32_t index;  ///< of the vertex or edge
  Rational on_edge, on_cut;
  RationalPoint at;
  bool enters;  ///< whether the cut goes on inside the region
};

struct PlacedCut {
  Cut cut;
  Rational t;                 ///< of its end, along the edge or cut that it ends at
  std::vector<Passage> over;  ///< in order
};

/// What tells bars that count exactly as much.
using BarWorth = std::tuple<std::uint32_t, double, double, std::optional<std::uint32_t>>;

/// The cuts for the minima of these bars, in their order, with the partners of those that would not separate anything.
/// O(log n) steps in doubles and a few exact ones per bar in practice. Stops as the progress callback asks.
std::vector<PlacedCut> find_cuts(const RingTable& table, const std::vector<FeatureBar>& bars,
                                 const std::vector<BarWorth>& worth, const std::vector<std::uint32_t>& order,
                                 const Poll& poll);

/// The connected components of the region without the cuts, each with simple rings. O(m log m) steps for m vertices and
/// cuts, and for every hole that no cut touches a walk round the pieces in whose boxes it lies.
std::vector<Piece> pieces_between(const RingTable& table, const std::vector<PlacedCut>& cuts, const Poll& poll);

}  // namespace dymsum::shape
