// The space in which the boundary of P (+) Q is looked for: sums of vertices, planes through them, and the points where
// such planes meet. Planes and points are what they were made from, never rounded coordinates; every question is the
// sign of an integer expression whose width is proved by its type. Beside each plane and point stand doubles with a
// bound of their error: they answer most questions.
//
// Every axis has a grid of its own, and doubles that are as large as those along the other axes: a single 6e-17 among
// the coordinates along one makes its grid 2^54 times as fine as the others', and doubles in units of the grids would
// then say nothing about the coarser axes. Signs do not change when an axis is scaled.
//
// Widths for coordinates |X| <= 2^B of either operand on the common grid:
//   sum p + q, edge            B + 1        normal u x v               2B + 3
//   offset n . (p + q)        3B + 6        side of a sum              3B + 7
//   edge meets plane: X, W    4B + 10, 3B + 6          its side of another plane      6B + 16
//   three planes: X, W        7B + 15, 6B + 12         its side of a fourth           9B + 21
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/mesh.h"
#include "exact/algebraic_root.h"
#include "exact/big.h"
#include "exact/fraction.h"
#include "exact/orient.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {

using PlaneId = std::uint32_t;
using PointId = std::uint32_t;
using EdgeId = std::uint32_t;

/// The most bits of coordinates on their common grid. Doubles of any sizes have 2,099.
inline constexpr int kMostGridBits = 8192;
inline constexpr std::uint32_t kNoId = 0xffffffff;

/// Vertex p of P plus vertex q of Q.
struct SumPoint {
  std::uint32_t p = 0, q = 0;
  friend auto operator<=>(const SumPoint&, const SumPoint&) = default;
};

/// An edge of one operand plus a vertex of the other: `from` and `to` differ in p or in q alone.
struct SumEdge {
  SumPoint from, to;
  friend auto operator<=>(const SumEdge&, const SumEdge&) = default;
};

/// A direction: from one vertex of an operand to another, or a coordinate axis.
struct DirectionSource {
  enum class Of : std::uint8_t { p, q, axis } of = Of::p;
  std::uint32_t from = 0, to = 0;  ///< vertices; for an axis `from` is 0, 1 or 2
};

/// The plane through a sum, spanned by two directions: its normal is u x v, or v x u where reversed.
struct PlaneSource {
  SumPoint at;
  DirectionSource u, v;
  bool reversed = false;
};

/// A plane n . x = d in the space's doubles, scaled by a power of two so that the largest component of n is in [1/2,
/// 1). For every x with coordinates within the space, n . x - d is within `slack` of the exact value (scaled alike).
struct Plane {
  Vec3 n;
  double d = 0, slack = 0;
  double norm1 = 0;  ///< |n.x| + |n.y| + |n.z|, rounded up
};

/// A point: a sum, an edge of sums where it crosses a plane, or three planes; or a position that need not have to do
/// with the operands, about which a flag's side and approximations can be asked.
struct PointSource {
  enum class Kind : std::uint8_t { sum, edge, planes, position } kind = Kind::sum;
  std::uint32_t a = 0, b = 0, c = 0;  ///< p, q; edge, plane; three planes in ascending order; what add_position gave
  friend auto operator<=>(const PointSource&, const PointSource&) = default;
};

/// A point, and from there infinitesimal steps, each infinitely smaller than the one before: along n x n_cut (times
/// `direction`), to the left of that in the plane, and off the plane along n (times `side`). A `direction` or `side` of
/// 0 takes no such steps.
struct Flag {
  PointSource at;
  PlaneId plane = 0, cut = 0;
  std::int8_t direction = 0, left = 0, side = 0;
};

/// Doubles within `radius` of each coordinate of a point.
struct Approx {
  Vec3 at;
  double radius = 0;
};

class SumSpace {
 public:
  virtual ~SumSpace() = default;

  /// All coordinates of sums, in the space's doubles, are within [-span, span].
  double span() const { return span_; }
  const std::vector<Plane>& planes() const { return planes_; }
  const Plane& plane(PlaneId id) const { return planes_[id]; }
  const std::vector<SumEdge>& edges() const { return edges_; }
  Vec3 approx(SumPoint s) const { return p_[s.p] + q_[s.q]; }
  double sum_radius() const { return sum_radius_; }
  /// Coordinates of the operands in the space's doubles, within sum_radius() together.
  const std::vector<Vec3>& p() const { return p_; }
  const std::vector<Vec3>& q() const { return q_; }

  /// Adds planes; returns the id of the first one. Requires that u and v are not parallel.
  virtual PlaneId add_planes(std::span<const PlaneSource> sources, int threads = 1) = 0;
  /// Adds edges; returns the id of the first one.
  EdgeId add_edges(std::span<const SumEdge> edges);

  // Exact signs. None uses doubles.
  virtual int exact_side(PlaneId plane, SumPoint point) const = 0;
  virtual int exact_side(PlaneId plane, const PointSource& point) const = 0;
  /// The sign of det(a.to - a.from, b.to - b.from, b.from - a.from).
  virtual int exact_twist(const SumEdge& a, const SumEdge& b) const = 0;
  /// The sign of n . (to - from).
  virtual int exact_rise(PlaneId plane, const SumEdge& edge) const = 0;
  /// The sign of det(n_a, n_b, n_c).
  virtual int exact_det(PlaneId a, PlaneId b, PlaneId c) const = 0;
  /// The sign of the component of n_a x n_b.
  virtual int exact_cross(PlaneId a, PlaneId b, int axis) const = 0;
  /// The sign of n_a . n_b.
  virtual int exact_dot(PlaneId a, PlaneId b) const = 0;
  virtual int exact_normal(PlaneId plane, int axis) const = 0;
  /// 1 or -1 for the same plane with the same or the opposite normal, else 0.
  virtual int same_plane(PlaneId a, PlaneId b) const = 0;
  virtual bool same_point(const PointSource& a, const PointSource& b) const = 0;
  /// The sign of b's coordinate less a's.
  virtual int exact_order(const PointSource& a, const PointSource& b, int axis) const = 0;
  /// The sign of det(u, v, w).
  virtual int exact_det(DirectionSource u, DirectionSource v, DirectionSource w) const = 0;
  /// The sign of (u x v) . (w x x).
  virtual int exact_dot(DirectionSource u, DirectionSource v, DirectionSource w, DirectionSource x) const = 0;
  virtual int exact_leading(DirectionSource w) const = 0;
  /// The sign of r . ((u x v) x (w x x)).
  virtual int exact_turn(DirectionSource r, DirectionSource u, DirectionSource v, DirectionSource w,
                         DirectionSource x) const = 0;
  /// The side of a plane on which a flag lies. The plane does not have to be one of the space's.
  virtual int exact_side(const PlaneSource& plane, const Flag& flag) const = 0;
  /// The sign of the component of a plane's normal.
  virtual int exact_normal(const PlaneSource& plane, int axis) const = 0;

  /// Whether a plane was made from a sum, or from both ends of an edge: then it lies in the plane. A "no" says nothing.
  bool made_from(PlaneId plane, SumPoint point) const;
  bool made_from(PlaneId plane, EdgeId edge) const {
    return made_from(plane, edges_[edge].from) && made_from(plane, edges_[edge].to);
  }

  /// Signs, by doubles where they decide.
  int side(PlaneId plane, SumPoint point) const;
  int side(PlaneId plane, const PointSource& point, const Approx& approx) const;
  int det(PlaneId a, PlaneId b, PlaneId c) const;
  int det(DirectionSource u, DirectionSource v, DirectionSource w) const;
  /// Whether no rounding took place in a determinant of three vectors with these sums of sizes, computed in doubles
  /// from integers.
  bool computed_exactly(double u, double v, double w) const { return sum_radius_ == 0 && u * v * w < 0x1p50; }

  /// Doubles for a point; the radius is at most 2^-30 of the span.
  Approx approximate(const PointSource& point) const;
  /// Coordinates to within a few units in their last places.
  virtual Approx exact_approximation(const PointSource& point) const = 0;
  /// The same value for all sources of one point, different ones for nearly all others.
  std::vector<exact::Residue> point_hashes(std::span<const PointSource> points) const;
  /// The same for planes, whatever the side of their normals.
  std::vector<exact::Residue> plane_hashes(PlaneId first, std::size_t count) const;
  /// The same value for all `cuts` that meet a plane in one line; 0 for what may meet it in any line.
  void line_hashes(PlaneId plane, std::span<const PlaneId> cuts, std::vector<exact::Residue>& hashes) const;

  /// The grid along an axis: a coordinate X of P stands for X 2^exponent + p_offset. The space's doubles are multiples
  /// of 2^unit instead, where `unit` is at most `exponent`.
  struct Line {
    int exponent = 0;
    double p_offset = 0, q_offset = 0;
    int unit = 0;
  };
  Line line(int axis) const { return lines_[axis]; }
  /// The coordinate of a point as the operands' own numbers would have it.
  exact::BigRational world_coordinate(const PointSource& point, int axis) const;

  virtual int bits() const = 0;
  virtual exact::BigRational exact_coordinate(const PointSource& point, int axis) const = 0;
  /// x, y, z and w > 0: the position on the grid is (x, y, z) / w, not in lowest terms.
  virtual std::array<exact::BigInteger, 4> homogeneous(const PointSource& point) const = 0;
  /// Adds a position by the operands' own numbers, of any size; nothing where no sum is: beyond `span` along an axis.
  virtual std::optional<PointSource> add_position(const std::array<exact::BigRational, 3>& world) = 0;
  /// Signs that doubles left open; those that doubles determined are not counted. Of values at roots `integers` are
  /// those of fixed point; so of fractions.
  exact::RungCounts signs() const {
    return {0, decided_[0].load(std::memory_order_relaxed), decided_[1].load(std::memory_order_relaxed),
            decided_[2].load(std::memory_order_relaxed)};
  }

 protected:
  Vec3 approx(DirectionSource w) const;
  struct PlaneResidue {
    exact::Residue n[3], d;
  };
  PlaneResidue residue_of(const PlaneSource& source) const;

  std::vector<Vec3> p_, q_;
  std::vector<std::array<exact::Residue, 3>> p_residue_, q_residue_;
  std::vector<Plane> planes_;
  std::vector<PlaneSource> plane_sources_;
  std::vector<PlaneResidue> plane_residues_;
  std::vector<SumEdge> edges_;
  Line lines_[3];
  double span_ = 0, sum_radius_ = 0;

  void count(exact::Rung rung) const {
    decided_[static_cast<std::size_t>(rung) - 1].fetch_add(1, std::memory_order_relaxed);
  }

 private:
  mutable std::array<std::atomic<std::uint64_t>, 3> decided_{};  // double_pairs, integers, big
  exact::Residue hash_of_zero_weight(const PointSource& point) const;
};

/// The space of the sums of two lists of points, on their common grid (for every axis by itself). Requires finite
/// coordinates, and at most kMostGridBits bits: those of any doubles, and of doubles under exact poses.
std::unique_ptr<SumSpace> make_sum_space(const std::vector<Point3>& p, const std::vector<Point3>& q);

/// Positions of a grid under a linear map: x -> matrix x, row by row; and further ones behind them, which are not
/// mapped.
struct MappedPositions {
  const GridPositions& positions;
  std::array<exact::BigInteger, 9> matrix;
  std::vector<exact::Vector3<exact::Big>> further = {};
};
/// The space of the sums of mapped positions, in units of 2^exponent. Requires at most kMostGridBits bits.
std::unique_ptr<SumSpace> make_sum_space(const MappedPositions& p, const MappedPositions& q, int exponent);

/// The space of the sums of fractions, in units of 2^exponent.
std::unique_ptr<SumSpace> make_sum_space(const std::vector<exact::Vector3<exact::Fraction>>& p,
                                         const std::vector<exact::Vector3<exact::Fraction>>& q, int exponent);

/// The space of sums of positions that are values at one root of a polynomial, for collision tests there: signs are
/// exact, hashes say nothing, and coordinates are no integers. Requires values below 2^bits, bits at most 140.
std::unique_ptr<SumSpace> make_root_space(std::vector<exact::Vector3<exact::RootValue>> p,
                                          std::vector<exact::Vector3<exact::RootValue>> q, int bits);

}  // namespace dymsum::spatial
