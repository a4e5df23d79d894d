// Whether a set that somebody made is the right one: a sum, a no-fit polygon, an inner fit, an offset, of any program.
#pragma once

#include <cstdint>
#include <optional>

#include "dymsum/growing_disc.h"
#include "dymsum/planar_operand.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/result.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// What a check comes to.
enum class CheckVerdict : std::uint8_t {
  right,
  wrong,
  undecided,  ///< the tolerance lies between the two bounds of a distance
};

/// What lies in one set and not in another one, and the position of it that is furthest from the other set.
struct PlanarExcess {
  PlanarSum set;              ///< exact; empty where the first set lies in the other one
  RationalPoint at, nearest;  ///< a furthest position, and the nearest one of the other set; zero where there is none
  Rational squared;           ///< the exact square of the distance of these two
  double distance = 0;        ///< its nearest double; infinite where the other set is empty and the first one is not
  /// No position of the set is further away: `distance` where that is proved (`exact`), which it is where a vertex of
  /// the set is the furthest position, or one at the same distance of two edges, or of two vertices; else a bound, no
  /// more than 2^-36 of the distance larger unless 100,000 pieces did not do.
  double at_most = 0;
  bool exact = true;
};

/// How a set lies to the right one.
struct PlanarSetCheck {
  PlanarExcess missing;  ///< of the right set: what lies in it alone
  PlanarExcess surplus;  ///< of the other one
  bool equal() const { return contains() && contained(); }
  bool contains() const;   ///< the right set lies in the other one, which is never too small
  bool contained() const;  ///< the other one in the right set: it is never too large
  /// right: where no position of either set is further than this from the other one (Hausdorff distance). With 0: where
  /// they are equal.
  CheckVerdict within(const Rational& tolerance) const;
};

struct SetCheckOptions {
  /// regular: closures of interiors are compared. closed: segments and points, such as exact fits, count as well.
  Semantics semantics = Semantics::regular;
  Progress progress;
};

/// Compares any two sets, exactly. Errors: unsupported_operand for open semantics and coordinates beyond 2^1000;
/// cancelled; out_of_memory. Cost: that of two differences of the sets, and O(log n) for every vertex of these, where
/// distances of positions that look alike are compared as integers.
Result<PlanarSetCheck> check_set(const PlanarOperand& right, const PlanarOperand& made,
                                 const SetCheckOptions& options = {});

/// The same of solids.
struct SolidExcess {
  SpatialSum set;              ///< exact
  RationalPoint3 at, nearest;  ///< a furthest position, and the nearest one of the other solid's boundary
  Rational squared;
  double distance = 0;
  /// No position of the set is further away: `distance` where that is proved (`exact`), which it is where a vertex of
  /// the set is the furthest position, or one that is equally far from planes that are parallel or at right angles;
  /// else a bound, no more than 2^-30 of the distance, or 2^-43 of the largest coordinate, larger unless 20,000 cuts,
  /// and four for each triangle of the set's boundary, did not do.
  double at_most = 0;
  bool exact = true;
};

/// How a solid lies to the right one.
struct SolidSetCheck {
  SolidExcess missing, surplus;
  bool equal() const { return contains() && contained(); }
  bool contains() const;
  bool contained() const;
  CheckVerdict within(const Rational& tolerance) const;
};

/// Compares closures of interiors, exactly. Errors: as Boolean operations of solids (solid_union.h); out_of_range where
/// vertices on their common grid need more than 8,192 bits. Cost: that of two differences, O(log n) for each vertex of
/// these and n faces of the other solid, and where that is not convex for each cell into which it cuts them: some six
/// for each of their triangles where surfaces differ all over.
Result<SolidSetCheck> check_set(const SpatialOperand& right, const SpatialOperand& made,
                                const SpatialOptions& options = {});

/// How a set lies to the offsets of A: by what distance it is one. Outside: A grown, so that it contains A; the
/// distances are those from A. Inside: A shrunk, so that A contains it; the distances are those from the outside of A.
struct PlanarOffsetCheck {
  /// What makes it no offset: of A beyond the set (outside), or of the set beyond A (inside).
  PlanarExcess beyond;
  /// The set is at least so far: the exact least distance of the boundaries, and positions of the set's and of A's that
  /// are that near; 0 where something is `beyond`, infinite where one of both is empty.
  Rational least_squared;
  double least = 0;
  RationalPoint least_at, least_from;
  /// And at most so far: what lies between both boundaries, and the position that is furthest from A, or from its
  /// outside.
  PlanarExcess between;

  /// Whether it holds the exact offset by r (inside: lies in it): no less than r is kept.
  CheckVerdict at_least(const Rational& r) const;
  /// Whether it lies in the exact offset by r (inside: holds it).
  CheckVerdict at_most(const Rational& r) const;
};

/// The same of solids.
struct SolidOffsetCheck {
  SolidExcess beyond;
  Rational least_squared;
  double least = 0;
  RationalPoint3 least_at, least_from;
  SolidExcess between;  ///< outside: exact where A is convex; else bounded as that of SolidSetCheck

  CheckVerdict at_least(const Rational& r) const;
  CheckVerdict at_most(const Rational& r) const;
};

/// Compares closures of interiors, exactly; true arcs are not needed. Errors and cost: as check_set.
Result<PlanarOffsetCheck> check_offset(const PlanarOperand& a, const PlanarOperand& made, DiscSide side,
                                       const Progress& progress = {});
/// The same of solids. Errors and cost: as check_set of solids; the least distance is that of O(n log n) pairs of faces
/// where few are nearly as near as the nearest.
Result<SolidOffsetCheck> check_offset(const SpatialOperand& a, const SpatialOperand& made, DiscSide side,
                                      const SpatialOptions& options = {});

}  // namespace dymsum
