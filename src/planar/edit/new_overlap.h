// Collisions of operands after an edit: what is new alone may overlap where nothing did before.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planar/boundary/collision.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

class NewOverlap {
 public:
  /// `fresh`: walk edges of P and of Q that are new, or start at vertices with new edges.
  NewOverlap(const Lattice& lattice, const Operand& p, const Operand& q,
             std::array<std::span<const std::uint32_t>, 2> fresh)
      : lattice_(lattice), operands_{&p, &q}, fresh_(fresh) {}

  /// Whether doubles prove that these edges meet none of the other operand where Q, reflected, stands at x. Then
  /// connected operands with area that touched there and did not overlap still do not.
  bool provably_none(const SegmentPosition& x) const;
  /// Whether doubles prove that two edges cross properly there.
  bool provably_cross(const SegmentPosition& x, const CrossingEdges& edges) const;

 private:
  // The sides of an edge of `op` on which the ends of one of the other operand lie: 1, -1, or 0 where it is open.
  std::array<int, 2> sides(const SegmentPosition& x, std::uint32_t op, std::uint32_t edge, std::uint32_t other) const;
  std::vector<std::uint32_t> near(const SegmentPosition& x, std::uint32_t op) const;
  bool apart(const SegmentPosition& x, std::uint32_t op, std::uint32_t edge,
             std::span<const std::uint32_t> others) const;

  const Lattice& lattice_;
  std::array<const Operand*, 2> operands_;
  std::array<std::span<const std::uint32_t>, 2> fresh_;
};

}  // namespace dymsum::planar
