// An open set of the plane by its boundary: the positions at which the interiors of two parts overlap, or those at
// which a part does not lie in its container.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "dymsum/planar_sum.h"
#include "exact/big.h"
#include "exact/interval.h"

namespace dymsum::placement {

using exact::BigInteger;
using exact::HomogeneousPoint;
using exact::Interval;

inline constexpr std::uint32_t kNone = 0xffffffff;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Intervals that hold the coordinates of a position.
struct NearPoint {
  Interval x, y;
};
/// The intervals between the doubles beside the nearest ones; points where the position is a double.
NearPoint near_point(const HomogeneousPoint& p);

/// A x + B y + C, positive on the left of a directed line.
struct Line {
  BigInteger a, b, c;
};
Line line_through(const HomogeneousPoint& from, const HomogeneousPoint& to);

/// A directed segment of the boundary.
struct BoundaryEdge {
  enum class Kind : std::uint8_t {
    ring,   ///< the set lies on the left alone
    crack,  ///< the set lies on both sides; the segment does not belong to it
    point,  ///< from == to: a point that does not belong to the set which lies all around it
  };
  std::uint32_t from = 0, to = 0;
  Kind kind = Kind::ring;
  Interval dx, dy;
  int axis = 0, sign = 0;  ///< a coordinate that changes along it, 0 or 1, and the sign of the change; exact
};

class OpenSet {
 public:
  /// The open sum: the interior of the parts of a no-fit polygon without its tight features.
  static std::shared_ptr<const OpenSet> inside(const PlanarSum& no_fit);
  /// What lies outside the closed set of an inner fit.
  static std::shared_ptr<const OpenSet> outside(const PlanarSum& inner_fit);
  /// A position alone, to be looked for in others.
  static std::shared_ptr<const OpenSet> position(HomogeneousPoint at);

  const std::vector<HomogeneousPoint>& at() const { return at_; }
  const std::vector<NearPoint>& near() const { return near_; }
  /// Ring by ring, then cracks, then points. Where a vertex of the boundary lies on an edge, the edge is cut there.
  const std::vector<BoundaryEdge>& edges() const { return edges_; }
  const Line& line(std::uint32_t edge) const { return lines_[edge]; }
  /// Whether all but a bounded part of the plane lies in it.
  bool unbounded() const { return unbounded_; }
  const std::array<double, 4>& box() const { return box_; }  ///< of the boundary, from outside

  /// Calls f(edge) once for each edge that may reach heights in [low, high].
  template <class F>
  void for_each_between(double low, double high, F&& f) const {
    if (first_.empty() || high < box_[1] || low > box_[3]) return;
    const std::size_t begin = row(low), end = row(high);
    for (std::size_t r = begin; r <= end; ++r)
      for (std::uint32_t k = first_[r]; k < first_[r + 1]; ++k) {
        const std::uint32_t e = listed_[k];
        if (r == begin || row(low_of(e)) == r) f(e);
      }
  }

 private:
  std::uint32_t add(HomogeneousPoint p);
  void add_rings(const PlanarSum& sum, bool reversed);
  void add_segments(const std::vector<SumSegment>& segments, const PlanarSum& sum);
  void add_points(const std::vector<SumVertex>& points, const PlanarSum& sum);
  void add_edge(std::uint32_t from, std::uint32_t to, BoundaryEdge::Kind kind);
  /// What is kept of all edges: directions, lines, rows.
  void finish();
  /// Cuts edges at vertices inside them.
  void cut_edges();
  /// The order of two vertices on the line of an edge, along it.
  int order_along(const BoundaryEdge& edge, std::uint32_t i, std::uint32_t j) const;
  /// Whether a vertex lies on an edge, not at its ends.
  bool lies_inside(std::uint32_t vertex, const BoundaryEdge& edge) const;
  void measure(BoundaryEdge& edge) const;
  void list_rows();
  double low_of(std::uint32_t e) const;
  double high_of(std::uint32_t e) const;
  std::size_t row(double y) const;

  std::vector<HomogeneousPoint> at_;
  std::vector<NearPoint> near_;
  std::vector<BoundaryEdge> edges_;
  std::vector<Line> lines_;
  bool unbounded_ = false;
  std::array<double, 4> box_{};
  std::vector<std::uint32_t> first_, listed_;
  double per_row_ = 0;
};

}  // namespace dymsum::placement
