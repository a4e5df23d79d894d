// Exact signs of points given as rationals: order, orientation, and the position of a point against closed rings. The
// nearest doubles are tried first; they never decide unless their error bound proves the sign.
#pragma once

#include <span>
#include <vector>

#include "planar/position/exact_source.h"

namespace dymsum::planar {

using Position = ExactSource::Position;
using Homogeneous = ExactSource::Homogeneous;

/// The position over the least common denominator.
Homogeneous homogeneous(const Position& p);
/// The position in lowest terms.
Position reduced(const Homogeneous& p);

/// The sign of a - b. (Boost's own comparison of rationals expands continued fractions.)
int compare(const exact::BigRational& a, const exact::BigRational& b);
/// Lexicographic order: -1, 0, 1.
int compare(const Position& a, const Position& b);

/// A position with its nearest doubles. Rounding to nearest is monotone: nearest coordinates that differ are in the
/// order of the exact ones.
struct Spot {
  Position exact;
  Point nearest;
};

Spot make_spot(Position p);
/// The spot at a double point. Requires: finite.
Spot make_spot(Point p);

int compare_x(const Spot& a, const Spot& b);
int compare_y(const Spot& a, const Spot& b);
/// Lexicographic order: -1, 0, 1.
int compare(const Spot& a, const Spot& b);
/// The sign of (b - a) x (c - a): 1 where c lies left of the directed line from a to b, 0 on it, -1 right.
int orientation(const Spot& a, const Spot& b, const Spot& c);
/// The same sign from the doubles alone, or 0 where their error bound does not decide.
int orientation_filtered(Point a, Point b, Point c);
/// True when c lies on the closed segment from a to b.
bool on_segment(const Spot& a, const Spot& b, const Spot& c);
/// True when the open segments a b and c d cross in one point.
bool cross_properly(const Spot& a, const Spot& b, const Spot& c, const Spot& d);

enum class Location { outside, boundary, inside };

/// The location of q against a closed ring of either orientation. O(n).
Location locate(std::span<const Spot> ring, const Spot& q);
/// The location of q against the set bounded by rings that do not cross (even-odd). O(n).
Location locate(const std::vector<std::vector<Spot>>& rings, const Spot& q);

}  // namespace dymsum::planar
