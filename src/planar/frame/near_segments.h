// The segments of the convolution near a box, found in trees of discs, or among those that were near the last one; and
// the sides of that box.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/doubles.h"
#include "base/memory_budget.h"
#include "dymsum/planar_local_sum.h"
#include "exact/big.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {

// Two operands at exact poses: doubles of one scale for filters, integers of one unit where these do not decide.

using exact::Big;

template <class Number>
struct PointOf {
  Number x, y;
  friend PointOf operator+(const PointOf& a, const PointOf& b) { return {a.x + b.x, a.y + b.y}; }
  friend PointOf operator-(const PointOf& a, const PointOf& b) { return {a.x - b.x, a.y - b.y}; }
};
template <class Number>
Number cross(const PointOf<Number>& a, const PointOf<Number>& b) {
  return a.x * b.y - a.y * b.x;
}
template <class Number>
Number dot(const PointOf<Number>& a, const PointOf<Number>& b) {
  return a.x * b.x + a.y * b.y;
}
using BigPoint = PointOf<Big>;
using PairPoint = PointOf<base::DoublePair>;

inline Point less(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
/// The sign of a x b where it is proved for vectors whose components are off by at most `off`, or 0.
inline int proved_cross(Point a, Point b, double off) {
  const double value = a.x * b.y - a.y * b.x;
  const double error = 2 * off * (std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y) + 2 * off);
  return value > error ? 1 : value < -error ? -1 : 0;
}

/// (x, y) / w, w > 0.
struct BigPosition {
  Big x, y, w;
};
/// The sign of a - b along an axis.
int compare(const BigPosition& a, const BigPosition& b, int axis);
bool same_position(const BigPosition& a, const BigPosition& b);
BigPosition halfway(const BigPosition& a, const BigPosition& b);

/// Integers count multiples of 2^exponent / den.
struct LocalUnit {
  exact::BigInteger den = 1;
  int exponent = 0;
  exact::BigRational value(const Big& n, const Big& w) const;
  double rounded(const Big& n, const Big& w) const;
  RationalPoint point(const BigPosition& position) const;
};

using PosePair = std::array<PlanarPose, 2>;

/// Doubles are scaled by one power of two, so that all sums of vertices are within [-1, 1]; vertices, and sums of two,
/// are off by less than kOff in each coordinate.
class PosedRegions {
 public:
  static constexpr double kOff = 0x1p-46;

  /// `positions` are further points that have to be integers.
  PosedRegions(const Operand& p, const Operand& q, const PosePair& poses, const std::vector<Point>& positions);

  const Operand& operand(std::uint32_t op) const { return *operands_[op]; }
  /// A point of an operand's own coordinates where it stands.
  Point posed(std::uint32_t op, Point v) const {
    const Map& m = map_[op];
    return {m.xx * v.x + m.xy * v.y, m.yx * v.x + m.yy * v.y};
  }
  Point vertex(std::uint32_t op, std::uint32_t walk) const { return posed(op, own(op, walk)); }
  /// What a length of an operand's own coordinates becomes, at most.
  double stretched(std::uint32_t op, double length) const { return length * map_[op].factor * (1 + 0x1p-40) + kOff; }
  double angle(std::uint32_t op) const { return map_[op].angle; }
  /// Scaled, rounded; numbers beyond 2 in magnitude are 2.
  double scaled(double coordinate) const;
  int scale() const { return scale_; }

  const BigPoint& exact(std::uint32_t op, std::uint32_t walk) const;
  BigPoint exact(Point v) const { return {exact_number(v.x), exact_number(v.y)}; }
  Big exact_number(double v) const;
  /// An integer as a fraction of what is more than any coordinate of a sum, in pairs of doubles: off by less than
  /// kPairOff, and so are those of vertices and sums of two.
  static constexpr double kPairOff = 0x1p-98;
  base::DoublePair pair(const Big& n) const;
  const PairPoint& pair(std::uint32_t op, std::uint32_t walk) const;
  const LocalUnit& unit() const { return unit_; }
  /// The position in scaled doubles, rounded.
  Point scaled(const BigPosition& position) const;
  /// The same of pairs: what is at most 1 there errs by three roundings more than it is off, twice.
  Point scaled(const PairPoint& at) const { return {at.x.value() * pair_scale_, at.y.value() * pair_scale_}; }

 private:
  struct Map {
    double xx = 1, xy = 0, yx = 0, yy = 1, factor = 1, angle = 0;  // scaled
    Big exact_xx, exact_xy, exact_yx, exact_yy;
  };
  Point own(std::uint32_t op, std::uint32_t walk) const {
    const Operand& o = *operands_[op];
    return o.points->input[o.source[walk]];
  }
  std::array<const Operand*, 2> operands_;
  std::array<Map, 2> map_;
  LocalUnit unit_;
  int scale_ = 0;
  int top_ = 0;            // all sums are below 2^top_ in units
  double pair_scale_ = 1;  // of pairs: from 2^-top_ units, between 1 and 2
  mutable std::array<std::vector<std::optional<BigPoint>>, 2> exact_;
  mutable std::array<std::vector<std::optional<PairPoint>>, 2> pairs_;
};

/// The factors of the coordinates of an operand before it rotates.
Point factor_of(const PlanarPose& pose);

/// How far vertices of an operand move from one pose to another, at most, and how much it turns; in its units.
struct PoseChange {
  double distance = 0, turn = 0;
};
PoseChange change_of(const Operand& operand, const PlanarPose& from, const PlanarPose& to);

/// Directions from the angle `first` on, counter-clockwise over `width`.
struct DirectionRange {
  double first = 0, width = 0;
};
/// Whether they have a direction in common, once the first one is turned by `turn`, or nearly, within `slack`.
bool may_meet(const DirectionRange& a, double turn, const DirectionRange& b, double slack);

/// Edges or convex vertices of an operand in a tree of discs, with the directions that their segments can have. It is
/// made once: where the operand rotates and scales, discs move along, and directions unless scales of x and y change
/// ratio.
class FeatureDiscs {
 public:
  enum class Of : std::uint8_t {
    edges,     ///< all edges of parts with area: their direction
    vertices,  ///< convex ones: the directions that turn from the edge before to the one after
  };
  struct Node {
    Point centre;       ///< of a disc that holds the features
    double radius = 0;  ///< a little more
    DirectionRange directions;
    std::uint32_t first = 0, last = 0;  ///< items
    std::uint32_t left = 0, right = 0;  ///< nodes; 0, 0: a leaf
    bool leaf() const { return right == 0; }
  };
  /// `factors`: what coordinates are multiplied by before directions are taken.
  FeatureDiscs(const Operand& operand, Of of, Point factors = {1, 1});

  bool empty() const { return nodes_.empty(); }
  const Node& node(std::uint32_t k) const { return nodes_[k]; }
  /// Walk edges or walk vertices.
  std::uint32_t item(std::uint32_t k) const { return items_[k]; }
  const DirectionRange& directions(std::uint32_t item) const { return ranges_[item]; }

 private:
  std::uint32_t build(std::uint32_t first, std::uint32_t last);
  Node leaf_of(std::uint32_t item) const;
  Point at(std::uint32_t walk) const { return operand_.points->input[operand_.source[walk]]; }
  double angle_of(std::uint32_t edge) const;
  DirectionRange range_of(std::uint32_t item) const;

  const Operand& operand_;
  Of of_;
  Point factors_;
  std::vector<std::uint32_t> items_;
  std::vector<DirectionRange> ranges_;  // by walk edge or vertex
  std::vector<Node> nodes_;
};

/// A box in scaled doubles.
struct ScaledBox {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

class NearSegments {
 public:
  /// The search serves poses with these scales; others of the same ratio do, too.
  NearSegments(const Operand& p, const Operand& q, const std::array<Point, 2>& factors);

  /// A superset of the segments of the reduced convolution that meet the box: edges and convex vertices whose
  /// directions meet, or nearly, as doubles decide.
  base::CountedArray<WalkSegment> find(const PosedRegions& posed, const ScaledBox& box);
  /// The same among the pairs that were near the last box, kept with a margin; these are found anew where operands and
  /// box have moved further than that since.
  base::CountedArray<WalkSegment> update(const PosedRegions& posed, const PosePair& poses, const ScaledBox& box);
  /// All of them, whatever the box.
  base::CountedArray<WalkSegment> all(const PosedRegions& posed) const;

  bool rebuilt() const { return rebuilt_; }  ///< by the last call
  std::uint64_t pairs() const { return pairs_; }

 private:
  struct Wanted {
    ScaledBox box;
    double turn = 0;  ///< directions may differ by so much
  };
  base::CountedArray<WalkSegment> search(const PosedRegions& posed, const Wanted& wanted);
  void search_side(const PosedRegions& posed, const Wanted& wanted, std::uint32_t side,
                   base::CountedArray<WalkSegment>& found);
  bool is_near(const PosedRegions& posed, const WalkSegment& s, const Wanted& wanted) const;
  bool still_holds(const PosedRegions& posed, const PosePair& poses, const ScaledBox& box);

  std::array<const Operand*, 2> operands_;
  std::array<FeatureDiscs, 2> edges_, vertices_;
  bool rebuilt_ = false;
  std::uint64_t pairs_ = 0;

  struct Kept {
    base::CountedArray<WalkSegment> segments;
    PosePair poses;
    ScaledBox box;  ///< with its margin
    double turn = 0;
    int scale = 0;
    std::uint64_t calls = 0;  ///< since it was made, and how far operands have moved
    double moved = 0;
  };
  std::optional<Kept> kept_;
};

/// A line x = value or y = value. Beyond all sums it cuts nothing.
struct LocalWall {
  int axis = 0;
  double value = 0;   ///< in input coordinates
  double scaled = 0;  ///< rounded
  bool beyond = false;
  BigPosition exact;      ///< its coordinate, for both axes
  base::DoublePair pair;  ///< the same
};

/// The sides of the box that a sum is cut to, and of a larger one, in which everything near it is known.
class LocalWalls {
 public:
  LocalWalls(const PosedRegions& posed, const PlanarBox& box, const PlanarBox& reach);

  const std::array<LocalWall, 8>& all() const { return walls_; }  ///< low x, high x, low y, high y; the larger box's
  /// The larger box, in scaled doubles.
  ScaledBox reach() const { return {walls_[4].scaled, walls_[6].scaled, walls_[5].scaled, walls_[7].scaled}; }

 private:
  std::array<LocalWall, 8> walls_;
};

/// A box about the box: a 32nd larger, or by more than doubles err in what is found with them.
PlanarBox larger_box(const PlanarBox& box, double extent);

}  // namespace dymsum::planar
