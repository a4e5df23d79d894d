// Exact signs at the angle of one event, where doubles leave something open.
#pragma once

#include <array>
#include <optional>

#include "cspace/events/exact_place.h"
#include "cspace/events/turn_events.h"
#include "planar/motion/turn_catalog.h"

namespace dymsum::planar {

/// Signs at the sides of the directions between which a segment exists: 1 inside, 0 where it begins or ends, -1 beyond.
/// It exists between both; at an angle, ends included, where neither is -1. Requires an edge at the vertex.
std::array<int, 2> existence_signs(const SignsAt& signs, const WalkSegment& s);
/// Whether a segment exists at the angle, or just begins or ends there.
bool exists_at(const SignsAt& signs, const TurnCatalog& catalog, const WalkSegment& s);

class EventSigns {
 public:
  EventSigns(TurnEvent& event, const TurningForms& forms, const TurnCatalog& catalog, const TurnRange& range)
      : event_(event), forms_(forms), catalog_(catalog), range_(range) {}

  /// Made when they are first asked for.
  const SignsAt& exact() const {
    if (!exact_) exact_.emplace(forms_, ExactAngle{range_.chart, exact_root(event_, forms_, range_)});
    return *exact_;
  }
  /// Whether a segment exists at the angle and at all near ones; `unsure` only where it begins or ends there.
  TurnCatalog::Existence exists(const WalkSegment& s) const;
  /// What ends and starts at a pair, by this existence.
  TurnCatalog::Joint joint(Pair v) const;
  /// The sign just behind the angle of a form that is zero there, its polynomial being p.
  int behind(const exact::Polynomial& p) const;

 private:
  TurnEvent& event_;
  const TurningForms& forms_;
  const TurnCatalog& catalog_;
  const TurnRange& range_;
  mutable std::optional<SignsAt> exact_;
};

}  // namespace dymsum::planar
