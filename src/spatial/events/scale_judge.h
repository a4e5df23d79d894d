// What happens at a point where facets meet while an operand scales: whether the sum changes there, as the facets
// through it decide, by doubles and, where these do not decide, exactly.
#pragma once

#include "dymsum/event.h"
#include "spatial/boundary/collision.h"
#include "spatial/events/meeting_search.h"

namespace dymsum::spatial {

struct JudgedPoint {
  enum class Verdict : std::uint8_t {
    changes,  ///< the boundary changes, and its topology does not
    quiet,    ///< the topology does not change; sums have to be compared for the rest
    unknown,  ///< sums have to be compared
    covered,  ///< nothing changes: the point lies in the open sum
  };
  Verdict verdict = Verdict::unknown;
  EventKind kind = EventKind::vertex_on_facet;
  std::vector<std::uint32_t> facets;  ///< through the point, where the verdict is unknown
  bool is_general = false;            ///< their position is
};

/// The verdict of doubles. Statement and proof: docs/design/scaling-solids.md, "What the facets tell".
JudgedPoint judge(const MovingFacets& all, const LiveFeatures& live, const ScaledOverlap& overlap,
                  const MeetingEvent& event);

/// What doubles do not tell of the points at one scale: whether they lie in the open sum, and whether what is in front
/// of all facets through them is outside. The solids at that scale, for collision tests. Immutable but for the planes
/// and positions that it is queried.
class ExactJudge {
 public:
  /// Whether coordinates at this scale are within the bits of a space.
  static bool has_room(const MovingFacets& all, const exact::BigRational& s);
  /// Requires has_room. The facets have to live as long.
  ExactJudge(const MovingFacets& all, const exact::BigRational& s);

  /// The exact verdict for a point at this scale that it leaves unknown. Cost: two collision tests and m^2 signs for m
  /// facets through the point.
  JudgedPoint::Verdict verdict(const ExactMeeting& at, const JudgedPoint& judged);

 private:
  std::optional<Flag> in_front_of_all(const PointSource& position, std::span<const std::uint32_t> facets);

  const MovingFacets& all_;
  PosedSpace space_;
  Collision collision_;
};

}  // namespace dymsum::spatial
