#include "dymsum/motion.h"

#include <algorithm>
#include <cmath>

#include "cspace/events/walked_rings.h"
#include "cspace/motion/pivot.h"

namespace dymsum {
namespace {

using namespace planar;
using exact::BigRational;

Position position_of(const RationalPoint& p) { return {exact::exact_value(p.x), exact::exact_value(p.y)}; }

Result<RationalPoint> rational(Point p) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y)) return Error{ErrorCode::not_finite, "a coordinate is not finite", {}};
  return RationalPoint{exact::to_rational(exact::exact_value(p.x)), exact::to_rational(exact::exact_value(p.y))};
}

RationalPoint to_public(const Position& p) { return {exact::to_rational(p.x), exact::to_rational(p.y)}; }

// The maximal free intervals: none begins or ends at a gap whose neighbours are free too.
std::vector<TurnInterval> intervals(const std::vector<PivotEvent>& events, const std::vector<PivotGap>& gaps) {
  std::vector<TurnInterval> free;
  const std::size_t n = gaps.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (gaps[k].overlap || !gaps[(k + n - 1) % n].overlap) continue;
    std::size_t last = k;
    while (!gaps[(last + 1) % n].overlap) last = (last + 1) % n;
    const PivotEvent &begin = events[gaps[k].begin], &end = events[gaps[last].end];
    free.push_back({event_angle(begin.angle), event_angle(end.angle), begin.contact, end.contact});
  }
  return free;
}

}  // namespace

Result<TranslationCheck> check_translation(const Region& robot, const Region& obstacle, const RationalPoint& from,
                                           const RationalPoint& to, const Orientation& theta, Touching touch) {
  const Position a = position_of(from), b = position_of(to);
  SumOptions options;
  // Two pieces without area that touch have no open sum, but a closed one.
  options.semantics = touch == Touching::allowed ? Semantics::open : Semantics::closed;
  Result<PlanarSum> slice = cspace_slice(robot, obstacle, theta, options);
  if (!slice) return slice.error();
  const SliceMap map(std::move(slice).value());
  const SliceMap::Passage passage = map.passage(SlicePoint(a), SlicePoint(b), touch == Touching::allowed);
  TranslationCheck check{passage.free, exact::to_rational(passage.first), to, std::nullopt};
  if (passage.free) return check;
  check.at = to_public(along(a, b, passage.first));
  if (passage.edge != SliceMap::kNone) check.contact = map.edges()[passage.edge].contact;
  return check;
}

Result<TranslationCheck> check_translation(const Region& robot, const Region& obstacle, Point from, Point to,
                                           const Orientation& theta, Touching touch) {
  const Result<RationalPoint> a = rational(from), b = rational(to);
  if (!a) return a.error();
  if (!b) return b.error();
  return check_translation(robot, obstacle, *a, *b, theta, touch);
}

Result<RotationCheck> check_rotation(const Region& robot, const Region& obstacle, const RationalPoint& at,
                                     const Orientation& from, const Orientation& to, TurnDirection turn,
                                     Touching touch) {
  if (auto error = refused_pair(robot, obstacle)) return *std::move(error);
  Pivot pivot(robot, obstacle);
  pivot.stand(position_of(at));
  RotationCheck check;
  if (const std::optional<PivotStop> stop = pivot.stop(from, to, turn, touch)) {
    check.free = false;
    check.first = event_angle(stop->angle);
    check.contact = stop->contact;
  }
  const std::vector<PivotEvent> events = pivot.events();
  const std::vector<PivotGap> gaps = pivot.gaps(events);
  check.always = gaps.empty() ? !pivot.overlaps({})
                              : std::none_of(gaps.begin(), gaps.end(), [](const PivotGap& gap) { return gap.overlap; });
  if (!check.always) check.free_angles = intervals(events, gaps);
  return check;
}

Result<RotationCheck> check_rotation(const Region& robot, const Region& obstacle, Point at, const Orientation& from,
                                     const Orientation& to, TurnDirection turn, Touching touch) {
  const Result<RationalPoint> position = rational(at);
  if (!position) return position.error();
  return check_rotation(robot, obstacle, *position, from, to, turn, touch);
}

}  // namespace dymsum
