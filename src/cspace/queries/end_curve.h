// The position along its edge at which a patch ends, as a function of the angle near a reference: with derivatives, as
// ranges over intervals, and with errors. theta = reference + x.
#pragma once

#include "cspace/queries/patch_forms.h"
#include "cspace/queries/range.h"

namespace dymsum::cspace {

/// The cosine and the sine of an x with |x| <= 1/2, each to 2^-52.
struct SmallRotation {
  double c = 1, s = 0;
  explicit SmallRotation(double x) {
    const double y = x * x;
    c = 1 - y / 2 * (1 - y / 12 * (1 - y / 30 * (1 - y / 56 * (1 - y / 90 * (1 - y / 132 * (1 - y / 182))))));
    s = x * (1 - y / 6 * (1 - y / 20 * (1 - y / 42 * (1 - y / 72 * (1 - y / 110 * (1 - y / 156 * (1 - y / 210)))))));
  }
};

/// The number k of half turns at which `end` (a mixed crossing) has the angle theta nearest to parallel + k pi.
int nearest_parallel(const PatchEnd& end, double theta);
double parallel_angle(const PatchEnd& end, int k);

class EndCurve {
 public:
  EndCurve() = default;
  /// The curve around a reference angle.
  EndCurve(const PatchEnd& end, double length, double reference);
  /// The curve of a mixed crossing; the reference is its k-th parallel angle plus `psi`, which errs by 2^-50 of itself.
  EndCurve(const PatchEnd& end, double length, int k, double psi);

  bool constant() const { return kind_ == Kind::constant; }
  double value(const SmallRotation& x) const { return std::clamp(raw(x), 0.0, length_); }
  struct Derivatives {
    double value = 0, first = 0, second = 0;
  };
  /// The curve's position on the edge.
  Derivatives derivatives(const SmallRotation& x) const;
  /// The range on the edge, for x between a and b, |a|, |b| <= 1/2.
  Range range(double a, double b) const;
  struct Ranges {
    Range value, first, second;
    bool known = false;  ///< no where the crossing may run away
    double error = 0;    ///< more than the value errs anywhere
    double scale = 0;    ///< no term of it is larger that does not belong to a pole
  };
  Ranges ranges(double a, double b) const;
  /// More than value() errs.
  double error(const SmallRotation& x) const;
  /// The part of [a, b] where the crossing may be on the edge; [a, b] itself where that is no interval.
  Range possible(double a, double b) const;

 private:
  enum class Kind : std::uint8_t { constant, wave, pole };
  struct Sines {  // of psi, and how much they err relatively
    double c = 1, s = 0;
  };
  Sines psi(const SmallRotation& x) const { return {cosine_ * x.c - sine_ * x.s, sine_ * x.c + cosine_ * x.s}; }
  double raw(const SmallRotation& x) const;
  void set_pole(const PatchEnd& end, int k, double psi);
  double error_at(double sine) const;
  bool across_pole(const Sines& a, const Sines& b) const { return gap_ != 0 && !(a.s * b.s > 0); }

  Kind kind_ = Kind::constant;
  bool exact_ = false;  // pole: psi has its relative accuracy
  double length_ = 0, constant_ = 0;
  double first_ = 0, second_ = 0;           // wave: factors of cos x and sin x; pole: of -tan(psi / 2) and 1 / sin(psi)
  double gap_ = 0;                          // pole: second_
  double psi_ = 0, cosine_ = 1, sine_ = 0;  // pole: psi at the reference
  double slack_ = 0;                        // absolute errors of the coefficients
};

}  // namespace dymsum::cspace
