// Static slices in the sweep's terms: contacts as segments, loops, which loops of free space belong together, and
// what lies on one line before and after.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "cspace/boundary/boundary_graph.h"
#include "cspace/obstacle/event_plan.h"
#include "dymsum/orientation.h"

namespace dymsum::planar {

class SliceReader {
 public:
  SliceReader(const TurningForms& forms, std::shared_ptr<const OperandPair> base);

  const OperandPair& base() const { return *base_; }
  /// The boundary, without tight features. A loop is `outer` only where each operand is of one part.
  std::vector<SliceLoop> loops(const Orientation& at) const;
  PlanarSum slice(const Orientation& at, Semantics semantics) const;
  WalkSegment segment(const Contact& c) const;
  std::uint32_t index(const Contact& c) const { return index_.of(segment(c)); }
  Pair corner(const SumVertex& v) const { return {walk_vertex_[0][v.corner_p], walk_vertex_[1][v.corner_q]}; }

  /// Sums of several parts: what lies in a hole, or outside of everything, has several loops.
  struct Faces {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> same;  ///< cells of one face
    std::vector<std::uint32_t> unbounded;                       ///< cells of the outer face
  };
  /// Requires that the graph is the boundary at the orientation.
  Faces faces(const Orientation& at, const BoundaryGraph& graph) const;
  /// Whether the face on the right of a new loop of crossing segments is free, exactly.
  bool is_free(const std::vector<WalkSegment>& loop, const Orientation& at) const;

 private:
  std::vector<std::uint32_t> segments(const SumRing& ring) const;
  std::uint32_t cell_at(const SumRing& ring, const BoundaryGraph& graph) const;

  const TurningForms& forms_;
  std::shared_ptr<const OperandPair> base_;
  SegmentIndex index_;
  std::array<std::vector<std::uint32_t>, 2> walk_vertex_, walk_edge_;  // by index in the region
};

// Sub-edges that come onto one line at an angle: what goes on along a line after the angle, and passages that are shut
// at the angle only. Exact at that angle, which is algebraic.

class SharedLines {
 public:
  /// `before`: the boundary before the angle.
  SharedLines(const TurningForms& forms, const AngleNow& now, std::vector<SubEdge> before);

  /// All pairs, by index, of a sub-edge that ended and a new one that have an interval of a line in common at the
  /// angle.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> continued(const std::vector<SubEdge>& ended,
                                                                 const std::vector<SubEdge>& fresh) const;
  /// Whether nothing of the interval that sub-edges of one line share borders on a face at the angle: it has no length,
  /// or walls of the other direction cover it, from before the angle. (What is covered from before is covered at the
  /// angle, hence from after.) Both walls of a passage come onto one line there, or a loop shrinks to a point, and
  /// they part again. Touching is no connection: what lies before that angle and what lies after it are two.
  bool shut(std::span<const SubEdge> edges) const;

 private:
  /// An interval in fractions of the length of a line's segment, from its start, in doubles.
  struct Interval {
    double from = 0, to = 0, error = 0;
    auto operator<=>(const Interval&) const = default;
  };
  using ByOffset = std::vector<std::pair<double, std::uint32_t>>;
  double offset(const SubEdge& e) const;
  ByOffset by_offset(const std::vector<SubEdge>& edges) const;
  template <class F>
  void for_each_near(const ByOffset& lines, double offset, F&& f) const;
  bool have_common_interval(const SubEdge& n, const SubEdge& m) const;
  bool collinear(const WalkSegment& s, const WalkSegment& t) const;
  double cosine(const WalkSegment& s, const WalkSegment& t) const;
  Interval interval_on(const WalkSegment& line, const SubEdge& e) const;
  std::vector<SubEdge> opposite_walls(const SubEdge& e) const;
  bool covered_exactly(std::span<const SubEdge> edges, const std::vector<SubEdge>& walls) const;

  const TurningForms& forms_;
  const AngleNow& now_;
  Heading heading_;
  std::vector<SubEdge> before_;
  ByOffset lines_before_;
};

/// Matches in a slice's edit what ends and what begins, where they go on along one line, or touch in a passage that is
/// shut.
void match_along_lines(const BoundaryGraph& graph, const SharedLines& lines, SliceEdit& edit);

}  // namespace dymsum::planar
