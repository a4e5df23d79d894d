// The exact layer of the planar engine: two operands as integer points, and the signs everything is decided by.
// Four number tiers stand behind one interface; callers filter in doubles first and ask here only when that fails.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "dymsum/region.h"
#include "exact/big.h"

namespace dymsum::planar {

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
inline Pair end_of(const Segment& s) {
  return s.edge.op == 0 ? Pair{s.edge.to, s.vertex} : Pair{s.vertex, s.edge.to};
}

/// A point on the line of a segment `on`: a pair of vertices lying on it, or its crossing with the line of `by`.
struct Cut {
  enum class Kind : std::uint8_t { pair, crossing };
  Kind kind = Kind::pair;
  Pair pair;
  Segment by;
};

/// A point of the plane of sums, exactly: the cut `first` on `on`, or (between) the mediant of two cuts: a point strictly
/// between them on `on`.
struct Place {
  Segment on;
  Cut first, second;
  bool between = false;
  double x = 0, y = 0, error = 0;  ///< |x - exact| and |y - exact| are at most error
};

/// The unscaled integers of both operands, shared by the lattices of all scales; made when first asked for. Requires 125 bits or fewer.
struct SharedIntegers {
  std::once_flag made;
  std::array<std::vector<std::array<exact::i128, 2>>, 2> at;
};

/// Integer operands and exact signs. Coordinates are grid units relative to one offset per operand, so that a translation of an
/// operand never costs bits.
class Lattice {
 public:
  virtual ~Lattice() = default;

  /// The sign of d x e, of d . e for two edge vectors.
  virtual int cross(const Edge& d, const Edge& e) const = 0;
  virtual int dot(const Edge& d, const Edge& e) const = 0;
  /// The sign of d - e along an axis (0 = x, 1 = y).
  virtual int compare_extent(const Edge& d, const Edge& e, int axis) const = 0;
  /// The side of the directed line of s on which a pair lies: 1 left, 0 on it, -1 right; and the sign of d . (v - start).
  virtual int side(const Segment& s, Pair v) const = 0;
  virtual int along(const Segment& s, Pair v) const = 0;
  virtual bool same(Pair a, Pair b) const = 0;
  /// The sign of a - b along an axis (0 = x, 1 = y).
  virtual int compare_coordinate(Pair a, Pair b, int axis) const = 0;
  /// The same for any place.
  virtual int side(const Segment& s, const Place& x) const = 0;
  virtual int along(const Segment& s, const Place& x) const = 0;
  /// The sign of (v - x).y.
  virtual int height(Pair v, const Place& x) const = 0;
  /// Order along `on` of two cuts on it: -1, 0, 1.
  virtual int compare(const Segment& on, const Cut& a, const Cut& b) const = 0;
  /// The sign of a - b along an axis, for any places.
  virtual int compare_coordinate(const Place& a, const Place& b, int axis) const = 0;
  /// The exact position in input coordinates.
  struct Position {
    exact::BigRational x, y;
  };
  virtual Position position(const Place& x) const = 0;
  virtual Position position(Pair v) const = 0;

  /// Requires tier_bits != 0.
  virtual const SharedIntegers& unscaled_integers() const = 0;

  int tier_bits = 0;           ///< 29, 61, 512, 0
  bool exact_doubles = false;  ///< every planar sign of degree two is exact when computed in doubles
  double span = 0;             ///< every pair sum has coordinates in [0, span]; a rounding errs by at most span * 2^-53
  int double_exponent = 0;     ///< doubles count units of 2^double_exponent: grid units in the two small tiers
  /// The source vertices relative to their operand's offset, rounded once (scaled ones three times).
  std::array<std::vector<double>, 2> x, y;
  std::array<std::vector<Point>, 2> input;
  std::array<Point, 2> offset;
  std::shared_ptr<SharedIntegers> integers;  ///< of unscaled coordinates
  int grid_exponent = 0;       ///< unscaled coordinates are integers times 2^grid_exponent

  double per_unit = 1;         ///< 2^-double_exponent
  std::array<Point, 2> stretch{Point{1, 1}, Point{1, 1}};  ///< the factors of a scaled lattice, rounded
  double integers_per_unit = 1;  ///< the exact layer's integers per unit of the doubles; may be infinite for huge exponents
  double offset_error = 0;     ///< of the sum of the offsets, in input coordinates, beyond its own rounding
  /// Edge vector, each component rounded once (three times where the operand is scaled).
  Point vector(const Edge& e) const {
    const Point &a = input[e.op][e.from], &b = input[e.op][e.to];
    return {(b.x - a.x) * per_unit * stretch[e.op].x, (b.y - a.y) * per_unit * stretch[e.op].y};
  }
  /// A rounded position in input coordinates.
  Point to_input(double gx, double gy) const;
};

/// diag(x, y) / den applied to operand `op`, about the origin of its input coordinates.
struct LatticeScale {
  exact::BigInteger x = 1, y = 1, den = 1;  ///< all positive
  std::uint32_t op = 0;
};

/// Places both operands on their common grid. `min_tier_bits` forces a larger tier. Both spans hold source vertices.
std::unique_ptr<Lattice> make_lattice(std::span<const Point> p, std::span<const Point> q, int min_tier_bits);

/// The lattice of two operands of which one is scaled: integers are the scaled operand's times x or y and the other's times den; the
/// doubles still count unscaled grid units. `input` holds the unscaled vertices.
/// Requires: `unscaled` comes from make_lattice. O(n), a few operations a vertex.
std::unique_ptr<Lattice> make_scaled_lattice(const Lattice& unscaled, const LatticeScale& scale, int min_tier_bits);

}  // namespace dymsum::planar
