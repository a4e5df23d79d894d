#include "depth/continuous_projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dymsum::depth {
namespace {

using spatial::cross;
using spatial::dot;
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

}  // namespace dymsum::depth
