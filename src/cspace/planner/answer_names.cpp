// Answers about obstacles and paths by name, as reports write them.
#include "dymsum/cspace_obstacle.h"
#include "dymsum/motion.h"
#include "dymsum/planner.h"

namespace dymsum {

std::string_view name(ObstacleEvent::Kind kind) {
  switch (kind) {
    case ObstacleEvent::Kind::alignment:
      return "alignment";
    case ObstacleEvent::Kind::vertex_on_segment:
      return "vertex_on_segment";
    case ObstacleEvent::Kind::three_segments:
      return "three_segments";
    case ObstacleEvent::Kind::tight:
      return "tight";
  }
  return "";
}

std::string_view name(MotionCheck::Outcome outcome) {
  switch (outcome) {
    case MotionCheck::Outcome::free:
      return "free";
    case MotionCheck::Outcome::blocked:
      return "blocked";
    case MotionCheck::Outcome::undecided:
      return "undecided";
  }
  return "";
}

std::string_view name(Waypoint::Move move) {
  switch (move) {
    case Waypoint::Move::start:
      return "start";
    case Waypoint::Move::translation:
      return "translation";
    case Waypoint::Move::counter_clockwise:
      return "counter_clockwise";
    case Waypoint::Move::clockwise:
      return "clockwise";
  }
  return "";
}

std::string_view name(NoPath::Kind kind) {
  switch (kind) {
    case NoPath::Kind::start_not_free:
      return "start_not_free";
    case NoPath::Kind::goal_not_free:
      return "goal_not_free";
    case NoPath::Kind::separated:
      return "separated";
    case NoPath::Kind::undecided:
      return "undecided";
  }
  return "";
}

}  // namespace dymsum
