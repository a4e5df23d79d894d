// Three contacts that stay at one point z at every angle are no event. Each covers what lies to its left near z, so
// where their directions span the plane with positive weights z has no free space beside it: free or covered, z changes
// only at events of another segment or of an end of the three, all of which are listed. Between two events one exact
// test therefore determines whether z is free, hence tight, unless it is an end of one of them, beside which free space
// comes to it: then the boundary passes there.
#include "cspace/obstacle/tight_curves.h"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "cspace/boundary/free_position.h"
#include "cspace/events/event_position.h"
#include "cspace/obstacle/tight_positions.h"
#include "exact/rounding_bound.h"
#include "planar/motion/orientation.h"

namespace dymsum::planar {
namespace {

bool before(const WalkSegment& s, const WalkSegment& t) {
  return std::tuple{s.side, s.edge, s.vertex} < std::tuple{t.side, t.edge, t.vertex};
}
bool less(const AlwaysConcurrent& x, const AlwaysConcurrent& y) {
  return std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end(), before);
}

RotationEvent event_of(const AlwaysConcurrent& three) {
  RotationEvent event;
  event.kind = RotationEvent::Kind::three_segments;
  event.a = three[0];
  event.b = three[1];
  event.c = three[2];
  return event;
}

// The directions span the plane with positive weights: each turns the same way to the next.
bool spans(const SignsAt& signs, const AlwaysConcurrent& s) {
  const int ab = signs.cross(s[0], s[1]);
  return ab != 0 && signs.cross(s[1], s[2]) == ab && signs.cross(s[2], s[0]) == ab;
}
// The error of a cross product is this times the lengths.
constexpr double kCross = exact::rounding_bound(56, 8192);
bool may_span(const TurningForms& forms, const AlwaysConcurrent& s, Heading h) {
  int most = 0, least = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const WalkSegment &a = s[k], &b = s[(k + 1) % 3];
    const double cross = forms.cross(a, b).at(h), error = kCross * forms.length1(a) * forms.length1(b);
    most += cross > -error;
    least += cross < error;
  }
  return most == 3 || least == 3;
}

}  // namespace

std::vector<AlwaysConcurrent> common_curves(const std::vector<AlwaysConcurrent>& before,
                                            const std::vector<AlwaysConcurrent>& after) {
  std::vector<AlwaysConcurrent> all;
  std::set_intersection(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(all), less);
  return all;
}

std::vector<AlwaysConcurrent> other_curves(const std::vector<AlwaysConcurrent>& before,
                                           const std::vector<AlwaysConcurrent>& after) {
  std::vector<AlwaysConcurrent> all;
  std::set_symmetric_difference(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(all),
                                less);
  return all;
}

std::vector<AlwaysConcurrent> tight_curves(const SweepScene& scene, const std::vector<AlwaysConcurrent>& threes,
                                           const Orientation& at, const OverlapFilter& filter) {
  std::vector<AlwaysConcurrent> found;
  const Heading h = Heading::of(at.radians());
  std::optional<SignsAt> signs;
  std::optional<PositionsAtAngle> positions;
  std::vector<NodeNow> nodes;
  for (const AlwaysConcurrent& three : threes) {
    if (!may_span(scene.forms, three, h)) continue;
    const EventPosition position = position_of(event_of(three), scene.forms, h);
    if (position.sine >= kPlacedSine && filter.inside(position.at, h)) continue;
    if (!signs) {
      signs.emplace(scene.forms, exact_angle(at));
      positions.emplace(scene, *signs);
    }
    const std::optional<TightCandidate> z = spans(*signs, three) ? positions->meeting_of(three) : std::nullopt;
    if (!z || !is_free(*signs, z->position)) continue;
    if (nodes.empty()) nodes = positions->nodes_now(false);
    if (std::any_of(nodes.begin(), nodes.end(), [&](const NodeNow& n) { return positions->reaches(n, *z); })) continue;
    found.push_back(three);
    std::sort(found.back().begin(), found.back().end(), before);
  }
  std::sort(found.begin(), found.end(), less);
  return found;
}

}  // namespace dymsum::planar
