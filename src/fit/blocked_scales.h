// How long a position stays blocked while the part grows or shrinks: as long as two edges cross there.
#pragma once

#include <optional>
#include <vector>

#include "exact/big.h"
#include "planar/motion/operand_pair.h"
#include "planar/position/exact_source.h"

namespace dymsum {

/// An open interval of scales at all of which something is blocked; without `high` it has no end.
struct BlockedScales {
  exact::BigRational low = 0;
  std::optional<exact::BigRational> high;
};

namespace planar {

/// Edges of obstacles (operand 0) and of a reflected part that scales (operand 1), for queries at many positions.
class BlockedSearch {
 public:
  explicit BlockedSearch(const OperandPair& base);

  /// The scales about s at which an edge of obstacles and one of the part properly cross where the part stands at z:
  /// there both interiors meet. Of the pairs that doubles find the one that crosses longest upwards; exact. Nothing
  /// where none is found. O(n m) doubles for n and m edges.
  std::optional<BlockedScales> about(const ExactSource::Position& z, const exact::BigRational& s) const;

 private:
  struct Edge {
    Point from, to;
  };
  static std::vector<Edge> edges_of(const OperandPair& base, std::uint32_t op);

  std::vector<Edge> obstacles_, part_;
};

}  // namespace planar
}  // namespace dymsum
