// Crowded quarter turns: orientations at which so many edges are aligned that a whole slice after the angle costs less
// than the events there. The coordinates of sums are integers then, so which events are theirs is known without
// polynomials.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cspace/events/rotation_events.h"
#include "exact/int.h"

namespace dymsum::planar {

/// The plane of sums at theta = quarter * pi / 2, in 64-bit integers.
class QuarterTurn {
 public:
  /// Whether coordinates are small enough, below 2^28 grid steps: sides have 60 bits, concurrencies 122.
  static bool representable(const TurningForms& forms);
  /// Requires representable(forms).
  QuarterTurn(const TurningForms& forms, int quarter);

  Heading heading() const { return heading_; }
  /// v on the line of s. Exact, as all of these.
  bool on_line(const WalkSegment& s, Pair v) const { return side(s, v) == 0; }
  /// The three lines have a point in common, or are parallel.
  bool concurrent(const WalkSegment& a, const WalkSegment& b, const WalkSegment& c) const;
  /// Whether the coefficients of forms are exact in doubles: coordinates of at most 2^10 grid steps, whose differences,
  /// products and sums of products in TrigForm2 are multiples of 1/2 below 2^52.
  bool exact_forms() const { return exact_forms_; }
  /// Whether an exact form is zero here, and nowhere else within `width`. With d the first derivative that is not zero
  /// here, the m-th one, by Taylor's formula |f(u)| >= |u|^m / m! (|d| - |u| / (m + 1) max |f^(m + 1)|).
  bool zero_here_only(const TrigForm2& f, double width) const { return sign_beside(f, width) != 0; }
  bool zero_here_only(const TrigForm& f, double width) const {
    return zero_here_only(TrigForm2{f.a, f.b, f.g, 0, 0}, width);
  }
  /// The sign of such a form up to `width` after this angle, or before it for a negative width; 0 where
  /// zero_here_only() does not hold.
  int sign_beside(const TrigForm2& f, double width) const;
  /// Edge e of the rotating operand and edge f of the fixed one point in the same direction.
  bool aligned(std::uint32_t e, std::uint32_t f) const;

  /// Whether a form that is zero here has no other zero within `width` of this angle: by Taylor's formula,
  /// |f(u)| >= |u| (|f'| - |u| max |f''| / 2). `error` bounds that of the slope.
  bool only_zero(const TrigForm& f, double width, double error) const {
    return std::abs(f.slope(heading_)) > 0.5 * f.swing() * width + error;
  }
  bool only_zero(const TrigForm2& f, double width, double error) const {
    return std::abs(f.slope(heading_)) > 0.5 * f.bend() * width + error;
  }

 private:
  struct Vec {
    std::int64_t x = 0, y = 0;
  };
  Vec position(Pair v) const { return {at_[0][v.p].x + at_[1][v.q].x, at_[0][v.p].y + at_[1][v.q].y}; }
  Vec direction(const WalkSegment& s) const;
  std::int64_t side(const WalkSegment& s, Pair v) const;

  const TurningForms& forms_;
  Heading heading_;
  bool exact_forms_ = true;
  std::array<std::vector<Vec>, 2> at_;  // vertices, turned
};

struct CrowdedQuarter {
  QuarterTurn turn;
  Alignment pair;       ///< edges that are aligned there: one of many
  double per_edge = 0;  ///< how many are, per edge of the operands
};

/// The end of a window at which a whole slice is due, by one pair of edges of many that are aligned there.
struct CrowdedEnd {
  const QuarterTurn* turn = nullptr;  ///< null where coordinates are too large for it
  Alignment pair;
};

class CrowdedQuarters {
 public:
  /// None where coordinates are too large for QuarterTurn.
  CrowdedQuarters(const TurningForms& forms, const std::vector<Alignment>& alignments);
  /// The quarter turn at an end of a range; null where that is no crowded quarter turn.
  const CrowdedQuarter* at(int chart, double t) const;
  bool any() const {
    return std::any_of(quarters_.begin(), quarters_.end(), [](const auto& q) { return q.has_value(); });
  }

 private:
  std::array<std::optional<CrowdedQuarter>, 4> quarters_;
};

}  // namespace dymsum::planar
