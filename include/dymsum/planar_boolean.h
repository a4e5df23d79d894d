// Boolean operations on planar regions, exact and to any depth: results are operands of further operations.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "dymsum/fill.h"
#include "dymsum/planar_operand.h"
#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "dymsum/result.h"
#include "dymsum/snap_rounding.h"

namespace dymsum {

/// What lies in one of the sets, in all of them, in `a` but not in `b`, in one of both alone. Of no sets the union is
/// empty; the intersection takes at least one (out_of_range).
///
/// With Semantics::closed operands are closed sets and what is taken away is open: the result is closed. Where it has
/// no interior (two squares that share an edge have that edge in common), that is listed in `segments` and `points`.
/// With Semantics::open operands are open and what is taken away is closed, and such pieces do not belong to the set.
/// Tight features are where a touch decides: where closed and open operands make a difference, off the boundary of the
/// parts. These are the pieces without interior, and the segments and points that open sets leave out (two open squares
/// that share an edge miss it). Semantics::regular: the closure of the interior alone.
///
/// Polylines and points of regions, segments and points of results (exact fits of an erosion) are closed sets without
/// interior: they take part as such, and regular semantics leaves them out.
///
/// A result of these operations is taken for the operations that made it: its edges lie on edges of the first operands
/// whatever has been done with it, and no integer grows. So semantics are those of the last operation: pieces that
/// regular semantics left out of a result count again where that result takes part in a closed operation, also where
/// nothing else was left of it. (Polylines and points that a regular operation was given itself are left out for good.)
/// Of any other result (a sum, an erosion) its parts, segments and points take part.
///
/// Exact and canonical: equal sets are equal results. Provenance: `p` of a contact and of a corner counts the vertices
/// and edges of all regions that take part, one after the other as they come first, each once where a result takes
/// part several times; `q` is 0. Of the options semantics, progress and memory count.
/// Errors: unsupported_operand for coordinates beyond 2^1000; cancelled; out_of_memory.
/// O(n log n + k + c n / r) for n edges of all regions, k of their crossings and c connected pieces of their edges,
/// each of which looks at one of r rows; times the number of operands. O(n) besides for each point.
Result<PlanarSum> united(std::span<const PlanarOperand> sets, const SumOptions& options = {});
Result<PlanarSum> intersection(std::span<const PlanarOperand> sets, const SumOptions& options = {});
Result<PlanarSum> united(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options = {});
Result<PlanarSum> intersection(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options = {});
Result<PlanarSum> difference(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options = {});
Result<PlanarSum> symmetric_difference(const PlanarOperand& a, const PlanarOperand& b, const SumOptions& options = {});

/// What rings bound that may cross, touch or lie on themselves and each other, whichever way they run: the closure of
/// the positions inside by winding number. `rings` may be given in any parts, as outer rings or holes: only how they
/// run counts. Vertices repeated one after the other count once, and rings of fewer than three are left out. The result
/// is an operand of Boolean operations. Errors: not_finite; and as above.
Result<PlanarSum> filled(const RegionData& rings, Fill fill, const SumOptions& options = {});

/// What repair_with_fill changed.
struct FillReport {
  std::size_t rings = 0, rings_now = 0;  ///< before and after
  std::size_t crossings = 0;             ///< at which rings crossed or touched
  Rounding rounding;                     ///< of the vertices that are crossings
  bool filled = false;                   ///< the rings were no valid region
  bool changed() const { return filled; }
  /// "2 rings filled to 1 at 4 crossings; nearest doubles".
  std::string to_string() const;
};
struct FilledRegion {
  Region region;
  FillReport report;
};

/// The named repair of rings that cross themselves or each other, are inside out, or lie on each other: what they
/// bound, with its vertices rounded as snap_rounded does. A valid region stays as it is, and so do polylines and
/// points. Errors: as filled; those of Region::create for polylines and points.
Result<FilledRegion> repair_with_fill(const RegionData& rings, Fill fill);

}  // namespace dymsum
