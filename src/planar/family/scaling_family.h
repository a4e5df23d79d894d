// What a scaling family holds: for its queries, and for files of it.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "dymsum/scaling_family.h"
#include "planar/family/scaling_cells.h"

namespace dymsum {

class ScalingFamily::State {
 public:
  Region p, q;
  Scale low, high, ratio;
  FamilyOptions options;  ///< with no progress, which is of the making alone
  planar::ScalingCells cells;
  FamilyWork work;

  /// The error of a scale outside the interval.
  std::optional<Error> outside(const Scale& s) const;
  /// The error of an interval that is empty or reaches outside.
  std::optional<Error> outside(const Scale& a, const Scale& b) const;
  /// The error of structures that are not all kept.
  std::optional<Error> not_all_kept(const char* what) const;
};

namespace planar {

exact::BigRational value_of(const Scale& s);
/// The error of low > high.
std::optional<Error> empty_interval(const Scale& low, const Scale& high);
/// What cells hold; without the time.
FamilyWork work_of(const ScalingCells& cells);

/// The inside of a family, for files of it.
struct FamilyInternals {
  using State = ScalingFamily::State;
  static const State& of(const ScalingFamily& family) { return *family.state_; }
  static ScalingFamily make(std::unique_ptr<const State> state) { return ScalingFamily(std::move(state)); }
};

}  // namespace planar

}  // namespace dymsum
