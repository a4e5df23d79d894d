// Roots of the forms of a window of angles, exactly.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "dymsum/solid_rotation_events.h"
#include "exact/algebraic_root.h"
#include "spatial/motion/rotation_forms.h"

namespace dymsum::spatial {

/// A window of angles: t in (low, high] of a chart.
struct RotationRange {
  int chart = 0;
  exact::BigRational low, high;
};

/// Distinct numbers, each with the index of its first root, in order.
class RootOrder {
 public:
  /// The index of a root; a new one where no equal one is there.
  std::uint32_t add(const exact::AlgebraicRoot& root);
  const exact::AlgebraicRoot& operator[](std::uint32_t index) const { return roots_[index]; }
  const std::vector<std::uint32_t>& ascending() const { return ascending_; }
  std::size_t size() const { return roots_.size(); }
  bool is_before(std::uint32_t a, std::uint32_t b) const { return a != b && exact::compare(roots_[a], roots_[b]) < 0; }

 private:
  std::vector<exact::AlgebraicRoot> roots_;
  std::vector<std::uint32_t> ascending_;
};

/// A root of a form: the index of its angle in a window.
struct FormRoot {
  std::uint32_t angle = 0;
  bool changes_sign = true;
};

class WindowRoots {
 public:
  WindowRoots(const RotationCircle& circle, const RotationRange& range, SolidRotationWork& work);

  /// A form of turned vectors as a primitive polynomial in t: a positive multiple of it, factors 1 + |axis|^2 t^2 left
  /// out.
  exact::Polynomial polynomial(exact::Terms form) const;
  /// Its distinct roots in the window, ascending; none where it vanishes at all angles. Many forms have one polynomial.
  const std::vector<FormRoot>& of(const exact::Polynomial& p);
  /// The same, without a polynomial where doubles show that it has no root but 0. What coincides at rest has forms that
  /// vanish there, many of them twice.
  std::vector<FormRoot> of(exact::Terms form);
  RootOrder& angles() { return angles_; }

 private:
  std::vector<FormRoot> find(const exact::Polynomial& p);
  bool has_none(const exact::Terms& form) const;
  const RotationCircle& circle_;
  const RotationRange& range_;
  SolidRotationWork& work_;
  double low_ = 0, high_ = 0;  // just around the window
  RootOrder angles_;
  std::optional<std::uint32_t> zero_;                                      // the index of 0, where it is one
  std::map<std::vector<exact::BigInteger>, std::vector<FormRoot>> known_;  // by coefficients, the last one positive
  exact::RungCounts counts_;
};

}  // namespace dymsum::spatial
