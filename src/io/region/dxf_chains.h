// Lines and arcs, joined where their ends meet.
#pragma once

#include <cstddef>
#include <vector>

#include "io/region/curves.h"
#include "io/region/dxf_groups.h"
#include "io/source.h"

namespace dymsum::io {

// The entity SPLINE.

struct DxfSpline {
  std::size_t degree = 0;
  std::vector<double> knots;  ///< ascending; as many as points and degree + 1
  BezierCurve control;        ///< more points than the degree; no weights, or positive ones
};

/// Errors: malformed where it is none of these, and where it has points that it passes through and no control points.
DxfSpline dxf_spline(const Source& source, const DxfEntity& entity);

struct DxfPiece {
  ChordChain chain;        ///< at least two vertices
  double reach = 0;        ///< of a curve: ends that are at most so far from its own, in either coordinate, are these
  std::size_t offset = 0;  ///< in the text
};

struct DxfChains {
  std::vector<ChordChain> rings, open;
};

/// Joins ends that are equal, then ends within the reach of curves; at a joint the coordinates of a line count. Closed
/// chains are rings. Error malformed where more than two ends meet. O(n log n) unless very many ends are within reach
/// of one another; beyond 10^8 comparisons that is an error, too.
DxfChains join_pieces(const Source& source, std::vector<DxfPiece> pieces);

}  // namespace dymsum::io
