// The lines of one plane: the edges of its facets and the contacts with facets of other planes, each piece between
// neighbouring points once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "spatial/arrangement/plane_points.h"

namespace dymsum::spatial {

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
