// The slice after an angle near some events only, in the place of a whole one: chains of the boundary in a box, and
// what lies between the boundary before the angle and these.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cspace/boundary/boundary_graph.h"
#include "cspace/obstacle/event_plan.h"
#include "cspace/obstacle/slice_reader.h"
#include "dymsum/planar_local_sum.h"

namespace dymsum::planar {

/// A piece of the boundary in a box: its segments by index, in order. One that is not closed comes in through a side of
/// the box at `from` and leaves through one at `to`.
struct BoundaryChain {
  std::vector<std::uint32_t> segments;
  Point from, to;
  bool closed = false;
};

/// Slices cut to boxes, in the sum's coordinates.
class NearSlices {
 public:
  NearSlices(PlanarLocalSum sum, const SliceReader& reader) : sum_(std::move(sum)), reader_(reader) {}
  /// Box and chains as `frame` turns them. Nothing where chains meet in the box, or the slice cannot be cut.
  std::optional<std::vector<BoundaryChain>> in(const PlanarBox& box, const Orientation& frame, const Orientation& at);

 private:
  PlanarLocalSum sum_;
  const SliceReader& reader_;
};

/// Axes for boxes, turned so that what is long runs along one of them: of a strip that is aslant the box would hold
/// most of the boundary.
struct BoxFrame {
  Orientation turn;  ///< from the forms' coordinates to the frame's
  Heading h;         ///< its double
  Point of(Point p) const { return {h.c * p.x - h.s * p.y, h.s * p.x + h.c * p.y}; }
  Point back(Point p) const { return {h.c * p.x + h.s * p.y, h.c * p.y - h.s * p.x}; }
};

/// A box in the forms' doubles, along the axes of a frame.
struct FormsBox {
  Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  void add(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  void add(const FormsBox& b) { add(b.low), add(b.high); }
  void grow(double by) {
    low = {low.x - by, low.y - by};
    high = {high.x + by, high.y + by};
  }
  bool meets(const FormsBox& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y;
  }
};
/// How far after its events a slice that is cut to their box may be, in radians; less where lines cross at a small
/// sine.
inline constexpr double kNearTurn = 0x1p-26;
/// Points of a cut slice and ends of sub-edges near it err by less than this fraction of the span, or are not
/// distinguished.
inline constexpr double kCutNear = 0x1p-28;

/// Events at one angle that change the boundary in a box, and the boundary there after the angle.
struct NearChange {
  EventGroup events;
  FormsBox box;
  double turn = kNearTurn;            ///< so far after the angle what changes there is in the box
  std::vector<BoundaryChain> chains;  ///< in the forms' doubles, not turned
};
struct NearChanges {
  BoxFrame frame;
  std::vector<NearChange> all;
};
/// Parts of a group that are `due`, and events of it that would be handled by themselves: with boxes that are apart.
/// Parts whose boxes meet are one, and an event whose box meets one of them belongs to it: the others are left. Nothing
/// where a position is not known.
std::optional<NearChanges> boxes_of(std::vector<EventGroup> due, EventGroup& alone, const SweepScene& scene,
                                    const SignsAt& signs);
/// What makes of the boundary before an angle the chains in the box. Requires: there the boundary changes in the box
/// only; h is that of the chains. Nodes stay and go on as with a whole slice. Nothing where doubles do not determine
/// which of several nodes of one segment passes a side of the box.
std::optional<SliceEdit> edit_near(const SweepScene& scene, const AngleNow& now, Heading h, const BoxFrame& frame,
                                   const NearChange& change);

}  // namespace dymsum::planar
