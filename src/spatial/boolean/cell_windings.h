// Winding numbers on both sides of the cells of an arrangement of closed surfaces.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "spatial/arrangement/solid_arrangement.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/convolution/sum_space.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

/// How often closed surfaces of triangles go around a position.
class WindingNumber {
 public:
  /// Winding numbers of triangles of the space's P, where its Q is one vertex. Keeps the references.
  WindingNumber(const SumSpace& space, const std::vector<Triangle>& triangles);

  /// The triangles above a position that is on none of them: those seen from below their backs less those seen from
  /// below their fronts. Exact. O(log n + k) for k triangles in line with it along z.
  int at(const Flag& x) const;

 private:
  const SumSpace& space_;
  const std::vector<Triangle>& triangles_;
  BoxTree tree_;
};

struct CellWindings {
  std::vector<std::int32_t> above;  ///< per cell, on the side of its plane's normal
  std::uint64_t components = 0;     ///< of the surfaces: parts that share no point
  std::uint64_t volumes = 0;        ///< pieces of space, each counted once for every component that bounds it
};

/// The first edge of the arrangement around which the cells do not close: the winding number changes on the way around
/// it. None where the triangles together are closed surfaces. O(n).
std::optional<std::uint32_t> open_edge(const SolidArrangement& arrangement);

/// Requires closed surfaces. The winding number below a cell is that above it, plus the facets that face the normal's
/// way, less the others; it is the same for all cells that look into one wedge around an edge; and for every component
/// it is counted at one position. Exact.
CellWindings cell_windings(const SumSpace& space, const SolidArrangement& arrangement, const WindingNumber& winding,
                           StageWatch& watch);

}  // namespace dymsum::spatial
