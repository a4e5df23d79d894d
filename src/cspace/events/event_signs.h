// Exact signs at the angle of one event, where doubles leave something open.
#pragma once

#include <array>
#include <optional>

#include "cspace/events/exact_position.h"
#include "cspace/events/rotation_events.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

/// Signs at the sides of the directions between which a segment exists: 1 inside, 0 where it begins or ends, -1 beyond.
/// It exists between both; at an angle, ends included, where neither is -1. Requires an edge at the vertex.
std::array<int, 2> existence_signs(const SignsAt& signs, const WalkSegment& s);
/// Whether a segment exists at the angle, or just begins or ends there.
bool exists_at(const SignsAt& signs, const RotationCatalog& catalog, const WalkSegment& s);

class EventSigns {
 public:
  EventSigns(RotationEvent& event, const TurningForms& forms, const RotationCatalog& catalog,
             const RotationRange& range)
      : event_(event), forms_(forms), catalog_(catalog), range_(range) {}

  /// Made when they are first requested.
  const SignsAt& exact() const {
    if (!exact_) exact_.emplace(forms_, ExactAngle{range_.chart, exact_root(event_, forms_, range_)});
    return *exact_;
  }
  /// Whether a segment exists at the angle and at all near ones; `unsure` only where it begins or ends there.
  RotationCatalog::Existence exists(const WalkSegment& s) const;
  /// What ends and starts at a pair, by this existence.
  RotationCatalog::Joint joint(Pair v) const;
  /// The sign just after the angle of a form that is zero there, its polynomial being p.
  int after(const exact::Polynomial& p) const;

 private:
  RotationEvent& event_;
  const TurningForms& forms_;
  const RotationCatalog& catalog_;
  const RotationRange& range_;
  mutable std::optional<SignsAt> exact_;
};

}  // namespace dymsum::planar
