// Boolean operations of closed sets: what of them lies outside of their regular part, as a face, a segment or a point
// at which two solids touch, or a thin part of an operand.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "spatial/boolean/surface.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/sum/common_grid.h"
#include "spatial/sum/exact_set.h"
#include "spatial/sum/solid_boundary.h"

namespace dymsum::spatial {

enum class SetOperation : std::uint8_t { united, intersection, difference, symmetric_difference };

/// How a position lies to a closed set: outside of it, in its interior, or neither.
enum class Side : std::uint8_t { outside, boundary, inside };

/// Whether the operation has a position for which its operands have these. Operands are closed, and what is taken away
/// is open; or with `open` the other way around. A difference takes all sets from the first one.
bool holds(SetOperation operation, std::span<const Side> sides, bool open);

/// The sets of an operation as triangles, in units of doubles or on a common grid.
struct ClosedOperands {
  /// Of each set: its regular triangles, those of its thin faces (each once), and thin segments and points.
  struct Set {
    std::uint32_t first = 0, last = 0;            ///< of the surface's triangles
    std::uint32_t first_thin = 0, last_thin = 0;  ///< of them: each front, then its back
    std::vector<std::array<ExactPosition, 2>> segments;
    std::vector<SolidFeature> segment_names;
    std::vector<ExactPosition> points;
    std::vector<SolidFeature> point_names;
  };
  Surface surface;
  std::vector<Set> sets;
  /// The positions of the surface's vertices are these, times `scale`: on a grid in its units.
  std::vector<ExactPosition> at;
  exact::BigRational scale = 1;
};

/// Triangles of all of them, those of sets from `first_taken` on inside out. Faces and vertices are counted on from
/// set to set; of results triangles are faces. O(n log n).
ClosedOperands closed_operands(std::span<const OperandSet> sets, std::size_t first_taken, CommonGrid& grid);

inline bool has_thin_lines(const ClosedOperands& operands) {
  for (const ClosedOperands::Set& set : operands.sets)
    if (!set.segments.empty() || !set.points.empty()) return true;
  return false;
}

/// The cells, edges and points of an arrangement of their triangles that are tight: in the closed result, not in the
/// open one, and not on the boundary of the regular one, which `regular` is. Proof: docs/design/solid-union.md, "Closed
/// sets". Thin segments and points are not looked at.
TightFeatures tight_of(SetOperation operation, const ClosedOperands& operands, const SolidBoundary& boundary,
                       const SpatialSum& regular, StageWatch& watch);

/// Adds what is tight on thin segments and points of the operands to a sum with all tight faces, and with them the
/// tight segments and points of `others`, which is the same sum with these. O(k (k + n)) for k segments and points and
/// n triangles.
void add_thin_lines(SetOperation operation, const ClosedOperands& operands, const SpatialSum& others, SpatialSum& sum);

}  // namespace dymsum::spatial
