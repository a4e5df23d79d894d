// The exact layer of the planar engine: two operands as integer points, and the signs everything is decided by.
// Four number tiers stand behind one interface; callers filter in doubles first and ask here only when that fails.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dymsum/region.h"
#include "exact/big.h"
#include "exact/rounding_bound.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

// What the doubles of edge vectors and of sums of vertices lose: bounds of soups, arrangements and collisions, where
// both operands rest.
//
// In units u of roundoff, with L = |edge vector|_1 and S the span. A coordinate of a vertex carries 1 rounding, of a
// scaled or rotated operand 3: its own, the factor's and the product's.
//   point   3 S of the coordinates, and the sum.
//   side    d x (v - start): two points and their difference 9 S, the edge vector 3, product and difference 1 each:
//           14 L S. Where v is a position, its own error counts instead of one point's: 10 L S.
//   share   of a segment where another one crosses it, n / (n - m) for the sides n and m of its ends: what n and m err
//           by is weighted with 1 - t and t, so t errs by what one side does over |n - m|.

/// The error of x y' - y x' for vectors whose components carry one rounding each is this times |x y'| + |y x'|: two of
/// the factors, the product and the difference.
inline constexpr double kEdgeCross = exact::rounding_bound(4, 8);
/// The same for those of a scaled or rotated operand, which carry three each.
inline constexpr double kScaledEdgeCross = exact::rounding_bound(8, 16);
/// The error of the difference of two such components is this times the sum of both.
inline constexpr double kScaledEdgeGap = exact::rounding_bound(4, 8);

/// The error of each coordinate of the sum of two vertices is this times the span.
// No slack is needed. With a vertex x and its factor s in [1, 2), and their product rounded to p in [1, 2), the
// roundings of x, s, p and the sum err by u (x + s) + u^2 + 2 u, where x + s <= 1 + x s: no more than 4 u p, as p = 1
// only for x = s = 1, when the product is exact. In the binades above, each u of a rounding is 2 u of twice the number.
inline constexpr double kSumPoint = 4 * exact::kRoundoff;
/// The error of the side of a vertex or a position is this times L and the span.
inline constexpr double kSumSide = exact::rounding_bound(14, 16);
/// How far apart a box and a position, or two boxes at a position, have to be, times the span: coordinates, two
/// differences, and the margin taken off.
inline constexpr double kSumBox = exact::rounding_bound(3 + 1 + 3, 16);
/// The same for a vertex's height over a position: the sum of two vertices, and the difference.
inline constexpr double kSumHeight = exact::rounding_bound(4 + 1, 8);

/// Sides whose signs are known otherwise are taken for at least this fraction of a side error.
inline constexpr double kLeastSide = 0.5;
/// The error of a fraction of a crossing is this times side error / |d x e|. Sides err by 3/2 of one, as they are taken
/// for kLeastSide at least; n - m differs from d x e by 3 of them, and d x e by 1. |d x e| is more than 8 where the
/// fraction says anything, so n - m is at least half of it.
inline constexpr double kCrossingFractions = 8;
static_assert((1 + kLeastSide) / (1 - (2 * (1 + kLeastSide) + 1) / kCrossingFractions) <= kCrossingFractions);
/// The same of a vertex on a segment, times point error / max(|dx|, |dy|): two points, and what the vector errs by;
/// kept as a float.
inline constexpr double kTouchFractions = 4;
static_assert(3 <= kTouchFractions * (1 - exact::kFloatRoundoff));
/// The absolute error besides: the difference, the quotient and what is made of fractions up to 1 by three operations.
inline constexpr double kFractionRoundings = exact::rounding_bound(5, 8);
/// The error of the weight w of a mediant is this times what both denominators err by, as fractions of themselves: w
/// errs by at most w (1 - w) (r + s) / (1 - r - s) <= (r + s) / 2 where r + s <= 1/2, and by less than 1 anywhere.
inline constexpr double kMediantFractions = 2;
static_assert(kMediantFractions * 0.5 >= 1);

/// The error of start + t d beside those of the start and of t is these times |d| and the span: product and sum. What d
/// is rounded by is less than another error of a point, which is counted with the start.
inline constexpr double kStepLength = exact::rounding_bound(1, 4), kStepSum = exact::rounding_bound(1, 2);
/// The error of a position rounded from the exact one relative to a pair of vertices is this times the span: the
/// difference, two vertices of three roundings each and two sums.
inline constexpr double kRoundedPosition = exact::rounding_bound(9, 32);

/// Positions that are known worse than this, times the span, are rounded from the exact ones. Any value is right.
inline constexpr double kPoorPosition = 0x1p-38;

/// A directed edge between two source vertices of operand `op` (0 = P, 1 = Q).
struct Edge {
  std::uint32_t op = 0, from = 0, to = 0;
};

/// A directed segment of the plane of sums: edge + vertex of the other operand.
struct Segment {
  Edge edge;
  std::uint32_t vertex = 0;
};

/// The sum of a vertex of P and a vertex of Q.
struct Pair {
  std::uint32_t p = 0, q = 0;
  friend bool operator==(const Pair&, const Pair&) = default;
};

inline Pair start_of(const Segment& s) {
  return s.edge.op == 0 ? Pair{s.edge.from, s.vertex} : Pair{s.vertex, s.edge.from};
}
inline Pair end_of(const Segment& s) { return s.edge.op == 0 ? Pair{s.edge.to, s.vertex} : Pair{s.vertex, s.edge.to}; }
inline Segment reversed(const Segment& s) { return {{s.edge.op, s.edge.to, s.edge.from}, s.vertex}; }

/// A point on the line of a segment `on`: a pair of vertices lying on it, or its crossing with the line of `by`.
struct Cut {
  enum class Kind : std::uint8_t { pair, crossing };
  Kind kind = Kind::pair;
  Pair pair;
  Segment by;
};

/// A point of the plane of sums, exactly: the cut `first` on `on`, or (between) the mediant of two cuts: a point
/// strictly between them on `on`.
struct SegmentPosition {
  Segment on;
  Cut first, second;
  bool between = false;
  double x = 0, y = 0, error = 0;  ///< |x - exact| and |y - exact| are at most error
};

/// The vertices of a rotated operand as integers, exactly: a and b of (a, -b; b, a) times the grid integers, minus the
/// smallest coordinate of each axis.
struct TurnedPoints {
  std::vector<std::array<exact::i128, 2>> at;         ///< empty where 125 bits are not enough
  std::vector<std::array<exact::BigInteger, 2>> big;  ///< then these
  std::array<exact::BigInteger, 2> low;               ///< what was subtracted
  double factor = 1;                                  ///< of `at`: from integers to the lattice's doubles, rounded
  exact::BigRational big_factor = 1;                  ///< of `big`: the same
  std::size_t size() const { return at.empty() ? big.size() : at.size(); }
  /// The vector from one vertex to another, each component with three roundings; zero only where it is.
  Point vector(std::uint32_t from, std::uint32_t to) const;
  /// The same, times a power of two, so that the larger component is far from under- and overflow.
  Point direction(std::uint32_t from, std::uint32_t to) const;
  double rounded(std::uint32_t i, int axis) const;
  /// The sign of coordinate(i) - coordinate(j) along an axis.
  int compare(std::uint32_t i, std::uint32_t j, int axis) const;
};

struct FractionPoints;

/// The source vertices of one operand: as given, and relative to the smallest corner of their bounding box.
struct PlacedPoints {
  std::vector<Point> input;
  Point offset;
  std::vector<double> x, y;      ///< input - offset in units of 2^unit, rounded once
  double width = 0, height = 0;  ///< the largest x and y
  Point factors{1, 1};           ///< the factors by which x and y are scaled besides, rounded: three roundings in all
  std::shared_ptr<const TurnedPoints> turned;  ///< of a rotated operand: x and y are these then
  /// The exact positions of the result of other operations, where some vertices are no doubles: x and y are these then,
  /// and `input` their nearest doubles.
  std::shared_ptr<const FractionPoints> fractions;
  double extent = 0;  ///< the larger of both, in input units
  int exponent = 0;   ///< the largest grid that holds them: all are multiples of 2^exponent
  int unit = 0;
  int top = 0;  ///< the extent is at most 2^top, with its rounding
  /// The bits of the integers on a grid that holds them.
  int bits(int grid_exponent) const { return top > grid_exponent ? top - grid_exponent : 0; }
  /// Nothing can over- or underflow when the unit is 1.
  bool moderate() const { return exponent >= -kModerateBits && top <= kModerateBits; }
  static constexpr int kModerateBits = 400;
};

/// Beyond so many bits of the unscaled integers no unit keeps all doubles moderate: see Lattice::wide.
inline constexpr int kNarrowBits = 920;

/// A rounded component of a vector whose exact one has the sign of `gap`: one that underflowed is the smallest number
/// of that sign, so that signs and zeros of components are those of the exact ones.
inline double with_sign_of(double gap, double component) {
  return component != 0 || gap == 0 ? component : std::copysign(std::numeric_limits<double>::denorm_min(), gap);
}

/// Placed in units of 1 where they are moderate, else in units in which they are where there are any.
std::shared_ptr<const PlacedPoints> place_points(std::vector<Point> input);

/// The unscaled integers of both operands, shared by the lattices of all scales; made when first requested. Requires
/// 125 bits or fewer.
struct SharedIntegers {
  std::once_flag made;
  std::array<std::vector<std::array<exact::i128, 2>>, 2> at;
};

/// What a lattice reports in doubles.
struct LatticeDoubles {
  int tier_bits = 0;           ///< 29, 61, 512, 0
  bool exact_doubles = false;  ///< every planar sign of degree two is exact when computed in doubles
  /// Not zero: what the doubles of vertices, edges and pair sums have to be multiplied with to be the integers,
  /// exactly. Set where these have at most 29 bits: then signs of degree two are those of 64-bit expressions, orders of
  /// cuts of 128-bit ones.
  double to_integers = 0;
  bool exact_input = false;  ///< pair sums in input coordinates are doubles without rounding
  double span = 0;           ///< every pair sum has coordinates in [0, span]; a rounding errs by at most span * 2^-53
  double unit = 1;           ///< doubles count multiples of this power of two: 1 unless an operand is huge or minute
  /// Not all numbers are moderate in these units: components of vectors can underflow, by less than 2^-1074, while
  /// coordinates are below 2^62. Sums of two products lose less than exact::kUnderflow by it, and are filtered with
  /// that; lengths and angles of such vectors say nothing. Only sums that do not move allow it.
  bool wide = false;
  double integers_per_unit = 1;  ///< the exact layer's integers per unit of the doubles; may be infinite where wide
  int grid_exponent = 0;         ///< unscaled coordinates are integers times 2^grid_exponent
  std::array<std::shared_ptr<const PlacedPoints>, 2> points;
  std::shared_ptr<SharedIntegers>
      integers;           ///< of unscaled coordinates, only for lattices made for further ones, and these
  Point base;             ///< the sum of the offsets in input coordinates, rounded
  double base_reach = 0;  ///< the sum of their absolute coordinates
  double base_error = 0;  ///< of base, beyond one rounding

  /// Edge vector, each component rounded once, three times where the operand is scaled.
  Point vector(const Edge& e) const {
    const PlacedPoints& o = *points[e.op];
    if (o.turned != nullptr) return o.turned->vector(e.from, e.to);
    if (o.fractions != nullptr) return fraction_vector(o, e);
    const Point &a = o.input[e.from], &b = o.input[e.to];
    const double x = b.x - a.x, y = b.y - a.y;
    return {with_sign_of(x, x / unit * o.factors.x), with_sign_of(y, y / unit * o.factors.y)};
  }
  /// The same for angles: times a factor of the edge's own, so that nothing underflows that an angle depends on.
  Point direction(const Edge& e) const {
    const PlacedPoints& o = *points[e.op];
    if (!wide) return vector(e);
    if (o.turned != nullptr) return o.turned->direction(e.from, e.to);
    if (o.fractions != nullptr) return fraction_direction(o, e);
    // Differences of doubles never underflow, nor do they overflow below 2^1000.
    const Point &a = o.input[e.from], &b = o.input[e.to];
    return {b.x - a.x, b.y - a.y};
  }
  /// d integers_per_unit, where this is infinite too.
  double in_integers(double d) const {
    return integers_per_unit < std::numeric_limits<double>::infinity() ? d * integers_per_unit
                                                                       : std::ldexp(d * mantissa, integer_exponent);
  }
  double mantissa = 1;       ///< integers_per_unit is mantissa 2^integer_exponent,
  int integer_exponent = 0;  ///< mantissa in [1, 2]
  /// A rounded position in input coordinates.
  Point to_input(double gx, double gy) const { return {gx * unit + base.x, gy * unit + base.y}; }

 private:
  static Point fraction_vector(const PlacedPoints& points, const Edge& e);
  static Point fraction_direction(const PlacedPoints& points, const Edge& e);
};

/// Integer operands and exact signs. Coordinates are grid units relative to one offset per operand, so that a
/// translation of an operand never costs bits.
class Lattice : public LatticeDoubles {
 public:
  explicit Lattice(LatticeDoubles doubles) : LatticeDoubles(std::move(doubles)) {}
  virtual ~Lattice() = default;

  /// The sign of d x e, of d . e for two edge vectors.
  virtual int cross(const Edge& d, const Edge& e) const = 0;
  virtual int dot(const Edge& d, const Edge& e) const = 0;
  /// The sign of d - e along an axis (0 = x, 1 = y).
  virtual int compare_extent(const Edge& d, const Edge& e, int axis) const = 0;
  /// The side of the directed line of s on which a pair lies: 1 left, 0 on it, -1 right; and the sign of d . (v -
  /// start).
  virtual int side(const Segment& s, Pair v) const = 0;
  virtual int along(const Segment& s, Pair v) const = 0;
  virtual bool same(Pair a, Pair b) const = 0;
  /// The sign of a - b along an axis (0 = x, 1 = y).
  virtual int compare_coordinate(Pair a, Pair b, int axis) const = 0;
  /// The same for any position.
  virtual int side(const Segment& s, const SegmentPosition& x) const = 0;
  virtual int along(const Segment& s, const SegmentPosition& x) const = 0;
  /// Order along `on` of two cuts on it: -1, 0, 1.
  virtual int compare(const Segment& on, const Cut& a, const Cut& b) const = 0;
  /// The sign of a - b along an axis, for any places.
  virtual int compare_coordinate(Pair a, const SegmentPosition& b, int axis) const = 0;
  virtual int compare_coordinate(const SegmentPosition& a, const SegmentPosition& b, int axis) const = 0;
  using Position = ExactSource::Position;
  using Homogeneous = ExactSource::Homogeneous;
  using NearFrame = ExactSource::NearFrame;
  using NearPosition = ExactSource::NearPosition;
  /// The exact position in input coordinates.
  Position position(const SegmentPosition& x) const;
  Position position(Pair v) const;
  /// The same, not in lowest terms.
  virtual Homogeneous homogeneous(const SegmentPosition& x) const = 0;
  virtual Homogeneous homogeneous(Pair v) const = 0;
  /// Positions to some thirty digits, in units of the exact layer's integers; no frame where these have over 400 bits.
  virtual std::optional<NearFrame> near_frame() const = 0;
  virtual NearPosition near(const SegmentPosition& x) const = 0;
  virtual NearPosition near(Pair v) const = 0;

  /// Requires: tier_bits is not 0, and the lattice was made for further ones.
  virtual const SharedIntegers& unscaled_integers() const = 0;
};

/// Whether scaled and rotated lattices will be made from this one.
enum class Further { none, lattices };

/// Both operands on their common grid, or as fractions where one of them has these. `min_tier_bits` forces a larger
/// tier. Points are placed anew when their units differ.
std::shared_ptr<const Lattice> make_lattice(std::shared_ptr<const PlacedPoints> p,
                                            std::shared_ptr<const PlacedPoints> q, int min_tier_bits,
                                            Further further = Further::none);

/// diag(x, y) / den, or a rotation, applied to operand `op`, about the origin of its input coordinates.
struct LatticeScale {
  exact::BigInteger x = 1, y = 1, den = 1;  ///< all positive; of a rotation x = y has any sign
  std::uint32_t op = 0;
  exact::BigInteger turn = 0;  ///< not zero: (x, -turn; turn, y) instead, a rotation, x^2 + turn^2 = den^2
};

/// The lattice of two operands of which one is scaled: integers are the scaled operand's times x or y and the other's
/// times den; the doubles still count units of the unscaled lattice, which make_lattice has made for
/// further ones. O(n), a few operations a vertex.
std::shared_ptr<const Lattice> make_scaled_lattice(const Lattice& unscaled, const LatticeScale& scale,
                                                   int min_tier_bits);
/// The same for a rotation, by any angle, zero and pi too: vertices are never snapped.
std::shared_ptr<const Lattice> make_turned_lattice(const Lattice& unscaled, const LatticeScale& rotation,
                                                   int min_tier_bits);

// Places known by their exact positions alone.

/// Gives a position the doubles of its exact position, and their error. Rounded from the start of its segment, whose
/// doubles are those that filters have of it.
void round_position(const Lattice& lattice, SegmentPosition& position);

}  // namespace dymsum::planar
