// Ends of bridges and vertices of pockets: points that are doubles, or exact ones beside their doubles.
#pragma once

#include <memory>
#include <vector>

#include "exact/interval.h"
#include "shape/complex/complex.h"

namespace dymsum::shape {

/// A point in input coordinates; the whole line where they are too large or small for that.
struct FinePoint {
  exact::FineInterval x, y;
};

struct Position {
  Point at;                                                                       ///< each coordinate rounded
  std::shared_ptr<const ExactPoint> exact;                                        ///< null: it is `at`
  FinePoint fine = {exact::FineInterval::whole(), exact::FineInterval::whole()};  ///< of `exact`
};

/// The signs of (b - a) x (d - c) and (b - a) . (d - c), exactly.
int cross_sign(const Position& a, const Position& b, const Position& c, const Position& d);
int dot_sign(const Position& a, const Position& b, const Position& c, const Position& d);
inline int turn_sign(const Position& a, const Position& b, const Position& c) { return cross_sign(a, b, a, c); }

/// How far p lies to the left of the line a -> b: the double nearest to that distance, 0 to the right of it and where a
/// and b are one point.
double distance_left(const Position& a, const Position& b, const Position& p);

/// The length of the straight pieces through these positions, and of the path from the last one square to the line a ->
/// b where it lies to the left of that: the double nearest to their sum. So it does not depend on the order in which
/// pieces are added, nor on how the positions are turned by quarter turns or mirrored. Requires: a position.
double way_length(const std::vector<const Position*>& path, const Position& a, const Position& b);

/// A centre of a disc that touches sites. The fine centre is that of the exact one, or the whole plane.
struct Centre {
  ExactPoint exact;
  FinePoint fine = {exact::FineInterval::whole(), exact::FineInterval::whole()};
};
Centre centre_of(const Complex& complex, std::uint32_t node);
Position contact_position(const Complex& complex, std::uint32_t site, const Centre& centre);

}  // namespace dymsum::shape
