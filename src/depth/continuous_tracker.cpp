#include "depth/continuous_tracker.h"

#include <algorithm>
#include <cmath>

#include "base/poll.h"

namespace dymsum::depth {
namespace {

using spatial::cross;
using spatial::dot;
using spatial::length;

double largest_coordinate(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

Vec3 shortest_direction(Vec3 from, const SurfacePoint& nearest) { return (1 / nearest.distance) * (nearest.at - from); }

Discontinuity reason_of(WalkEnd end) { return end == WalkEnd::lost ? Discontinuity::lost : Discontinuity::fold; }

}  // namespace

bool ContinuousTracker::covers(Vec3 from, double distance) const {
  return position_ && largest_coordinate(from - position_->centre) + wanted(distance) <= position_->reach;
}

void ContinuousTracker::move_to(std::shared_ptr<const ContinuousPosition> position) {
  position_ = std::move(position);
  if (!foot_) return;
  const SurfacePoint x = nearest_face(position_->surface, foot_->x);
  if (x.face == kNoEdge) return drop(Discontinuity::lost);
  foot_->face = x.face, foot_->x = x.at, foot_->is_known = false;
}

void ContinuousTracker::drop(Discontinuity why) { foot_.reset(), why_ = why, falls_back_ = false; }

/// The end of the shortest way out moves by no more than the position does, off jumps: on a face, an edge or a vertex
/// it is the foot on a plane, a line or a point. Where it is nearer than a step that says nothing of its direction,
/// which may turn by as much as that of smoothed ways.
bool ContinuousTracker::follows_shortest(Vec3 from, const SurfacePoint& nearest, double turned_by) const {
  const double most = (length(from - last_) + 2 * turned_by) * (1 + 1e-9) + 2 * error();
  return length(nearest.at - before_.x) <= most && length(shortest_direction(from, nearest) - before_.n) <= kMostTurn;
}

bool ContinuousTracker::answer(Vec3 from, const SurfaceDistance& near, double turned_by, bool must,
                               ContinuousContact& result) {
  const Stopwatch watch;
  WalkWork work;
  result.error = error() / limits_.scale;
  result.euclidean_depth = near.inside ? near.nearest.distance / limits_.scale : 0;
  if (!near.inside || near.nearest.distance <= error()) {
    result.meeting = near.nearest.distance <= error() ? Meeting::touching : Meeting::apart;
    drop(Discontinuity::entered);
    return true;
  }
  result.meeting = Meeting::overlapping;
  const std::optional<bool> goes_on = limits_.smoothing == 0
                                          ? follow_shortest(from, near.nearest, turned_by)
                                          : follow_or_search(from, near.nearest, turned_by, must, work);
  if (!goes_on) return false;
  if (!*goes_on) ++branch_;
  result.discontinuity = *goes_on ? Discontinuity::none : why_;
  report(from, near, result);
  if (foot_) before_ = *foot_;
  else before_.x = near.nearest.at, before_.n = shortest_direction(from, near.nearest), why_ = Discontinuity::inflation;
  last_ = from;
  result.work.steps += work.steps, result.work.normals += work.normals;
  result.work.projection_us += watch.ms() * 1000;
  return true;
}

bool ContinuousTracker::follow_shortest(Vec3 from, const SurfacePoint& nearest, double turned_by) {
  const bool goes_on = foot_ && follows_shortest(from, nearest, turned_by);
  if (foot_ && !goes_on) drop(turned_by > 0 ? Discontinuity::lost : Discontinuity::fold);
  foot_ = NormalFoot{};
  foot_->x = nearest.at, foot_->face = nearest.face, foot_->n = shortest_direction(from, nearest);
  return goes_on;
}

std::optional<bool> ContinuousTracker::follow_or_search(Vec3 from, const SurfacePoint& nearest, double turned_by,
                                                        bool must, WalkWork& work) {
  if (foot_) {
    const NormalFoot kept = *foot_;
    const Discontinuity before = why_;
    bool goes_on = follow_last(from, turned_by, work);
    if (goes_on && foot_->h > limits_.inflation * nearest.distance * (1 + 1e-9) + error())
      drop(Discontinuity::inflation), goes_on = false;
    if (goes_on) return true;
    if (!must) {
      foot_ = kept, why_ = before;
      return std::nullopt;
    }
  }
  search(from, nearest.distance, work);
  const bool goes_on = !foot_ && falls_back_ && follows_shortest(from, nearest, turned_by);
  falls_back_ = !foot_;
  return goes_on;
}

bool ContinuousTracker::follow_last(Vec3 from, double turned_by, WalkWork& work) {
  WalkEnd end = WalkEnd::stuck;
  if (turned_by == 0) {
    end = follow(position_->surface, limits_.smoothing, last_, from, limits_.halvings, *foot_, work);
  } else {
    end = walk_to(position_->surface, limits_.smoothing, from, *foot_, work);
    if (end == WalkEnd::arrived &&
        !depth::goes_on(before_, *foot_, length(from - last_) + turned_by, limits_.smoothing))
      end = WalkEnd::lost;
  }
  if (end == WalkEnd::arrived && foot_->h >= 0) return true;
  drop(reason_of(end));
  return false;
}

void ContinuousTracker::search(Vec3 from, double distance, WalkWork& work) {
  const double most = limits_.inflation * distance * (1 + 1e-9) + error();
  const NormalFoot found = shortest_foot(position_->surface, limits_.smoothing, from, most, work);
  if (found.face == kNoEdge) foot_.reset();
  else foot_ = found;
}

void ContinuousTracker::report(Vec3 from, const SurfaceDistance& near, ContinuousContact& result) const {
  const Vec3 way = near.nearest.at - from, shortest = (1 / length(way)) * way;
  const auto plain = [](Vec3 v) { return Point3{v.x, v.y, v.z}; };
  result.euclidean_normal = plain(shortest);
  result.branch = branch_;
  result.smoothed = limits_.smoothing > 0 && foot_.has_value();
  NormalFoot foot;
  if (result.smoothed) foot = *foot_;
  else {
    foot.x = near.nearest.at, foot.face = near.nearest.face, foot.n = shortest, foot.h = length(way);
    foot.gradient = -shortest, foot.turn_rate = 1 / foot.h;
  }
  result.depth = foot.h / limits_.scale, result.normal = plain(foot.n), result.gradient = plain(foot.gradient);
  result.turn_rate = foot.turn_rate * limits_.scale;
  result.error = (error() + foot.residual) / limits_.scale;
  if (foot.face != kNoEdge) result.contact = position_->surface.faces[foot.face].contact;
  Vec3 w = foot.x;
  if (const std::optional<Witness> witness = touching_position(position_->solids, result.contact, foot.x))
    w = witness->at, result.contact = witness->contact;
  const Vec3 wq = w - foot.h * foot.n;
  result.witness_p = unscaled(w), result.witness_q = unscaled(wq);
  const Vec3 torque = cross(wq - from, foot.gradient);
  result.torque = unscaled(torque);
}

}  // namespace dymsum::depth
