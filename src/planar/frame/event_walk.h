// The walk through all events of a scaling pair, with the sum between each two.
#pragma once

#include <memory>

#include "dymsum/scaling_sum.h"
#include "planar/frame/scaling_sum.h"
#include "planar/window/window_builder.h"

namespace dymsum::planar {

/// A pair that scales by t = tau times fixed factors: of uniform scales both are 1 and `swept` is `given`.
struct ScalingPath {
  std::shared_ptr<const OperandPair> given, swept;
  Factors factors;
};

/// What a walk reports. `after` and `before` are states at a scale between two events.
class EventVisitor {
 public:
  virtual ~EventVisitor() = default;
  /// Comes first, if there is an event.
  virtual void before_events(const ScalingState& before) { static_cast<void>(before); }
  /// One event after the other, in order; false ends the walk.
  virtual bool passes(const ScaleEvent& event, const ScalingState& after) = 0;
};

/// Visits the events with scales t in [low, high], each t once: every visible one is among them. Errors: cancelled;
/// out_of_memory.
Result<void> walk_events(const ScalingPath& path, const MovingOptions& options, const exact::BigRational& low,
                         const exact::BigRational& high, const Progress& progress, EventVisitor& visitor);

}  // namespace dymsum::planar
