// Questions about regions that are not known exactly: what holds for every variant, for some, for none, and which
// variants decide.
#pragma once

#include <cstdint>
#include <optional>

#include "dymsum/penetration_depth.h"
#include "dymsum/rational.h"
#include "dymsum/uncertain.h"

namespace dymsum {

enum class Holds : std::uint8_t { for_all, for_some, for_none };

/// A variant of each operand, by its index in Uncertain::variants; or the inner or outer set, which stands for a
/// variant that is as small, or as large, as is possible.
struct VariantPair {
  static constexpr std::uint32_t kInner = 0xfffffffe, kOuter = 0xffffffff;
  std::uint32_t p = 0, q = 0;
  friend bool operator==(const VariantPair&, const VariantPair&) = default;
};

/// for_all and for_none are proved for every variant. for_some: it holds for the pair `yes` and not for the pair `no`,
/// which are variants where both operands have finitely many; of other operands these are the inner and outer sets, and
/// between them nothing is known.
struct UncertainAnswer {
  Holds holds = Holds::for_none;
  std::optional<VariantPair> yes;  ///< a pair for which it holds; nothing where it holds for none
  std::optional<VariantPair> no;   ///< a pair for which it does not; nothing where it holds for all
};

/// Whether z lies in P (+) Q. Exact for finitely many variants: each pair is looked at where the inner and outer sets
/// do not decide. Errors: as minkowski_sum.
Result<UncertainAnswer> contains(const Uncertain& p, const Uncertain& q, const RationalPoint& z,
                                 Semantics semantics = Semantics::closed);
/// Whether the interiors of P and of Q, moved by `at`, meet. Errors: as nfp.
Result<UncertainAnswer> collides(const Uncertain& p, const Uncertain& q, const RationalPoint& at);
/// Whether Q, moved by `at`, lies in P. Errors: as erode.
Result<UncertainAnswer> fits_at(const Uncertain& p, const Uncertain& q, const RationalPoint& at);

/// Whether Q fits into P somewhere.
struct UncertainFit {
  UncertainAnswer answer;  ///< each pair of variants may have positions of its own
  Uncertain positions;     ///< inner: where every variant fits into every one; outer: where some may fit
  /// A position at which every variant fits into every one, where there is one: a vertex of positions.inner().
  std::optional<RationalPoint> common;
};
/// Errors: as erode.
Result<UncertainFit> fits_anywhere(const Uncertain& container, const Uncertain& part, const SumOptions& options = {});

/// An end of an interval of distances.
struct ClearanceBound {
  PlanarDistance distance;  ///< contacts only where both are variants; infinite where one of the sets is empty
  VariantPair of;           ///< which has it
};

/// How far P and Q, moved by `at`, are apart, or how deep they overlap.
struct UncertainClearance {
  ClearanceBound least, most;
  /// The ends as numbers: gaps are positive, depths negative.
  double least_signed() const;
  double most_signed() const;
};
/// No pair of variants is nearer than `least` or further apart than `most`; finitely many variants reach both. Errors:
/// as nfp; unsupported_operand where both operands have polylines or points.
Result<UncertainClearance> clearance(const Uncertain& p, const Uncertain& q, const RationalPoint& at);

}  // namespace dymsum
