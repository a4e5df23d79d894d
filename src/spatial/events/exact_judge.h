// What doubles do not tell of the points at one scale: whether they lie in the open sum, and whether what is in front
// of all facets through them is outside.
#pragma once

#include <span>

#include "spatial/boundary/collision.h"
#include "spatial/events/event_judge.h"

namespace dymsum::spatial {

/// The solids at a scale, for exact collision tests there. Immutable but for the planes and places that it is asked
/// about.
class ExactJudge {
 public:
  /// Whether coordinates at this scale are within the bits of a space.
  static bool has_room(const MovingFacets& all, const exact::BigRational& s);
  /// Requires has_room. The facets have to live as long.
  ExactJudge(const MovingFacets& all, const exact::BigRational& s);

  /// As judge(), for a point at this scale that it leaves unknown. Cost: two collision tests and m^2 signs for m facets
  /// through the point.
  JudgedPoint::Verdict verdict(const ExactMeeting& at, const JudgedPoint& judged);

 private:
  std::optional<Flag> in_front_of_all(const PointSource& place, std::span<const std::uint32_t> facets);

  const MovingFacets& all_;
  PosedSpace space_;
  Collision collision_;
};

}  // namespace dymsum::spatial
