#include "depth/continuous_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/poll.h"

namespace dymsum::depth {

// A face's plane cuts the ball around x in a disc of squared radius b about the foot of x. In polar coordinates about
// the foot an integral of k(rho^2) over polygon and disc is the sum over directed edges of K(rho) dtheta, K being the
// integral of k(r^2) r dr up to rho, and the one up to the rim outside of the disc. On an edge dtheta = d / rho^2 ds:
// polynomials of s inside the disc, a constant times an angle outside.

namespace {

using spatial::dot;

/// The integrals of (b - rho^2)^2 and b - rho^2 over a face, and of (b - rho^2)^2 along its edges, times their outward
/// directions.
struct FaceIntegrals {
  double square = 0, linear = 0;
  Vec3 rim;
};

/// The angle under which the foot sees the piece of a line at distance d.
double angle_of(double d, double from, double to) { return std::atan2(d * (to - from), d * d + from * to); }

void add_edge(const SurfaceEdge& e, Vec3 to_start, double b, FaceIntegrals& sum) {
  const double s0 = dot(e.along, to_start), s1 = s0 + e.length, d = dot(e.out, to_start), d2 = d * d;
  const double c2 = b - d2, c = c2 > 0 ? std::sqrt(c2) : 0;
  const double low = std::max(s0, -c), high = std::min(s1, c);
  double outside = 0;
  if (low < high) {
    if (s0 < low) outside += angle_of(d, s0, low);
    if (high < s1) outside += angle_of(d, high, s1);
    const double l2 = low * low, h2 = high * high;
    const double one = high - low, three = (high * h2 - low * l2) / 3, five = (high * h2 * h2 - low * l2 * l2) / 5;
    sum.square += d / 6 * ((3 * b * b - 3 * b * d2 + d2 * d2) * one + (2 * d2 - 3 * b) * three + five);
    sum.linear += d / 4 * ((2 * b - d2) * one - three);
    sum.rim = sum.rim + (c2 * c2 * one - 2 * c2 * three + five) * e.out;
  } else outside = angle_of(d, s0, s1);
  sum.square += b * b * b / 6 * outside, sum.linear += b * b / 4 * outside;
}

bool is_beyond(const SurfaceFace& f, Vec3 x, double l) {
  const auto gap = [](double low, double high, double v) { return std::max({low - v, v - high, 0.0}); };
  const double dx = gap(f.low.x, f.high.x, x.x), dy = gap(f.low.y, f.high.y, x.y), dz = gap(f.low.z, f.high.z, x.z);
  return dx * dx + dy * dy + dz * dz >= l * l;
}

}  // namespace

SmoothedNormal smoothed_normal(const ContinuousSurface& s, double l, Vec3 x) {
  SmoothedNormal sum;
  for (const SurfaceFace& f : s.faces) {
    if (is_beyond(f, x, l)) continue;
    const double z = dot(f.normal, x - s.start(s.edges[f.first])), b = l * l - z * z;
    if (b <= 0) continue;
    FaceIntegrals face;
    for (std::uint32_t k = f.first; k < f.last; ++k) add_edge(s.edges[k], s.start(s.edges[k]) - x, b, face);
    sum.value = sum.value + face.square * f.normal;
    const Vec3 slope = -4 * z * face.linear * f.normal - face.rim;
    sum.derivative[0] = sum.derivative[0] + f.normal.x * slope;
    sum.derivative[1] = sum.derivative[1] + f.normal.y * slope;
    sum.derivative[2] = sum.derivative[2] + f.normal.z * slope;
  }
  return sum;
}

namespace {

using spatial::cross;
using spatial::length;

constexpr int kMostSteps = 200;        // of one walk: across edges, and Newton's
constexpr double kLongestStep = 0.25;  // of a walk, in smoothing lengths
constexpr double kLeastVolume = 1e-4;  // of the three derivatives, of length about 1, where a branch is taken to end
constexpr std::size_t kMostStarts = 64;
constexpr double kRateSlack = 1.25;

/// d(x - h n) = u (e1 - h dn e1) + v (e2 - h dn e2) - n dh: the three columns and what solves it.
struct Tangents {
  Vec3 e1, e2, a, b, n;
  Vec3 turn1, turn2;  ///< of n along e1 and e2
  double volume = 0;  ///< n times the cross product of the others: positive where touching solids begin
  /// (u, v, h) of a change of x - h n.
  Vec3 solve(Vec3 r) const {
    const double s = 1 / volume;
    return {s * dot(r, cross(b, n)), -s * dot(r, cross(a, n)), -s * dot(r, cross(a, b))};
  }
};

std::optional<Tangents> tangents_at(const ContinuousSurface& s, double l, NormalFoot& foot, WalkWork& work) {
  if (!foot.is_known) ++work.normals, foot.normal = smoothed_normal(s, l, foot.x), foot.is_known = true;
  const SmoothedNormal& sum = foot.normal;
  const double size = length(sum.value);
  if (!(size > 1e-9 * std::pow(l, 6))) return std::nullopt;
  Tangents t;
  t.n = (1 / size) * sum.value;
  const Vec3 up = s.faces[foot.face].normal;
  const Vec3 other = std::abs(up.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  t.e1 = cross(up, other), t.e1 = (1 / length(t.e1)) * t.e1, t.e2 = cross(up, t.e1);
  const auto turn = [&](Vec3 e) {
    const Vec3 d = (1 / size) * (sum.derivative * e);
    return d - dot(d, t.n) * t.n;
  };
  t.turn1 = turn(t.e1), t.turn2 = turn(t.e2);
  t.a = t.e1 - foot.h * t.turn1, t.b = t.e2 - foot.h * t.turn2;
  t.volume = dot(t.n, cross(t.a, t.b));
  if (!(t.volume > kLeastVolume)) return std::nullopt;
  return t;
}

/// The first edge of a face that a way from x leaves through, and at which share of it.
struct Leaving {
  std::uint32_t edge = kNoEdge;
  double fraction = 1;
};

Leaving leaving(const ContinuousSurface& s, const NormalFoot& foot, Vec3 way) {
  Leaving first;
  const SurfaceFace& f = s.faces[foot.face];
  const double slack = 1e-12 * (1 + length(foot.x));
  for (std::uint32_t k = f.first; k < f.last; ++k) {
    const SurfaceEdge& e = s.edges[k];
    const double out = dot(way, e.out);
    if (out <= 0) continue;
    const Vec3 to_start = s.start(e) - foot.x;
    const double gap = dot(to_start, e.out);
    if (gap < -slack || gap >= first.fraction * out) continue;
    const double fraction = std::max(gap, 0.0) / out, along = fraction * dot(way, e.along) - dot(to_start, e.along);
    if (along < -slack || along > e.length + slack) continue;
    first = {k, fraction};
  }
  return first;
}

/// One step along (u, v, h), or as far as the face goes. False at the end of the surface.
bool advance(const ContinuousSurface& s, const Tangents& t, Vec3 step, double l, NormalFoot& foot) {
  Vec3 way = step.x * t.e1 + step.y * t.e2;
  double fraction = 1;
  const double longest = std::max(length(way), std::abs(step.z));
  if (longest > kLongestStep * l) fraction = kLongestStep * l / longest;
  way = fraction * way;
  const Leaving exit = leaving(s, foot, way);
  foot.is_known = false;
  foot.x = foot.x + exit.fraction * way, foot.h += exit.fraction * fraction * step.z;
  if (exit.edge == kNoEdge) return true;
  const SurfaceEdge& e = s.edges[exit.edge];
  if (e.twin == kNoEdge) return false;
  const SurfaceEdge& twin = s.edges[e.twin];
  // Onto the edge, which both planes hold.
  const double along = std::clamp(dot(e.along, foot.x - s.start(e)), 0.0, e.length);
  foot.x = s.start(e) + along * e.along;
  foot.face = twin.face;
  return true;
}

void settle(const Tangents& t, double residual, NormalFoot& foot) {
  foot.n = t.n, foot.residual = residual;
  foot.gradient = -1 / t.volume * cross(t.a, t.b);
  // n changes by u turn1 + v turn2: the product of two matrices, bounded by their entries' squares.
  const Vec3 du = 1 / t.volume * cross(t.b, t.n), dv = -1 / t.volume * cross(t.a, t.n);
  const Vec3 rows[3] = {t.turn1.x * du + t.turn2.x * dv, t.turn1.y * du + t.turn2.y * dv,
                        t.turn1.z * du + t.turn2.z * dv};
  foot.turn_rate = std::sqrt(dot(rows[0], rows[0]) + dot(rows[1], rows[1]) + dot(rows[2], rows[2]));
}

}  // namespace

WalkEnd walk_to(const ContinuousSurface& s, double l, Vec3 from, NormalFoot& foot, WalkWork& work) {
  const double fine = 2e-13 * (1 + length(from) + length(foot.x));
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostSteps; ++k) {
    ++work.steps;
    const std::optional<Tangents> t = tangents_at(s, l, foot, work);
    if (!t) return WalkEnd::folded;
    const Vec3 r = from - (foot.x - foot.h * t->n);
    const double size = length(r);
    // Rounding: nothing is won any more.
    if (size <= fine || (size < 1e-10 && size >= 0.5 * last)) {
      settle(*t, size, foot);
      return WalkEnd::arrived;
    }
    last = size;
    if (!advance(s, *t, t->solve(r), l, foot)) return WalkEnd::lost;
  }
  return WalkEnd::stuck;
}

bool goes_on(const NormalFoot& last, const NormalFoot& next, double moved, double l) {
  // |dx| <= |dt| + |dh| + h |dn|, and |dh| <= |gradient| |dt|.
  const double rate =
      1 + std::max(length(last.gradient), length(next.gradient)) + last.h * std::max(last.turn_rate, next.turn_rate);
  const double turn = length(next.n - last.n);
  return turn <= kMostTurn && length(next.x - last.x) <= 2 * rate * moved + 1e-9 * l;
}

namespace {

/// Whether n turns as its rate says: along a branch it turns by the integral of its rate. A turn that is larger than
/// what the rates at both ends say may be a jump over two folds.
bool turns_as_its_rate(const NormalFoot& last, const NormalFoot& next, double moved) {
  const double turn = length(next.n - last.n);
  return turn <= kSmallTurn || turn <= 0.5 * kRateSlack * (last.turn_rate + next.turn_rate) * moved;
}

}  // namespace

WalkEnd follow(const ContinuousSurface& s, double l, Vec3 last, Vec3 from, int halvings, NormalFoot& foot,
               WalkWork& work) {
  NormalFoot next = foot;
  const WalkEnd end = walk_to(s, l, from, next, work);
  const double moved = length(from - last);
  if (end == WalkEnd::arrived && goes_on(foot, next, moved, l) && turns_as_its_rate(foot, next, moved)) {
    foot = next;
    return WalkEnd::arrived;
  }
  if (halvings == 0) return end == WalkEnd::arrived ? WalkEnd::folded : end;
  const Vec3 midpoint = 0.5 * (last + from);
  const WalkEnd first = follow(s, l, last, midpoint, halvings - 1, foot, work);
  return first == WalkEnd::arrived ? follow(s, l, midpoint, from, halvings - 1, foot, work) : first;
}

NormalFoot shortest_foot(const ContinuousSurface& s, double l, Vec3 from, double reach, WalkWork& work) {
  NormalFoot best;
  std::size_t starts = 0;
  for (const SurfacePoint& x : local_minima(s, from, reach)) {
    if (x.distance >= reach || ++starts > kMostStarts) break;
    NormalFoot foot;
    foot.face = x.face, foot.x = x.at, foot.h = x.distance;
    if (walk_to(s, l, from, foot, work) != WalkEnd::arrived || foot.h < 0 || foot.h > reach) continue;
    best = foot, reach = foot.h;
  }
  return best;
}

namespace {

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
