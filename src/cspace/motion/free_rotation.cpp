#include "cspace/motion/free_rotation.h"

#include "cspace/boundary/free_position.h"
#include "planar/motion/operand_pair.h"

namespace dymsum::planar {

FreeRotation::FreeRotation(const CspaceObstacle& obstacle, Point at)
    : obstacle_(obstacle), at_(at), pivot_(obstacle.robot(), obstacle.obstacle()) {
  pivot_.stand({exact::exact_value(at.x), exact::exact_value(at.y)});
}

// What is free on one side of an angle is free at it: overlapping is open.
std::vector<TurnMark> FreeRotation::marks() {
  const std::vector<PivotEvent> events = pivot_.events();
  const std::size_t n = events.size();
  std::vector<TurnMark> marks;
  for (std::size_t k = 0; k < n; ++k)
    marks.push_back({event_angle(events[k].angle), false,
                     is_free(orientation_between(events[k].angle, events[(k + 1) % n].angle))});
  for (std::size_t k = 0; k < n; ++k)
    marks[k].free = marks[(k + n - 1) % n].free_after || marks[k].free_after || is_free_at(events[k].angle);
  return marks;
}

std::vector<TurnMark> FreeRotation::marks(const Orientation& from, const Orientation& to) {
  const ExactAngle end = exact_angle(to);
  std::vector<TurnMark> marks;
  bool before = is_free(from);
  const std::vector<PivotEvent> events = pivot_.on_way(from, to, TurnDirection::counter_clockwise);
  for (std::size_t k = 0; k < events.size(); ++k) {
    const ExactAngle &angle = events[k].angle, &next = k + 1 < events.size() ? events[k + 1].angle : end;
    const bool after = is_free(compare(angle, end) == 0 ? to : orientation_between(angle, next));
    marks.push_back({event_angle(angle), before || after || is_free_at(angle), after});
    before = after;
  }
  return marks;
}

bool FreeRotation::is_free_at(const ExactAngle& angle) {
  if (!forms_) {
    // Robot and obstacle touch at this angle: the position is no further than both reach, 2^402 at most, of 2^1000 that
    // a pair takes; and a pair of any spread is never too wide.
    base_ = pair_of_regions(obstacle_.obstacle(), obstacle_.robot(),
                            {.moved = 1,
                             .reflect_q = true,
                             .further = {{{at_}, {Point{0, 0}}}},  // whose edges have no vertex there
                             .spread = Spread::any})
                .value();
    forms_.emplace(*base_, 1);
  }
  ExactPosition position;
  position.first.corner = {forms_->size(0), forms_->size(1)};
  return planar::is_free(SignsAt(*forms_, angle), position);
}

}  // namespace dymsum::planar

namespace dymsum {

std::vector<TurnMark> CspaceObstacle::turn_marks(double x, double y) const {
  return planar::FreeRotation(*this, {x, y}).marks();
}

std::vector<TurnMark> CspaceObstacle::turn_marks(double x, double y, const Orientation& from,
                                                 const Orientation& to) const {
  return planar::FreeRotation(*this, {x, y}).marks(from, to);
}

}  // namespace dymsum
