// Curves as chains of chords, within an error that is given: arcs of ellipses, and Bezier curves with weights.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "dymsum/read_options.h"
#include "dymsum/region.h"
#include "io/region/ring_order.h"

namespace dymsum::io {

// Affine maps of drawings, in doubles.

/// (x, y) -> (a x + c y + e, b x + d y + f).
struct PlaneTransform {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  bool identity() const { return a == 1 && b == 0 && c == 0 && d == 1 && e == 0 && f == 0; }
  /// This after `inner`.
  PlaneTransform after(const PlaneTransform& inner) const;
  /// Coordinates are rounded as they are computed, except under the identity, and infinite past the double range.
  Point apply(Point p) const;
  /// The image of a vector: without e and f.
  Point apply_vector(Point v) const;
};

/// A chain of chords in its three versions, which begin and end in the same vertices: with its vertices on the curves,
/// and those that lie on the left and on the right of every curve. Without curves the three are equal.
struct ChordChain {
  std::vector<Point> on, left, right;
  std::size_t curves = 0;

  bool empty() const { return on.empty(); }
  Point front() const { return on.front(); }
  Point back() const { return on.back(); }
  /// A straight line to `p`, or the first vertex.
  void add(Point p);
  /// What begins where this ends. Its first vertex is left out.
  void append(const ChordChain& next);
  void reverse();
  void set_front(Point p);
  void set_back(Point p);
  void pop_back();
};

/// start - u + u cos t + v sin t for t from 0 to `sweep`: u leads from the centre to the start. With u and v of one
/// length and at right angles an arc of a circle. There is no centre, which is far away where an arc is nearly
/// straight.
struct EllipseArc {
  Point start, u, v;
  double sweep = 0;  ///< in radians

  Point at(double t) const;
  /// The point at which the tangents meet in the points of t - h and t + h.
  Point corner(double t, double h) const;
  /// The length of its longest half axis, rounded up: the largest factor of lengths in the map of the unit circle.
  double reach() const;
};

/// Appends the arc, up to `to`, where it ends but for rounding, to a chain that ends where it begins.
///
/// The arc is the image of one of the unit circle, in n equal steps of h = |sweep| / n. There a chord is at most
/// 1 - cos(h/2) from its arc, and the corner of the tangents in its two ends 1 / cos(h/2) - 1, which is more. The map
/// multiplies distances by `reach` at most, so that all is within `error` for cos(h/2) >= 1 / (1 + error / reach). The
/// chords lie on the inner side, the tangents on the outer one. Vertices are rounded a few times each.
void append_arc(ChordChain& chain, const EllipseArc& arc, Point to, const CurveOptions& options);

/// Appends the arc through `on` to `to` to a chain that ends where it begins; `on` is one of its vertices. Where the
/// chain ends in `to` that is a circle, and `on` is opposite; where the three lie on a line but for rounding two lines.
void append_three_point_arc(ChordChain& chain, Point on, Point to, const CurveOptions& options);

/// A Bezier curve by its control points and their weights, which are positive.
struct BezierCurve {
  std::vector<Point> points;
  std::vector<double> weights;  ///< empty: all 1
};

/// Appends the curve to a chain that ends where it begins.
///
/// A curve lies in the hull of its control points. Where all of these are within error / 2 of the segment between its
/// ends, so is the curve; and every point of the segment has one of the curve on its normal, as a curve from one end of
/// a segment to the other meets every normal of it. The hull's two sides from one end to the other, which bound the
/// curve on its left and right, are within error / 2 of the segment, too, and so within `error` of the curve. Curves
/// for which that does not hold are split in half; those that are 2^-40 of the whole are one chord.
void append_bezier(ChordChain& chain, const BezierCurve& curve, const CurveOptions& options);

/// The curves between the knots of a spline: control points and weights of each. Requires: as many knots as points and
/// degree + 1, in ascending order, degree at least 1, points more than the degree, weights none or one for each point.
std::vector<BezierCurve> spline_curves(std::size_t degree, const std::vector<double>& knots,
                                       const BezierCurve& control);

/// The error where none is given, in radii of arcs and sizes of other curves.
inline constexpr double kCurveError = 1e-3;

/// The diagonal of the box of control points: the size of a curve.
double curve_size(const std::vector<Point>& points);

/// Thrown where a curve would have more than 10^6 chords, and where it leaves the range of doubles.
enum class CurveTrouble { too_many_chords, not_finite };
struct CurveFailure {
  CurveTrouble trouble;
};

/// What is wrong, for messages.
const char* text_of(const CurveFailure& failure);

// Arcs as DXF has them: by angles in degrees, and by bulges.

/// Ends of lines and arcs that differ by at most this fraction of an arc's radius are one: the angles of arcs are
/// rounded in files, and where an arc ends is rounded here.
inline constexpr double kArcJoint = 1e-6;

/// The arc from `from` to `to` with the bulge b = tan(angle / 4), counter-clockwise for b > 0; both ends lie on it but
/// for rounding. Requires: b finite and not 0, from and to different.
EllipseArc bulge_arc(Point from, Point to, double b);

/// The arc of a circle, counter-clockwise from one angle to another one, in degrees. Nothing where both are the same
/// direction.
std::optional<EllipseArc> degree_arc(Point centre, double radius, double from_degrees, double to_degrees);

/// (cos, sin) of an angle in degrees, exact at multiples of 90.
Point direction(double degrees);

/// The point of a circle in that direction.
Point on_circle(Point centre, double radius, double degrees);

/// All of an ellipse from the end of its first half axis on, once around: four arcs, which end exactly where the half
/// axes do but for one rounding.
ChordChain ellipse_ring(Point centre, Point u, Point v, const CurveOptions& options);

// Rings with curves, nested, and on one side of their curves.

/// Nests closed chains, whose last vertices are not repeated, as nest_rings does by their vertices on the curves; then
/// every ring is the version of its chain inside of the region, or outside, as `bound` says. False as nest_rings.
bool nest_chains(std::vector<ChordChain> chains, std::vector<Part>& parts, CurveBound bound,
                 FillRule rule = FillRule::even_odd);

/// The versions of rings of one part, the outer one first, as `bound` says; the part is oriented.
Part part_of_chains(std::vector<ChordChain> rings, CurveBound bound);

}  // namespace dymsum::io
