// Everything that can change the boundary within a window: alignments of edges, vertex sums on segments, three segments
// through one point. A superset, each with its exact angle.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/memory_budget.h"
#include "cspace/events/near_angle.h"
#include "cspace/events/overlap_filter.h"
#include "exact/algebraic_root.h"
#include "exact/rounding_bound.h"

namespace dymsum::planar {

struct RotationEvent {
  enum class Kind : std::uint8_t {
    alignment,          ///< of turning edge e with fixed edge f
    vertex_on_segment,  ///< v on a
    three_segments,     ///< a, b and c
    overlap,  ///< a and b, parallel at every angle and in the same direction, come onto one line and share an interval
              ///< of it
  };
  Kind kind = Kind::alignment;
  double low = 0, high = 0;  ///< theta lies between them
  WalkSegment a, b, c;
  Pair v;  ///< by walk vertices
  std::uint32_t e = 0, f = 0;
  std::optional<exact::AlgebraicRoot> root;  ///< always, but for alignments only when requested
  double theta() const { return (low + high) / 2; }
};

/// The exact angle.
const exact::AlgebraicRoot& exact_root(RotationEvent& event, const TurningForms& forms, const RotationRange& range);

/// All pairs of edges by the angle at which they point in the same direction, in doubles.
struct Alignment {
  double theta = 0;  ///< in (-pi / 2, 3 pi / 2]
  std::uint32_t e = 0, f = 0;
};
std::vector<Alignment> alignments(const TurningForms& forms, const RotationCatalog& catalog);

/// Three contacts that stay at one point at every angle.
using AlwaysConcurrent = std::array<WalkSegment, 3>;

struct RotationEvents {
  base::CountedArray<RotationEvent> events;  ///< by increasing `low`
  std::vector<AlwaysConcurrent> always_concurrent;
  std::uint64_t pairs = 0, triples = 0;
};
/// The crowded quarter turns among the ends of a window, and the angle at which much is aligned but for a rounding and
/// that it is around, or beside; or null.
class QuarterTurn;
class NearAngle;
struct QuarterEnds {
  const QuarterTurn *low = nullptr, *high = nullptr;
  const NearAngle *around = nullptr, *beside = nullptr;
  bool high_left_out = false;  ///< no event is made of the end either way
};
/// A filter leaves out those at positions that are provably covered. Those at crowded ends are always left out. `again`
/// is called now and then: it throws to stop.
RotationEvents events_in(const EventWindow& window, const TurningForms& forms, const RotationCatalog& catalog,
                         const std::vector<Alignment>& all, const OverlapFilter* filter, const QuarterEnds& ends,
                         const std::function<void()>& again);

// The angles between which an event lies, from its root.

/// The error of the angle of a tangent, below 8: twice an arc tangent, half a turn as a double, their sum, and the sum
/// with this bound, which just below 4 may end at 4.
inline constexpr double kEventAngle = exact::rounding_bound(2 + 2 + 4 + 4, 16);

/// Requires event.root.
inline void set_angles(RotationEvent& event, const RotationRange& range) {
  event.low = range.theta(event.root->low()) - kEventAngle;
  event.high = range.theta(event.root->high()) + kEventAngle;
}

/// The same by the root to 60 binary digits, where what doubles know of it is far wider.
inline void narrow_angles(RotationEvent& event, const RotationRange& range) {
  exact::RootBracket bracket = event.root->bracket();
  bracket.refine_to(60);
  event.low = range.theta(exact::double_bounds(bracket.low().value()).first) - kEventAngle;
  event.high = range.theta(exact::double_bounds(bracket.high().value()).second) + kEventAngle;
}

}  // namespace dymsum::planar
