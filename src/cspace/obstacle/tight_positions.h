// Positions at an exact angle, and which visible sub-edges come to them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cspace/events/rotation_events.h"
#include "cspace/obstacle/sweep_scene.h"

namespace dymsum::planar {

/// A position that may be free, and segments whose lines go through it.
struct TightCandidate {
  ExactPosition position;
  Point near;  ///< in the forms' doubles
  std::vector<std::uint32_t> through;
  bool visible = false;  ///< sub-edges before or after the angle come to it
  bool goes_through(std::uint32_t segment) const {
    return std::find(through.begin(), through.end(), segment) != through.end();
  }
};

/// A sub-edge before or after the angle: where it begins and ends at the angle, as d . (x - start) of its segment, in
/// doubles.
struct NodeNow {
  std::uint32_t node = 0;
  double from = 0, to = 0, error = 0;  ///< of the difference to `along_near` of a position
};

/// Exact answers; doubles where they tell.
class PositionsAtAngle {
 public:
  PositionsAtAngle(const SweepScene& scene, const SignsAt& signs)
      : forms_(scene.forms),
        catalog_(scene.catalog),
        graph_(scene.graph),
        segments_(scene.graph.segments()),
        signs_(signs) {}

  bool same_position(const TightCandidate& y, const TightCandidate& z) const;
  std::vector<TightCandidate> each_once(std::vector<TightCandidate> all) const;
  /// Neighbouring positions, by index, along two segments of opposite directions that exist at the angle near theta: of
  /// the two sides of a polyline with one vertex mostly one does.
  std::vector<std::array<std::uint32_t, 2>> opposite_intervals(const std::vector<TightCandidate>& positions,
                                                               double theta) const;
  /// The boundary after the angle, or before and after it.
  std::vector<NodeNow> nodes_now(bool before) const;
  /// Whether a sub-edge comes to z at the angle.
  bool reaches(const NodeNow& n, const TightCandidate& z) const;
  /// Ends of a part of an interval from y to z; nothing for y and for z.
  using PartEnds = std::array<std::optional<Point>, 2>;
  /// The parts of the interval from y to z that no sub-edges come to.
  std::vector<PartEnds> not_reached(const std::vector<NodeNow>& nodes, const TightCandidate& y,
                                    const TightCandidate& z) const;
  /// The position that three concurrent segments have in common, if they do.
  std::optional<TightCandidate> meeting_of(const AlwaysConcurrent& three) const;
  std::vector<TightCandidate> positions_of(const std::vector<AlwaysConcurrent>& curves) const;

 private:
  int order_of_end(const NodeNow& n, const TightCandidate& z, bool at_end) const;
  bool on_line(const NodeNow& n, const TightCandidate& z) const;
  /// The position at which a sub-edge comes to a line, on which it is, at the angle: exact positions along that.
  std::array<Fraction, 2> limit_along(const WalkSegment& line, std::uint32_t node) const;
  Point point_on(const WalkSegment& line, const Fraction& along) const;

  const TurningForms& forms_;
  const RotationCatalog& catalog_;
  const BoundaryGraph& graph_;
  const SegmentIndex& segments_;
  const SignsAt& signs_;
};

}  // namespace dymsum::planar
