// Roots of the forms of a window of angles, exactly.
#pragma once

#include "dymsum/turning_solid_sum.h"
#include "exact/algebraic_root.h"
#include "spatial/turning/turn_forms.h"

namespace dymsum::spatial {

/// A window of angles: t in (low, high] of a chart.
struct TurnRangeOfT {
  int chart = 0;
  exact::BigRational low, high;
};

class WindowRoots {
 public:
  WindowRoots(const TurnCircle& circle, const TurnRangeOfT& range, TurningSolidWork& work);

  /// A form of turned vectors as a primitive polynomial in t: a positive multiple of it, factors 1 + |axis|^2 t^2 left
  /// out.
  exact::Polynomial polynomial(exact::Terms form) const;
  /// Its distinct roots in the window, ascending; none where it vanishes at all angles.
  std::vector<exact::AlgebraicRoot> of(const exact::Polynomial& p);
  std::vector<exact::AlgebraicRoot> of(exact::Terms form) { return of(polynomial(std::move(form))); }

 private:
  const TurnCircle& circle_;
  const TurnRangeOfT& range_;
  TurningSolidWork& work_;
  double low_ = 0, high_ = 0;  // just around the window
  exact::FilterCounts counts_;
};

}  // namespace dymsum::spatial
