// The boundary of the slice while the angle grows, changed at events only. Near a generic event the change follows from
// the few segments that meet there; where more coincides, a whole slice on the far side of the event is computed and
// compared. What changes is planned by the stages (event_plan.h, slice_difference.h, tight_events.h); the sweep puts
// events into their exact order, and applies the plans.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "cspace/obstacle/event_plan.h"
#include "cspace/obstacle/near_slice.h"
#include "cspace/obstacle/obstacle_export.h"
#include "cspace/obstacle/slice_reader.h"
#include "cspace/obstacle/tight_events.h"

namespace dymsum::planar {

class ObstacleSweep {
 public:
  /// `reference`: a whole slice at every event, and every angle is listed. `again` is called now and then: it throws to
  /// stop.
  ObstacleSweep(const TurningForms& forms, const RotationCatalog& catalog, std::shared_ptr<const OperandPair> base,
                bool reference, const std::function<void()>& again);

  /// Slices near events, where the pair has them: in the place of whole ones.
  void use(PlanarLocalSum sum) { near_slices_.emplace(std::move(sum), reader_); }
  /// The boundary after the beginning of the first window, before its first event.
  void start(const RotationRange& range, RotationEvents& found, const OverlapFilter& filter);
  /// Passes the events of a window. `at_end`: its end, where that is a crowded quarter turn; then none of the events is
  /// there.
  void pass(const RotationRange& range, RotationEvents found, const OverlapFilter& filter,
            const std::optional<CrowdedEnd>& at_end);
  /// Joins the end of the turn to its start. Throws std::logic_error if they differ.
  void close(const OverlapFilter& filter);

  /// What was found so far.
  const SweptBoundary& found() const { return swept_; }
  ObstacleWork& work() { return swept_.work; }

 private:
  // An orientation after the group and before the next event, by so many radians at most.
  using After = std::function<Orientation(double)>;
  using Group = EventGroup;
  // An orientation between two angles of a range; without events its ends.
  Orientation sample(const RotationRange& range, RotationEvent* from, RotationEvent* to,
                     double within = INFINITY) const;
  RotationEvent* first_event(const RotationRange& range, base::CountedArray<RotationEvent>& events) const;
  int compare(RotationEvent& a, RotationEvent& b, const RotationRange& range) const;
  bool at_end_of(const RotationRange& range, RotationEvent& event) const;
  void pass_run(Group& run, Group* following, const RotationRange& range, const OverlapFilter& filter);
  void pass_pending(const After& after, const OverlapFilter& filter);
  void pass_group(const Group& group, const RotationRange& range, const After& after, const OverlapFilter& filter);
  bool matters(const Group& run, const OverlapFilter& filter) const;
  void change(const Group& group, const RotationRange& range, const After& after, const OverlapFilter& filter);
  void settle(RotationEvent& event, EventPlan plan, const RotationRange& range, const After& after);
  bool take_near_slices(std::vector<Group> due, Group& alone, const Group& group, const RotationRange& range,
                        const After& after);
  void take_slice(const Group& group, const RotationRange& range, const After& after);
  SliceEdit edit_to(const std::vector<SliceLoop>& loops) const;
  void join_faces(const Orientation& at);
  void examine(const RotationRange& range, const OverlapFilter& filter,
               const std::vector<AlwaysConcurrent>& curves_after);
  std::optional<Point> look_at_limits();
  std::vector<std::uint32_t> nodes_near() const;
  void unlist_angle(std::size_t tight_before);
  SweepScene scene() const { return {forms_, catalog_, swept_.graph}; }
  void list_angle(const RotationRange& range, RotationEvent& event);
  void note(Heading h, ObstacleEvent::Kind kind, Point at);
  TightFeature tight_feature(const TightCandidate& from, const TightCandidate& to) const;
  void note_first(const Group& group);
  double position_error() const;
  Point position(Heading h, Point at) const;

  const TurningForms& forms_;
  const RotationCatalog& catalog_;
  const std::function<void()>& again_;
  SliceReader reader_;
  bool reference_;
  SweptBoundary swept_;
  Orientation begin_;    // where the turn was begun
  bool turned_ = false;  // the last window is passed
  std::optional<NearSlices> near_slices_;

  // What is known at the angle of the group:
  AngleNow now_;
  bool sliced_ = false;  // a whole slice told what changed
  // Unless a whole one did: nodes of before that are in the boxes of slices near events.
  std::vector<std::uint32_t> near_nodes_;
  std::uint32_t first_node_ = 0;  // of those that begin at the angle
  Group doubtful_;                // events that may be positions of tight contacts, or of nothing at all

  // The threes of the window, and the tight ones among them after the last group and after the start; sorted.
  std::vector<AlwaysConcurrent> always_, curves_, begin_curves_;

  // What waits at the very end of the last window. One event of a crowded quarter turn stands for many, so that a whole
  // slice is due.
  std::vector<RotationEvent> pending_;
  std::optional<CrowdedEnd> crowded_;
  RotationRange pending_range_;
};

}  // namespace dymsum::planar
