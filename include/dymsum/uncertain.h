// Regions that are not known exactly: what lies in every variant, what lies in some, and sums, erosions and Boolean
// operations of such pairs (docs/design/uncertain.md).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dymsum/orientation.h"
#include "dymsum/planar_operand.h"
#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "dymsum/result.h"
#include "dymsum/scale.h"

namespace dymsum {

/// How far a boundary may lie outside (positive) or inside (negative) of the nominal one, at least and at most. A part
/// "+0.1/-0.05" has upper = 0.1 and lower = -0.05; a shaft that is always too thin has two negative ones.
struct Tolerance {
  double upper = 0;
  double lower = 0;
  int sides = 32;  ///< of the polygons that stand for discs; a multiple of 4 from 4 to 256
  friend bool operator==(const Tolerance&, const Tolerance&) = default;
};

/// A region of which variants are possible: every variant contains `inner` and lies in `outer`. Nothing else is kept of
/// what the variants have in common: two operands that vary together are taken as if they varied on their own, so what
/// is said of their results is right, but may be wider than it needs to be.
///
/// A value; copies have one copy of the sets. Thread-safe.
class Uncertain {
 public:
  /// A region that is known: it is the only variant. Errors: as united.
  static Result<Uncertain> known(const Region& region);
  /// Any two sets. Errors: out_of_range where `inner` does not lie in `outer`; as check_set.
  static Result<Uncertain> between(const PlanarOperand& inner, const PlanarOperand& outer);

  /// One of these regions: their intersection and their union, exact. Errors: out_of_range for none; as united.
  static Result<Uncertain> of_variants(std::vector<Region> variants, const Progress& progress = {});

  /// All that lies between the offsets of a region by `lower` and by `upper`: sums with discs, and erosions by them
  /// where negative. Polygons stand for the discs, on the side on which nothing is lost: parallel to the axes they
  /// reach exactly as far as the discs, elsewhere the sets are those of tolerances that are wider by at most error().
  /// Polylines and points vanish where they are offset inside.
  /// Errors: out_of_range where lower > upper, beyond 2^400, and for other `sides`; as minkowski_sum.
  static Result<Uncertain> of_band(const Region& nominal, const Tolerance& tolerance);

  /// Regions whose vertices are anywhere in their boxes {min x, min y, max x, max y}, one for each vertex of `nominal`,
  /// which lies in it; edges join them as before. Polylines and points are possible in the boxes and between them, and
  /// nowhere provably. Exact: outer is the region and the hulls of neighbouring boxes, inner what these leave of it.
  /// Errors: out_of_range for another number of boxes, and for one that is not around its vertex; as filled.
  static Result<Uncertain> of_boxes(const Region& nominal, std::span<const std::array<double, 4>> boxes);
  /// Regions whose vertices are each at most so far from where they are; one radius for each vertex. Polygons around
  /// the discs stand for these. Errors: out_of_range as above, and for negative radii and other `sides`.
  static Result<Uncertain> of_discs(const Region& nominal, std::span<const double> radii, int sides = 32);
  /// Regions whose coordinates have been rounded: each is at most `ulps` doubles away from what is given. Errors:
  /// out_of_range for ulps below 0 or beyond 2^40, and where a box reaches infinity.
  static Result<Uncertain> of_rounding(const Region& nominal, std::int64_t ulps = 1);

  /// s times the region for s from low to high: exact. Errors: as ScalingFamily.
  static Result<Uncertain> of_scales(const Region& nominal, const Scale& low, const Scale& high);
  /// The region turned about the origin by an angle from a counter-clockwise to b, within `distance` of the exact sets;
  /// where a == b that region itself. Errors: as outer_rotated_sum; unsupported_operand for polylines and points.
  static Result<Uncertain> of_angles(const Region& nominal, const Orientation& a, const Orientation& b,
                                     double distance);

  const PlanarSum& inner() const { return *inner_; }
  const PlanarSum& outer() const { return *outer_; }
  /// All variants, where there are finitely many that are known by name: of known and of_variants; else none. Questions
  /// are answered for each of them.
  const std::vector<Region>& variants() const { return *variants_; }
  /// Both sets are equal, tight features included.
  bool exact() const;
  /// The sets lie between those of exact discs and those of discs whose radii differ by this, the tolerance being
  /// wider. 0 where no polygon stands for a disc. Sums and erosions add what their operands have.
  double error() const { return error_; }
  /// What lies in some variants only, perhaps: the closure of the outer set's interior without the inner one. Errors:
  /// as difference.
  Result<PlanarSum> doubtful() const;

 private:
  friend struct UncertainInternals;
  Uncertain() = default;
  std::shared_ptr<const PlanarSum> inner_, outer_;
  std::shared_ptr<const std::vector<Region>> variants_;
  double error_ = 0;
};

// Operations take every variant of one operand with every one of the other. Known operands give what the operations of
// regions give. Semantics are those of each of both sets. Errors: as the operations of regions.

/// P (+) Q. Where both have finitely many variants (one that is known has one) and semantics are closed, the sets are
/// exactly what the sums of all pairs have in common, which is more than the sum of the inner sets, and their union.
/// Cost then: a sum for each pair, and Boolean operations of these, cut to where variants differ.
Result<Uncertain> minkowski_sum(const Uncertain& p, const Uncertain& q, const SumOptions& options = {});
/// A (+) -B, likewise.
Result<Uncertain> nfp(const Uncertain& a, const Uncertain& b, const SumOptions& options = {});
/// P (-) Q. The inner set is that of the inner P and the outer Q: the positions at which every variant of Q fits into
/// every variant of P, exactly so where both are made of finitely many variants. Errors also: unsupported_operand where
/// nothing lies in every variant of Q.
Result<Uncertain> erode(const Uncertain& p, const Uncertain& q, const SumOptions& options = {});
Result<Uncertain> united(const Uncertain& a, const Uncertain& b, const SumOptions& options = {});
Result<Uncertain> intersection(const Uncertain& a, const Uncertain& b, const SumOptions& options = {});
Result<Uncertain> difference(const Uncertain& a, const Uncertain& b, const SumOptions& options = {});

}  // namespace dymsum
