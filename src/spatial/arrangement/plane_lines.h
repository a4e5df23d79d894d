// The lines of one plane: the edges of its facets and the contacts with facets of other planes, each piece between
// neighbouring points once.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "spatial/convolution/stage_watch.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

// Points, each once, whatever it was made from.

class PointTable {
 public:
  explicit PointTable(const SumSpace& space) : space_(space) {}

  /// The ids of points, new ones for those that are not there yet. Exact: found by their names, else by a hash of the
  /// position, compared exactly where sources differ.
  std::vector<PointId> add(std::span<const PointSource> sources, StageWatch& watch);
  /// Adds a point that is none of those there, and that nobody adds again.
  PointId add_other(const PointSource& source) {
    sources_.push_back(source), hash_.push_back(0), approx_.push_back(space_.approximate(source));
    return static_cast<PointId>(sources_.size() - 1);
  }

  std::size_t size() const { return sources_.size(); }
  const PointSource& source(PointId id) const { return sources_[id]; }
  const Approx& approx(PointId id) const { return approx_[id]; }
  exact::Residue hash(PointId id) const { return hash_[id]; }
  const std::vector<PointSource>& sources() const { return sources_; }

 private:
  /// Adds points whose sources are named but once.
  std::vector<PointId> add_named_once(std::span<const PointSource> sources, StageWatch& watch);
  void rehash(std::size_t slots);

  const SumSpace& space_;
  std::vector<PointSource> sources_;
  std::vector<Approx> approx_;
  std::vector<exact::Residue> hash_;
  std::vector<PointId> slots_;  // open addressing by hash, a power of two
};

// The points of one plane: those of the table and those found in the plane, by coordinates within it.

class PlanePoints {
 public:
  PlanePoints(const SumSpace& space, const PointTable& table) : space_(space), table_(table) {}

  void begin(PlaneId plane) {
    const Vec3 n = space_.plane(plane).n;
    const double size[3] = {std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    plane_ = plane;
    axis_ = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    facing_ = (axis_ == 0 ? n.x : axis_ == 1 ? n.y : n.z) > 0 ? 1 : -1;
    found.clear(), found_approx_.clear();
  }
  const SumSpace& space() const { return space_; }
  const PointTable& table() const { return table_; }
  PlaneId plane() const { return plane_; }
  /// Points with ids from here on were found in this plane.
  PointId known() const { return static_cast<PointId>(table_.size()); }

  PointId add(const PointSource& source) { return add(source, space_.approximate(source)); }
  PointId add(const PointSource& source, const Approx& near) {
    found.push_back(source);
    found_approx_.push_back(near);
    return known() + static_cast<PointId>(found.size() - 1);
  }
  const PointSource& source(PointId id) const { return id < known() ? table_.source(id) : found[id - known()]; }
  const Approx& approx(PointId id) const { return id < known() ? table_.approx(id) : found_approx_[id - known()]; }

  /// Coordinates in the plane, counter-clockwise seen against its normal.
  double x(const Approx& a) const { return axis_ == 0 ? a.at.y : axis_ == 1 ? a.at.z : a.at.x; }
  double y(const Approx& a) const { return facing_ * (axis_ == 0 ? a.at.z : axis_ == 1 ? a.at.x : a.at.y); }
  /// The sign of b's coordinate less a's: axis 0 is x, 1 is y.
  int order(PointId a, PointId b, int axis) const {
    if (a == b) return 0;
    const Approx &u = approx(a), &v = approx(b);
    const double gap = axis == 0 ? x(v) - x(u) : y(v) - y(u);
    if (std::abs(gap) > (u.radius + v.radius) * (1 + 0x1p-40) + space_.span() * 0x1p-51) return gap > 0 ? 1 : -1;
    return axis == 0 ? space_.exact_order(source(a), source(b), (axis_ + 1) % 3)
                     : facing_ * space_.exact_order(source(a), source(b), (axis_ + 2) % 3);
  }
  /// Whether doubles show that two positions differ.
  bool apart(const Approx& a, const Approx& b) const {
    const double near = (a.radius + b.radius) * (1 + 0x1p-40) + space_.span() * 0x1p-51;
    const Vec3 gap = b.at - a.at;
    return std::abs(gap.x) > near || std::abs(gap.y) > near || std::abs(gap.z) > near;
  }
  /// The axis along which two different points differ, and by more where doubles decide.
  int long_axis(PointId a, PointId b) const {
    const Approx &u = approx(a), &v = approx(b);
    const int axis = std::abs(x(v) - x(u)) >= std::abs(y(v) - y(u)) ? 0 : 1;
    return order(a, b, axis) != 0 ? axis : 1 - axis;
  }
  /// 1 where the point is to the left of the direction n x n_cut on the line of `cut`, -1 to the right.
  int left_of(PlaneId cut, PointId point) const { return -space_.side(cut, source(point), approx(point)); }
  /// Whether doubles show that a point does not lie on the line of `cut`.
  bool off_line(PlaneId cut, PointId point) const {
    const Plane& p = space_.plane(cut);
    const Approx& at = approx(point);
    return std::abs(dot(p.n, at.at) - p.d) > p.slack + p.norm1 * at.radius;
  }

  std::vector<PointSource> found;

 private:
  const SumSpace& space_;
  const PointTable& table_;
  PlaneId plane_ = 0;
  int axis_ = 2, facing_ = 1;
  std::vector<Approx> found_approx_;
};

/// A straight piece in a plane, from a to b in the direction n x n_cut, n being the plane's normal: a point where a ==
/// b.
struct PlaneSegment {
  PointId a = 0, b = 0;
  PlaneId cut = 0;  ///< a plane through it, across this one
  /// The side of the facet whose edge it is: 1 where it lies to the left of the vector from a to b, seen against n, -1
  /// to the right; 0 for contacts.
  std::int8_t inside = 0;
  std::int8_t side = 1;                   ///< of the facet: TableFacet::side
  EdgeId facet_edge = kNoId;              ///< of the facet, an edge of sums; none for contacts
  bool a_inner = false, b_inner = false;  ///< nothing ends there: other segments of the line go on
};

/// Several edges of sums along one piece.
inline constexpr EdgeId kManyEdges = kNoId - 1;

/// A piece between neighbouring points a < b of a line.
struct LinePiece {
  PointId a = 0, b = 0;
  PlaneId cut = 0;
  bool along = true;            ///< the vector from a to b is n x n_cut
  EdgeId facet_edge = kNoId;    ///< the one edge of sums that runs there, or kManyEdges
  std::array<int, 2> change{};  ///< facets with the plane's normal, and with its opposite: left less right
};

/// Holds its arrays from plane to plane.
class PlaneLines {
 public:
  explicit PlaneLines(PlanePoints& points) : points_(points) {}

  /// Adds crossings to the points. Exact: equal intervals are one, intervals on one line are found by a hash of the
  /// line (among few of them by doubles) and compared exactly, and only whole runs of them are crossed. O(n log n + k)
  /// for n segments and k pairs of runs with overlapping boxes.
  void run(std::span<const PlaneSegment> segments);

  const std::vector<LinePiece>& pieces() const { return pieces_; }
  /// Segments that are points, each point once.
  const std::vector<PlaneSegment>& dots() const { return dots_; }

 private:
  struct Interval {
    PointId a, b;  // a < b
    PlaneId cut;
    bool along;
    int front, back;
    EdgeId facet_edge;
    std::uint32_t line;
    bool a_inner, b_inner;
  };
  /// Intervals of one line that overlap or touch, from end to end.
  struct Run {
    PointId a, b;
    PlaneId cut;
    bool along;
    std::uint32_t first, last;  // of order_
    double low_x, low_y, high_x, high_y;
  };
  struct Break {
    std::uint32_t run;
    PointId at;
  };
  struct Crossing {
    std::uint32_t s, t;
    PointSource at;
  };

  void merge_equal(std::span<const PlaneSegment> segments);
  void merge_sorted();
  void merge_few();
  static void merge(Interval& t, const Interval& s);
  void find_lines();
  void find_few_lines();
  bool on_line(const Interval& line, const Interval& s) const;
  void make_runs();
  void add_run(std::uint32_t first, std::uint32_t last, PointId a, PointId b);
  void split_line(std::uint32_t first, std::uint32_t last);
  void cross_runs();
  void cross(std::uint32_t i, std::uint32_t j);
  void place_dots();
  void place_dot(PointId dot, std::uint32_t run);
  bool name_apart();
  void name_crossings();
  void cut_runs();
  void cut_run(std::uint32_t r, std::span<PointId> points);

  PlanePoints& points_;
  std::vector<Interval> intervals_;
  std::vector<std::uint32_t> order_;  // of intervals by lines, then by runs
  std::vector<Run> runs_;
  std::vector<Break> breaks_;
  std::vector<Crossing> crossings_;
  std::vector<LinePiece> pieces_;
  std::vector<PlaneSegment> dots_;
  // Scratch.
  std::vector<Approx> near_;
  std::vector<PlaneId> cuts_;
  std::vector<exact::Residue> hash_;
  std::vector<PointId> inner_;
  std::vector<std::uint32_t> by_x_, open_;
  std::vector<PointSource> sources_;
  std::vector<std::array<std::uint32_t, 2>> index_;
  std::vector<std::array<std::uint64_t, 4>> steps_;
  std::vector<std::pair<exact::Residue, PointId>> named_;
};

}  // namespace dymsum::spatial
