// The loops of a frame as rings of a sum, in input coordinates.
#pragma once

#include <functional>
#include <vector>

#include "dymsum/orientation.h"
#include "planar/frame/rotating_loops.h"

namespace dymsum::planar {

/// Of one window at a time.
class TurnedRings {
 public:
  /// `swapped`: P is the moving operand, operand 1 of the forms. `moving_turns`: the moving operand turns in the sum;
  /// otherwise what it stands against does.
  TurnedRings(const OperandPair& forms_base, const TurningForms& forms, bool swapped, bool moving_turns)
      : base_(forms_base), forms_(forms), swapped_(swapped), moving_turns_(moving_turns) {}
  /// Loops are those of frames in this window from now on.
  void enter(const RotatingWindow& window);

  std::size_t bytes() const { return base::bytes_of(names_, corners_); }
  /// The kept loops; `source` knows their exact positions, `spare` gives storage for a ring.
  KeptRings at(const Orientation& theta, const RotatingFrame& frame, RotatingLoops& loops, const ExactSource& source,
               const std::function<SumRing()>& spare);

 private:
  /// From the coordinates of the forms to those of the sum: perhaps turned, scaled, and moved. In this order, as what
  /// is small may be subnormal.
  struct Rigid {
    double c = 1, s = 0, unit = 1;
    Point by;
    Point operator()(double x, double y) const {
      return {(c * x - s * y) * unit + by.x, (s * x + c * y) * unit + by.y};
    }
  };
  /// How the sum names a segment and its end.
  struct Names {
    Contact contact;
    std::uint32_t corner_p = 0, corner_q = 0;
  };
  Rigid to_sum(const Orientation& theta) const;
  double input_error(double error) const;
  const Names& names(std::uint32_t segment);

  const OperandPair& base_;
  const TurningForms& forms_;
  bool swapped_, moving_turns_;
  const RotatingWindow* window_ = nullptr;
  std::vector<Names> names_;            // of segments, made when first asked for
  std::vector<std::uint32_t> corners_;  // scratch: the steps of a ring that end at its vertices
};

}  // namespace dymsum::planar
