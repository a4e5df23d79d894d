// Forms of rotation around one angle. Off the grid shapes have lines that coincide but for a rounding: sides and cross
// products that are 10^-16 there and of which doubles know nothing. Taken at that angle from coordinates in pairs of
// doubles, their coefficients are small numbers known to all digits, and ordinary doubles tell what happens near it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/doubles.h"
#include "exact/int.h"
#include "planar/window/rotating_window.h"

namespace dymsum::planar {

// The window of angles between two exact ones: its segments, and the pairs of them that may meet.

/// t in (t_low, t_high] of a chart.
struct RotationRange {
  int chart = 0;
  double t_low = 0, t_high = 0;
  double theta(double t) const { return 2 * std::atan(t) + (chart == 1 ? std::numbers::pi : 0.0); }
};

class EventWindow : public RotatingWindow {
 public:
  EventWindow(const RotationGrid& grid, const RotationCatalog& catalog, const RotationRange& range, bool mask);

  /// Segments of which pieces may meet, a < b.
  struct SegmentPair {
    std::uint32_t a = 0, b = 0;
    friend auto operator<=>(const SegmentPair&, const SegmentPair&) = default;
  };
  RotationRange range;
  double low = 0, high = 0;               ///< angles, rounded outwards
  base::CountedArray<SegmentPair> pairs;  ///< sorted

  /// Whether two segments are a pair. Requires a < b. By the few pairs of a.
  bool meet(std::uint32_t a, std::uint32_t b) const;

 private:
  void sort_pairs();
  std::vector<std::uint32_t> pairs_of_;  // those of segment a are pairs[pairs_of_[a] .. pairs_of_[a + 1])
};

/// c0 + c1 u + ... + c4 u^4 with u = tan(phi / 2), phi being the angle less the one around which forms are taken. The
/// coefficients err by at most `error`. A form of degree 1 is multiplied by 1 + u^2, the product of two by its square:
/// signs and roots are those of the form.
struct NearPolynomial {
  std::array<double, 5> c{}, error{};
  int degree = 0;

  void divide();  ///< by u

  struct Value {
    double at = 0, error = 0;
    /// 0 where that is not known.
    int sign() const { return at > error ? 1 : at < -error ? -1 : 0; }
  };
  Value operator()(double u) const;
  /// The value for all in [low, high], half of whose width is small: that at the midpoint, with all that it changes by.
  Value within(double low, double high) const;
};
/// x y - z w for forms of degree 1, which have polynomials of degree 2.
NearPolynomial difference_of_products(const NearPolynomial& x, const NearPolynomial& y, const NearPolynomial& z,
                                      const NearPolynomial& w);
/// The sign that it provably has in all of [low, high]; else 0.
int sign_in(const NearPolynomial& p, double low, double high);

/// An interval that may hold roots.
struct NearRoot {
  double low = 0, high = 0;
  bool known = true;  ///< narrow: at most 2^-44
};
/// Intervals that hold all roots in [low, high], a few of them: narrow ones around simple roots, and what is left after
/// some dozens of halvings.
std::vector<NearRoot> near_roots(const NearPolynomial& p, double low, double high);

/// A form in pairs of doubles: a + b (cos phi - 1) + g sin phi.
struct PairForm {
  base::DoublePair a, b, g;
  double floor = 0;  ///< each coefficient errs by at most this
  /// This form less t times another one.
  PairForm minus(double t, const PairForm& o) const;
  NearPolynomial polynomial() const;
};

/// The polynomial of a form of degree 1 in integers.
struct ExactQuadratic {
  std::array<exact::Int<130>, 3> c{exact::Int<130>::from_int64(0), exact::Int<130>::from_int64(0),
                                   exact::Int<130>::from_int64(0)};
  NearPolynomial polynomial() const;  ///< each coefficient is rounded, those that are zero not at all
};
/// x y - z w, rounded alike.
NearPolynomial difference_of_products(const ExactQuadratic& x, const ExactQuadratic& y, const ExactQuadratic& z,
                                      const ExactQuadratic& w);

class NearAngle {
 public:
  /// Forms around theta = 2 atan(t) + pi chart.
  NearAngle(const TurningForms& forms, int chart, double t);

  double tangent() const { return t_; }
  /// The range of u in a range of the same chart, rounded outwards.
  std::array<double, 2> range(const RotationRange& range) const;
  /// theta of u, within kAngleDouble and a rounding.
  double theta_of(double u) const { return theta_ + 2 * std::atan(u); }

  /// The forms of TurningForms in other units: times a power of two.
  PairForm side(const WalkSegment& s, Pair v) const;
  PairForm cross(const WalkSegment& s, const WalkSegment& t) const { return cross(s.side, s.edge, t.side, t.edge); }
  PairForm cross(std::uint32_t side, std::uint32_t edge, std::uint32_t other_side, std::uint32_t other) const;
  /// The same exactly, times a power of two, around quarter turns of operands of up to 2^62 grid steps, in these.
  bool exact() const { return exact_; }
  ExactQuadratic exact_side(const WalkSegment& s, Pair v) const;
  ExactQuadratic exact_cross(const WalkSegment& s, const WalkSegment& t) const {
    return exact_cross(s.side, s.edge, t.side, t.edge);
  }
  ExactQuadratic exact_cross(std::uint32_t side, std::uint32_t edge, std::uint32_t other_side,
                             std::uint32_t other) const;
  /// Exactly where that is there.
  NearPolynomial side_polynomial(const WalkSegment& s, Pair v) const {
    return exact_ ? exact_side(s, v).polynomial() : side(s, v).polynomial();
  }
  NearPolynomial cross_polynomial(std::uint32_t side, std::uint32_t edge, std::uint32_t other_side,
                                  std::uint32_t other) const {
    return exact_ ? exact_cross(side, edge, other_side, other).polynomial()
                  : cross(side, edge, other_side, other).polynomial();
  }
  double length1(const WalkSegment& s) const { return length_[s.side][s.edge]; }

 private:
  struct Vec {
    base::DoublePair x, y;
  };
  static base::DoublePair cross_of(const Vec& d, const Vec& e) { return d.x * e.y - d.y * e.x; }
  static base::DoublePair dot_of(const Vec& d, const Vec& e) { return d.x * e.x + d.y * e.y; }
  struct ExactVec {
    exact::Int<62> x = exact::Int<62>::from_int64(0), y = exact::Int<62>::from_int64(0);
  };
  ExactQuadratic exactly_around(const exact::Int<128>& a, const exact::Int<128>& b, const exact::Int<128>& g) const;
  PairForm around(base::DoublePair a, base::DoublePair b, base::DoublePair g, double floor) const;

  const TurningForms& forms_;
  double t_, theta_;
  base::DoublePair cos_, sin_;
  std::array<std::vector<Vec>, 2> at_, edge_;
  std::array<std::vector<double>, 2> length_;
  double span_ = 0;
  bool exact_ = false;
  std::array<std::vector<ExactVec>, 2> exact_at_;
};

}  // namespace dymsum::planar
