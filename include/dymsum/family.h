// Families of planar sums: all sums of an interval of scales, or of all angles, as one object. Between two events the
// structure of the sum is the same, so a sum at any parameter is that structure with its vertices at their positions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dymsum/frames.h"
#include "dymsum/names.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"

namespace dymsum {

struct FamilyOptions {
  MovingOperand moving = MovingOperand::p;
  bool reflect_q = false;  ///< P (+) -Q: Q is a robot and P an obstacle. Provenance indices refer to Q
  Semantics semantics = Semantics::closed;
  /// Structures are kept in at most so many bytes; a sum at a parameter of a cell whose structure is not kept is
  /// computed from scratch. 0: all are kept.
  std::uint64_t structure_bytes = 0;
  /// Bytes that may be held at a time while the family is made, see MovingOptions::memory. 0: no limit.
  std::uint64_t memory = 0;
  Progress progress;
};

/// What a lifetime is of.
enum class FamilyFeature : std::uint8_t {
  vertex,  ///< of a ring, by its contacts and its corner
  edge,    ///< a contact that carries an edge of the boundary
  hole,    ///< a hole, from cell to cell while it has a vertex of what it was
};

/// The cells in which a feature of the sum is there. Cell k lies between events k - 1 and k of the family, cell 0
/// before the first one; a feature that goes and comes back has several lifetimes. Of a sum of edges that are parallel,
/// names may change where positions do not.
struct Lifetime {
  FamilyFeature feature = FamilyFeature::vertex;
  Contact in, out;  ///< of a vertex; of an edge both are its contact
  std::uint32_t corner_p = SumVertex::kNone, corner_q = SumVertex::kNone;  ///< of a vertex that is a sum of vertices
  std::uint64_t hole = 0;                                                  ///< of a hole, its identity
  std::uint32_t first_cell = 0, last_cell = 0;
  friend bool operator==(const Lifetime&, const Lifetime&) = default;
};

/// What a family holds, and what it took.
struct FamilyWork {
  std::uint64_t events = 0, visible = 0;  ///< events, and those at which the sum's structure changes
  std::uint64_t cells = 0, kept = 0;      ///< cells, and those whose structure is kept
  std::uint64_t names = 0;                ///< different vertices
  std::uint64_t bytes = 0;                ///< of structures
  double ms = 0;
};

}  // namespace dymsum
