// What a long move finds while it walks along all arcs of one operand, kept from move to move.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/gauss/polytope.h"

namespace dymsum::spatial {

struct LeapScratch {
  /// An arc of the walker that is walked, ...
  struct Walk {
    Vec3 row;                    // of the face to reach, where there is one
    std::array<float, 3> along;  // its edge's direction, mapped
    HalfEdge h;                  // the direction in which it is walked
    std::uint32_t v;             // the cell at hand
    std::uint32_t goal;          // the face to reach, or the last cell
    std::uint32_t after;         // the crossing found after which the next one is put, in the order of the edge's arc
  };
  /// ... a crossing found, in lists along the arcs of both operands, ...
  struct Found {
    std::uint32_t e;
    HalfEdge over;
    std::uint32_t next, next_across, id;
  };
  /// ... and an arc of the other operand: the first of its crossings in any order, the cells of its ends.
  struct Across {
    std::uint32_t first, count, begin, end;
  };
  std::vector<Walk> walks;
  std::vector<Found> found;
  std::vector<Across> across;
  std::vector<std::uint32_t> walking, joining;
  std::vector<std::uint8_t> altered;
  std::vector<std::uint32_t> also_chords;  ///< edges by which a visit goes to a face of a pair
  std::vector<std::uint32_t> on_arcs;      ///< faces whose walk has come to an arc on which they may lie

  std::size_t bytes() const {
    const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
    return of(walks, found, across, walking, joining, altered, also_chords, on_arcs);
  }
};

}  // namespace dymsum::spatial
