// Intervals of patches in the frame of their edge, where the reference point of a configuration moves on a circle as
// the angle goes on: u along the edge, v off its line.
#pragma once

#include <vector>

#include "cspace/queries/patch_forms.h"

namespace dymsum::cspace {

/// The angles reference + x with x in [low, high] cover a part of a patch; with x in [proved_low, proved_high], if that
/// is not empty, they belong to it. The cosine and the sine are those of the exact reference, which may differ from its
/// double by 2^-50.
struct PatchInterval {
  std::uint32_t patch = 0;
  double reference = 0, low = 0, high = 0, proved_low = 0, proved_high = 0;
  double c = 1, s = 0;
  EndCurve left, right;
};

/// No point of the interval is outside: by x and y, and in the frame of the edge's direction in the middle.
struct IntervalBox {
  PointRange at;
  Point along;  ///< unit vector
  Range u, v, theta;
};

/// Every patch in intervals of at most `longest` <= 1/4 radians. Near the angle at which a crossing would be between
/// parallel lines that angle is the reference, so that x has all its digits.
std::vector<PatchInterval> make_intervals(const CspaceObstacle& obstacle, const PatchForms& forms, double longest);
IntervalBox box_of(const PatchForms& forms, const PatchInterval& interval);

// The distance of a configuration to an interval of a patch as a function of the angle alone: at every angle the patch
// is a segment, beside which the configuration moves on a circle. Lower bounds by values, slopes and least curvatures.

/// What is asked: distances in the metric dx^2 + dy^2 + weight^2 dtheta^2.
struct DistanceQuestion {
  Point from;  ///< relative to the forms' origin
  double theta = 0, weight = 0;
  /// Whether crossings may be passed: every segment then is the whole edge. All of it is part of the obstacle, so that
  /// from outside nothing of it is nearer than the boundary.
  bool whole_edges = false;
};

class IntervalDistance {
 public:
  /// `off`: the angle of the interval's reference less the question's, with the whole turns to be counted.
  IntervalDistance(const PatchForm& form, const PatchInterval& interval, const DistanceQuestion& question, double off);

  struct Bound {
    double distance = 0;  ///< no point with x between the ends is nearer, but for the roundings of positions
    double x = 0;         ///< about where it is nearest
    bool splits = false;  ///< bounds are better on both sides of `split`: the nearest point becomes an end there
    double split = 0;
  };
  /// A lower bound, found without more effort where it turns out to be at least `enough`.
  Bound lower(double low, double high, double enough) const;

  struct Nearest {
    double distance = 0, error = 0;
    double along = 0;  ///< of the own edge
  };
  /// The nearest position at one angle.
  Nearest nearest(double x) const;
  /// The ends move by no more along the edge while x changes by at most `by`; infinite where that is not known.
  double drift(double x, double by) const;

 private:
  struct Position;
  struct Ends;
  enum class Side : std::uint8_t { inside, outside, splits, unknown };
  enum class Part : std::uint8_t { line, left, right };
  struct Parabola {
    double value = 0, slope = 0, curvature = 0;  // the two last ones halved
  };
  Position at(double x) const;
  EndCurve::Ranges end_ranges(const EndCurve& curve, double fixed, double low, double high) const;
  double end_at(const EndCurve& curve, double fixed, const SmallRotation& t) const;
  Side side_of(const EndCurve& curve, double fixed, double sign, const EndCurve::Ranges& end, Range u, Range speed,
               double low, double high, Bound& bound) const;
  double root(const EndCurve& curve, double fixed, double low, double high, double at_low, double at_high) const;
  Parabola parabola(Part part, double x) const;
  double least_curvature(Part part, Range h, Range k, const EndCurve::Ranges& end) const;
  const EndCurve& curve(Part part) const { return part == Part::left ? interval_.left : interval_.right; }
  double fixed(Part part) const { return part == Part::left ? 0 : length_; }

  const PatchInterval& interval_;
  bool whole_;
  double length_, off_, weight_, weight2_;
  double u0_ = 0, v0_ = 0, h_ = 0, k_ = 0, sign_ = 1;  // u = u0 + h, v = v0 + sign k; h' = k, k' = -h
  double tolerance_ = 0;
};

}  // namespace dymsum::cspace
