#include "dymsum/path_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/poll.h"
#include "cspace/events/walked_rings.h"
#include "cspace/motion/pivot.h"
#include "dymsum/motion.h"
#include "planar/motion/orientation.h"

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

namespace {

using Outcome = MotionCheck::Outcome;

Configuration between(const Configuration& a, const Configuration& b, double fraction) {
  return {std::lerp(a.x, b.x, fraction), std::lerp(a.y, b.y, fraction), std::lerp(a.theta, b.theta, fraction)};
}

Error malformed(std::size_t index, const std::string& what) {
  return {ErrorCode::malformed, "waypoint " + std::to_string(index) + " of the path " + what, {}};
}

PathCheck of_translation(const TranslationCheck& check, const Configuration& a, const Configuration& b) {
  PathCheck piece;
  piece.moves = true;
  piece.outcome = check.free ? Outcome::free : Outcome::blocked;
  piece.contact = check.contact;
  if (!check.free) piece.low = piece.high = check.first.to_double();
  piece.at = check.free ? b : Configuration{check.at.x.to_double(), check.at.y.to_double(), a.theta};
  return piece;
}

/// The fraction of the first contact on a way from `from` that turns by `turn` in all.
PathCheck of_rotation(const RotationCheck& check, const Configuration& from, double turn) {
  PathCheck piece;
  piece.turns = true;
  piece.outcome = check.free ? Outcome::free : Outcome::blocked;
  piece.contact = check.contact;
  if (!check.free && check.first) {
    double ahead = std::remainder(check.first->theta - planar::reduced_angle(from.theta), 2 * std::numbers::pi);
    if (ahead * turn < 0) ahead += turn > 0 ? 2 * std::numbers::pi : -2 * std::numbers::pi;
    piece.low = piece.high = turn == 0 ? 0 : std::clamp(ahead / turn, 0.0, 1.0) + 0.0;  // no -0
  }
  piece.at = {from.x, from.y, piece.low == 0 ? from.theta : from.theta + piece.low * turn};
  return piece;
}

double turn_of(const Waypoint& a, const Waypoint& b) {
  const double turn = b.approx.theta - a.approx.theta, whole = 2 * std::numbers::pi;
  if (b.move == Waypoint::Move::counter_clockwise) return turn < 0 ? turn + whole : turn;
  return turn > 0 ? turn - whole : turn;
}

Result<PathCheck> check_piece(const Region& robot, const Region& obstacle, const Waypoint& a, const Waypoint& b,
                              std::size_t k, Touching touch) {
  if (b.move == Waypoint::Move::start) return malformed(k, "is a start");
  if (b.move == Waypoint::Move::translation) {
    if (!(a.theta == b.theta)) return malformed(k, "is a translation that turns");
    const Result<TranslationCheck> check = check_translation(robot, obstacle, a.at, b.at, a.theta, touch);
    if (!check) return check.error();
    return of_translation(*check, a.approx, b.approx);
  }
  if (!(a.at == b.at)) return malformed(k, "is a rotation that moves");
  const auto turn = b.move == Waypoint::Move::clockwise ? TurnDirection::clockwise : TurnDirection::counter_clockwise;
  const Result<RotationCheck> check = check_rotation(robot, obstacle, a.at, a.theta, b.theta, turn, touch);
  if (!check) return check.error();
  return of_rotation(*check, a.approx, turn_of(a, b));
}

// Checks a rotation in place, as far as theta says: more than a turn is a whole turn.
template <class At>
Result<PathCheck> check_turn(const Region& robot, const Region& obstacle, const At& at, const Configuration& a,
                             const Configuration& b, Touching touch) {
  const double by = b.theta - a.theta;
  const auto turn = by < 0 ? TurnDirection::clockwise : TurnDirection::counter_clockwise;
  const Result<Orientation> from = Orientation::nearest(a.theta), to = Orientation::nearest(b.theta);
  if (!from) return from.error();
  if (!to) return to.error();
  std::vector<Orientation> way{*from, *to};
  if (std::abs(by) >= 2 * std::numbers::pi) way = {*from, *from * Orientation::half_turn(), *from};
  for (std::size_t k = 1; k < way.size(); ++k) {
    const Result<RotationCheck> check = check_rotation(robot, obstacle, at, way[k - 1], way[k], turn, touch);
    if (!check) return check.error();
    if (!check->free || k + 1 == way.size()) return of_rotation(*check, a, by);
  }
  return PathCheck{};
}

Result<PathCheck> check_piece(const Region& robot, const Region& obstacle, const Configuration& a,
                              const Configuration& b, Touching touch, const MotionOptions& options,
                              const Progress& progress) {
  if (a.theta == b.theta) {
    const Result<Orientation> theta = Orientation::nearest(a.theta);
    if (!theta) return theta.error();
    const Result<TranslationCheck> check =
        check_translation(robot, obstacle, Point{a.x, a.y}, Point{b.x, b.y}, *theta, touch);
    if (!check) return check.error();
    return of_translation(*check, a, b);
  }
  if (a.x == b.x && a.y == b.y) return check_turn(robot, obstacle, Point{a.x, a.y}, a, b, touch);
  const Result<MotionCheck> check = check_motion(robot, obstacle, a, b, options, progress);
  if (!check) return check.error();
  PathCheck piece;
  piece.outcome = check->outcome;
  piece.moves = piece.turns = true;
  piece.low = check->low;
  piece.high = check->high;
  piece.at = between(a, b, piece.low);
  piece.contact = check->contact;
  return piece;
}

Configuration nearest(const ExactPose& pose) { return {pose.at.x.to_double(), pose.at.y.to_double(), pose.theta}; }

bool is_of_doubles(const ExactPose& pose) {
  const Result<Rational> x = Rational::of(pose.at.x.to_double()), y = Rational::of(pose.at.y.to_double());
  return x && y && *x == pose.at.x && *y == pose.at.y;
}

Result<PathCheck> check_piece(const Region& robot, const Region& obstacle, const ExactPose& a, const ExactPose& b,
                              std::size_t k, Touching touch, const MotionOptions& options, const Progress& progress) {
  const Configuration from = nearest(a), to = nearest(b);
  if (is_of_doubles(a) && is_of_doubles(b)) return check_piece(robot, obstacle, from, to, touch, options, progress);
  if (a.theta == b.theta) {
    const Result<Orientation> theta = Orientation::nearest(a.theta);
    if (!theta) return theta.error();
    const Result<TranslationCheck> check = check_translation(robot, obstacle, a.at, b.at, *theta, touch);
    if (!check) return check.error();
    return of_translation(*check, from, to);
  }
  if (a.at == b.at) return check_turn(robot, obstacle, a.at, from, to, touch);
  return Error{ErrorCode::unsupported_operand,
               "pose " + std::to_string(k) +
                   " of the path is reached by moving and turning at once, which is examined in doubles, and its "
                   "position or the one before is none",
               {}};
}

// The progress of the whole path, while a piece of it is examined.
Progress of_piece(const Progress& progress, std::size_t piece, std::size_t poses) {
  if (!progress) return {};
  return [&progress, piece, poses](std::string_view, double fraction) {
    return progress("pieces", (static_cast<double>(piece) + fraction) / static_cast<double>(poses));
  };
}

// The first piece that is not free, else the last one; a path of one pose is a translation to itself.
template <class Pose, class Check>
Result<PathCheck> first_not_free(std::span<const Pose> path, const Progress& progress, Check check) {
  if (path.empty()) return Error{ErrorCode::malformed, "a path of no poses", {}};
  PathCheck last;
  for (std::size_t k = path.size() == 1 ? 0 : 1; k < path.size(); ++k) {
    if (progress && !progress("pieces", static_cast<double>(k) / static_cast<double>(path.size()))) return cancelled();
    Result<PathCheck> piece = check(path[k == 0 ? 0 : k - 1], path[k], k);
    if (!piece) return piece;
    last = *piece;
    last.piece = k == 0 ? 0 : k - 1;
    last.pieces = last.piece + 1;
    if (last.outcome != Outcome::free) break;
  }
  return last;
}

}  // namespace

Result<PathCheck> check_path(const Region& robot, const Region& obstacle, std::span<const Waypoint> path,
                             Touching touch, const Progress& progress) {
  if (!path.empty() && path[0].move != Waypoint::Move::start) return malformed(0, "is not its start");
  return first_not_free(path, progress, [&](const Waypoint& a, Waypoint b, std::size_t k) {
    if (k == 0) b.move = Waypoint::Move::translation;
    return check_piece(robot, obstacle, a, b, k, touch);
  });
}

Result<PathCheck> check_path(const Region& robot, const Region& obstacle, std::span<const Configuration> poses,
                             Touching touch, const MotionOptions& options, const Progress& progress) {
  return first_not_free(poses, progress, [&](const Configuration& a, const Configuration& b, std::size_t k) {
    return check_piece(robot, obstacle, a, b, touch, options, of_piece(progress, k, poses.size()));
  });
}

Result<PathCheck> check_path(const Region& robot, const Region& obstacle, std::span<const ExactPose> poses,
                             Touching touch, const MotionOptions& options, const Progress& progress) {
  return first_not_free(poses, progress, [&](const ExactPose& a, const ExactPose& b, std::size_t k) {
    return check_piece(robot, obstacle, a, b, k, touch, options, of_piece(progress, k, poses.size()));
  });
}

}  // namespace dymsum
