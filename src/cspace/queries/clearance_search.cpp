#include "cspace/queries/clearance_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact/rounding_bound.h"

namespace dymsum::cspace {
namespace {

void add_ring(const PlanarSum& slice, const SumRing& ring, Point from, NearestPosition& to) {
  for (std::size_t k = 0; k < ring.vertices.size(); ++k)
    to.add_segment(from, ring.vertices[k].at, ring.vertices[(k + 1) % ring.vertices.size()].at, 2 * slice.at_error);
}

NearestPosition nearest_edge(const PlanarSum& slice, Point from) {
  NearestPosition nearest;
  for (const SumPart& part : slice.parts) {
    add_ring(slice, part.outer, from, nearest);
    for (const SumRing& hole : part.holes) add_ring(slice, hole, from, nearest);
  }
  return nearest;
}

}  // namespace

// An obstacle has a slice at every angle (see Pivot::overlaps), and its position is a pair of finite doubles: none of
// the values below can be an error but where memory ends. A way of no length along which touching is forbidden is
// barred by overlaps and by contacts; an edge it touches is named.
SliceDistance::SliceDistance(const CspaceObstacle& obstacle, const Orientation& theta, Point from)
    : obstacle_(obstacle), theta_(theta), from_(from) {
  if (obstacle.contains(from.x, from.y, theta)) return;
  const TranslationCheck stand =
      check_translation(obstacle.robot(), obstacle.obstacle(), from, from, theta, Touching::forbidden).value();
  touching_ = !stand.free;
  on_edge_ = stand.contact.has_value();
}

NearestPosition SliceDistance::to_edges() const { return nearest_edge(obstacle_.slice(theta_).value(), from_); }

NearestPosition SliceDistance::to_boundary() const {
  const PlanarSum slice = obstacle_.slice(theta_, Semantics::open).value();
  NearestPosition nearest = nearest_edge(slice, from_);
  for (const SumSegment& s : slice.tight_segments) nearest.add_segment(from_, s.from.at, s.to.at, 2 * slice.at_error);
  for (const SumVertex& v : slice.tight_points) nearest.add_segment(from_, v.at, v.at, 2 * slice.at_error);
  return nearest;
}

// The error of a rotation is this times its weight: both angles' doubles, and the product of at most 4. The length of a
// vector errs relatively.
constexpr double kTurnError = exact::rounding_bound(2 * 12 + 4, 128), kFlatLength = exact::rounding_bound(3, 8);

NearestTight nearest_tight(const CspaceObstacle& obstacle, const Configuration& from, double weight) {
  NearestTight nearest;
  for (const TightFeature& f : obstacle.tight()) {
    const double theta = obstacle.angles()[f.angle].theta;
    const double turn = weight * std::remainder(theta - from.theta, 2 * std::numbers::pi);
    if (std::abs(turn) > nearest.position.distance + nearest.position.error + kTurnError * weight) continue;
    NearestPosition flat;
    flat.add_segment({from.x, from.y}, f.from, f.to, f.error);
    const double before = nearest.position.distance;
    nearest.position.add(std::hypot(flat.distance, turn),
                         flat.error + kTurnError * weight + kFlatLength * flat.distance, flat.at);
    if (nearest.position.distance != before) nearest.theta = theta;
  }
  return nearest;
}

namespace {

constexpr double kProved = 1024;  // times its error: a distance at which what is nearest is known to be boundary

// From so far away all of the obstacle is at one distance, up to a size or 2^43 sizes for the weight in 2^200.
constexpr double kFar = 0x1p200, kQueriedFrom = 0x1p100, kFarError = 0x1p-43;
constexpr double kSubnormal = 0x1p-1073;  // two roundings of what is smaller than doubles distinguish
// Events so near to an angle are looked at in its slice: any margin above what angles err by is right.
constexpr double kNearEvent = 4 * kAngleMargin;
// Distances worse than this share are taken from the slice.
constexpr double kExactEnough = 0x1p-32;
// Distances worse than this fraction of themselves are compared with that at the question's own angle.
constexpr double kCoarse = 0x1p-20;

double signed_by(bool negative, double v) { return negative ? -v : v; }

Clearance of(const NearestPatch& found, bool negative) {
  return {signed_by(negative, found.distance), found.error, found.patch, {found.at.x, found.at.y, found.theta}};
}

}  // namespace

// From as far as 2^200 sizes all of the obstacle is at the same distance, up to 2^43 sizes for the weight: what is
// nearest is asked from 2^100 sizes, in the same direction, so that no square overflows.
template <class Search>
NearestPatch ClearanceSearch::in_coordinates(const ClearanceQuestion& q, bool whole_edges, Search search) const {
  const Point origin = forms_.origin(), off{q.from.x - origin.x, q.from.y - origin.y};
  const double farther = std::max(std::abs(off.x), std::abs(off.y)), size = forms_.size() * forms_.unit();
  const bool far = farther > kFar * size;
  const double shrunk = kQueriedFrom * forms_.size() / farther;
  const Point from = far ? Point{shrunk * off.x, shrunk * off.y} : forms_.in_units(off);
  NearestPatch found = search({from, q.from.theta, std::isinf(q.weight) ? 0 : forms_.in_units(q.weight), whole_edges});
  found.distance *= forms_.unit();
  found.error *= forms_.unit();
  if (forms_.unit() < 1) found.error += kSubnormal;
  if (far && found.patch != Patch::kNone) {
    found.distance = std::hypot(off.x, off.y);
    found.error = kFarError * found.distance;
  }
  found.at = {found.at.x * forms_.unit() + origin.x, found.at.y * forms_.unit() + origin.y};
  return found;
}

NearestPatch ClearanceSearch::nearest(const ClearanceQuestion& q, bool whole_edges) const {
  return in_coordinates(q, whole_edges,
                        [&](const DistanceQuestion& queried) { return nearest_patch(forms_, tree_, queried); });
}

NearestPatch ClearanceSearch::nearest_at(const ClearanceQuestion& q) const {
  return in_coordinates(q, false,
                        [&](const DistanceQuestion& queried) { return nearest_patch_at(forms_, tree_, queried); });
}

// What is nearest to a free configuration with clearance can be left into free space, so that it lies on a patch; one
// that touches is determined exactly.
ClearanceSearch::Answer ClearanceSearch::any(const ClearanceQuestion& q) const {
  const NearestPatch found = nearest(q, !q.overlaps);
  const NearestTight tight = nearest_tight(obstacle_, q.from, q.weight);
  if (!q.overlaps) {
    const bool at_patch = found.distance <= found.error,
               at_curve = obstacle_.may_have_tight_curves() && !q.provably_apart;
    if (at_patch || at_curve || tight.position.least <= 0) {
      const SliceDistance slice = slice_of(q);
      if (slice.touching()) return touching(q, found, slice.on_edge());
    }
    const NearestPatch shown = found.distance > kProved * found.error ? found : on_boundary(q, found);
    return {of(shown, false), shown.bounds};
  }
  Clearance nearest = of(found, true);
  if (q.touching == Touching::forbidden || !(tight.position.least < found.distance + found.error))
    return {nearest, found.bounds};
  const double least = std::min(found.distance - found.error, tight.position.least);
  if (tight.position.distance + tight.position.error < found.distance + found.error)
    nearest = {-tight.position.distance,
               tight.position.error,
               Patch::kNone,
               {tight.position.at.x, tight.position.at.y, tight.theta}};
  nearest.error = std::max(nearest.error, -nearest.distance - least);
  return {nearest, found.bounds};
}

// Where angles count little, an edge may be as near at an angle at which it is inside the obstacle.
NearestPatch ClearanceSearch::on_boundary(const ClearanceQuestion& q, const NearestPatch& found) const {
  NearestPatch proved = nearest(q, false);
  if (proved.patch == Patch::kNone) return found;
  proved.bounds += found.bounds;
  return proved;
}

// On an edge of the closed slice there is free space with clearance nearby.
ClearanceSearch::Answer ClearanceSearch::touching(const ClearanceQuestion& q, const NearestPatch& found,
                                                  bool on_edge) const {
  if (q.touching == Touching::forbidden && !on_edge) {
    const NearestPatch way_out = nearest(q, false);
    return {of(way_out, true), found.bounds + way_out.bounds};
  }
  const bool at_patch = found.distance <= found.error;
  return {{signed_by(q.touching == Touching::forbidden, 0), 0, at_patch ? found.patch : Patch::kNone, q.from},
          found.bounds};
}

SliceDistance ClearanceSearch::slice_of(const ClearanceQuestion& q) const {
  return {obstacle_, Orientation::nearest(q.queried).value(), {q.from.x, q.from.y}};
}

bool ClearanceSearch::near_event(double theta) const {
  const double margin = std::max(kNearEvent, 4 * forms_.angle_margin());
  const std::vector<EventAngle>& angles = obstacle_.angles();
  for (const double turn : {-2 * std::numbers::pi, 0.0, 2 * std::numbers::pi}) {
    const auto from = std::lower_bound(angles.begin(), angles.end(), theta + turn - margin,
                                       [](const EventAngle& a, double v) { return a.theta < v; });
    if (from != angles.end() && from->theta <= theta + turn + margin) return true;
  }
  return false;
}

// Patches are those of the angle's slab where no event is near; what touches, and where an end moves too fast for the
// angle's doubles, is determined by the slice.
ClearanceSearch::Answer ClearanceSearch::translation(const ClearanceQuestion& q) const {
  if (near_event(q.from.theta) || obstacle_.may_have_tight_curves()) return by_slice(q);
  const NearestPatch found = nearest_at(q);
  const bool exact_enough = found.error <= kExactEnough * (found.distance + forms_.size() * forms_.unit());
  if (!exact_enough || (!q.overlaps && found.distance <= found.error)) return by_slice(q);
  return {of(found, q.overlaps), found.bounds};
}

// What translations reach bounds the distance from above; that of the answer, less its error, from below.
ClearanceSearch::Answer ClearanceSearch::no_farther_than_translation(const ClearanceQuestion& q, Answer answer) const {
  Clearance& found = answer.clearance;
  const double distance = std::abs(found.distance);
  if (!std::isfinite(distance) || found.error <= kCoarse * distance) return answer;
  const Answer still = translation(q);
  answer.bounds += still.bounds;
  const double reached = std::abs(still.clearance.distance);
  if (!(reached + still.clearance.error < distance + found.error)) return answer;
  const double least = distance - found.error;
  found = still.clearance;
  found.error = std::max(found.error, (reached - least) * exact::kOutwards);
  return answer;
}

ClearanceSearch::Answer ClearanceSearch::by_slice(const ClearanceQuestion& q) const {
  const SliceDistance slice = slice_of(q);
  const bool strict = q.touching == Touching::forbidden, touching = slice.touching();
  const bool inside = q.overlaps || (touching && strict);
  Clearance nearest{signed_by(inside, 0), 0, Patch::kNone, q.from};
  if (!touching || (strict && !slice.on_edge())) {
    const NearestPosition position = inside && !strict ? slice.to_boundary() : slice.to_edges();
    nearest = {signed_by(inside, position.distance),
               position.total_error(),
               Patch::kNone,
               {position.at.x, position.at.y, q.from.theta}};
  }
  // The patch at the nearest point, if there is one.
  ClearanceQuestion there = q;
  there.from = nearest.nearest;
  const NearestPatch patch = nearest_at(there);
  if (patch.distance <= patch.error + nearest.error) nearest.patch = patch.patch;
  return {nearest, patch.bounds};
}

}  // namespace dymsum::cspace
