// Solids that are not known exactly: what lies in every variant, what lies in some, sums, erosions and Boolean
// operations of such pairs, and what holds for every variant, for some, for none (docs/design/uncertain.md).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/penetration_depth.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/result.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"
#include "dymsum/uncertain.h"
#include "dymsum/uncertain_answers.h"

namespace dymsum {

/// A solid of which variants are possible: every variant contains `inner` and lies in `outer`. As Uncertain is of
/// regions; the sets of variants are closures of interiors, as Boolean operations of solids are.
///
/// A value; copies have one copy of the sets. Thread-safe.
class UncertainSolid {
 public:
  /// A solid that is known: it is the only variant. Errors: unsupported_operand for thin parts; as united.
  static Result<UncertainSolid> known(const Mesh& solid);
  /// Any two sets. Errors: out_of_range where `inner` does not lie in `outer`, with a position; as check_set.
  static Result<UncertainSolid> between(const SpatialOperand& inner, const SpatialOperand& outer);
  /// One of these solids: their intersection and their union, exact. Errors: out_of_range for none; as known.
  static Result<UncertainSolid> of_variants(std::vector<Mesh> variants, const Progress& progress = {});
  /// All that lies between the offsets of a solid by tolerance.lower and by tolerance.upper (tolerance.sides do not
  /// count). Balls of plane facets stand for balls, on the side on which nothing is lost, and reach at most `within`
  /// further; 0: a sixteenth of the larger deviation. Errors: out_of_range where lower > upper, and as offset.
  static Result<UncertainSolid> of_band(const Mesh& nominal, const Tolerance& tolerance, double within = 0);
  /// Solids whose vertices are anywhere in their boxes {min x, min y, min z, max x, max y, max z}, one for each vertex
  /// of `nominal`, which lies in it. Faces follow: each is a surface in the hull of its vertices' boxes. Outer is the
  /// solid and these hulls, inner what they leave of it. Cost: the union of all hulls. Errors: out_of_range for another
  /// number of boxes, and for one that is not around its vertex; as known.
  static Result<UncertainSolid> of_boxes(const Mesh& nominal, std::span<const std::array<double, 6>> boxes,
                                         const Progress& progress = {});
  /// Solids whose coordinates have been rounded: each is at most `ulps` doubles away from what is given. The largest
  /// such difference along each axis counts for all vertices, which makes the sets one sum and one erosion, and wider
  /// than those of of_boxes. Errors: out_of_range for ulps below 0 or beyond 2^40, and where a coordinate may be
  /// infinite; as known.
  static Result<UncertainSolid> of_rounding(const Mesh& nominal, std::int64_t ulps = 1);

  const SpatialSum& inner() const { return *inner_; }
  const SpatialSum& outer() const { return *outer_; }
  /// All variants, where there are finitely many that are known by name: of known and of_variants; else none.
  const std::vector<Mesh>& variants() const { return *variants_; }
  /// Both sets are equal, tight features included.
  bool exact() const;
  /// The sets lie between those of exact balls and those of balls whose radii differ by this, the tolerance being
  /// wider. 0 where no solid stands for a ball. Sums and erosions add what their operands have.
  double error() const { return error_; }
  /// What lies in some variants only, perhaps. Errors: as difference.
  Result<SpatialSum> doubtful() const;

 private:
  friend struct UncertainSolidInternals;
  UncertainSolid() = default;
  std::shared_ptr<const SpatialSum> inner_, outer_;
  std::shared_ptr<const std::vector<Mesh>> variants_;
  double error_ = 0;
};

// Operations take every variant of one operand with every one of the other. Known operands give what the operations of
// solids give. Errors: as the operations of solids.

/// P (+) Q: inner with inner, outer with outer. The outer set is exactly the union of all sums where both have finitely
/// many variants; what all sums have in common may be more than the inner one.
Result<UncertainSolid> minkowski_sum(const UncertainSolid& p, const UncertainSolid& q,
                                     const SpatialOptions& options = {});
/// P (-) Q. The inner set is that of the inner P and the outer Q: the positions at which every variant of Q fits into
/// every variant of P. Errors also: unsupported_operand where nothing lies in every variant of Q.
Result<UncertainSolid> erode(const UncertainSolid& p, const UncertainSolid& q, const SpatialOptions& options = {});
Result<UncertainSolid> united(const UncertainSolid& a, const UncertainSolid& b, const SpatialOptions& options = {});
Result<UncertainSolid> intersection(const UncertainSolid& a, const UncertainSolid& b,
                                    const SpatialOptions& options = {});
Result<UncertainSolid> difference(const UncertainSolid& a, const UncertainSolid& b, const SpatialOptions& options = {});

// Questions: each pair of variants is looked at where there are finitely many and the inner and outer sets do not
// decide.

/// Whether z lies in P (+) Q. Errors: as contains of solids.
Result<UncertainAnswer> contains(const UncertainSolid& p, const UncertainSolid& q, const RationalPoint3& z,
                                 Semantics semantics = Semantics::closed);
/// Whether the interiors of P and of Q, moved by `at`, meet. Errors: as SolidDepth.
Result<UncertainAnswer> collides(const UncertainSolid& p, const UncertainSolid& q, const RationalPoint3& at);
/// Whether Q, moved by `at`, lies in P. Errors: as erode.
Result<UncertainAnswer> fits_at(const UncertainSolid& p, const UncertainSolid& q, const RationalPoint3& at);

/// Whether Q fits into P somewhere.
struct UncertainSolidFit {
  UncertainAnswer answer;    ///< each pair of variants may have positions of its own
  UncertainSolid positions;  ///< inner: where every variant fits into every one; outer: where some may fit
  /// A position at which every variant fits into every one, where there is one: a vertex of positions.inner().
  std::optional<RationalPoint3> common;
};
/// Errors: as erode.
Result<UncertainSolidFit> fits_anywhere(const UncertainSolid& container, const UncertainSolid& part,
                                        const SpatialOptions& options = {});

/// An end of an interval of distances.
struct SolidClearanceBound {
  SolidDistance distance;  ///< contacts only where both are variants; infinite where one of the sets is empty
  VariantPair of;          ///< which has it
};

/// How far P and Q, moved by `at`, are apart, or how deep they overlap.
struct UncertainSolidClearance {
  SolidClearanceBound least, most;
  /// The ends as numbers: gaps are positive, depths negative.
  double least_signed() const;
  double most_signed() const;
};
/// No pair of variants is nearer than `least` or further apart than `most`; finitely many variants reach both. Errors:
/// as SolidDepth.
Result<UncertainSolidClearance> clearance(const UncertainSolid& p, const UncertainSolid& q, const RationalPoint3& at);

}  // namespace dymsum
