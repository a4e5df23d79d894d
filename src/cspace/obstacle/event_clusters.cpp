// Events at one angle by what they change: each changes the boundary around its own place only, so that events at
// different places are handled one by one even if a segment takes part in several of them.
#include <algorithm>
#include <numeric>

#include "cspace/obstacle/obstacle_sweep.h"

namespace dymsum::planar {
namespace {

/// Angles of events err by less, or their places are not computed.
constexpr double kAngle = 0x1p-30;

/// A disc that certainly holds the place of an event, or the stretch along which it changes the boundary; infinite for
/// alignments and where doubles do not tell.
struct Spot {
  Point at;
  double radius = INFINITY;
  bool apart_from(const Spot& o) const { return std::hypot(at.x - o.at.x, at.y - o.at.y) > radius + o.radius; }
};

Spot around_common_stretch(const TurnEvent& event, const TurningForms& forms, Heading h) {
  const Point d = forms.direction(event.a, h), e = forms.direction(event.b, h);
  const Point s = forms.place(TurningForms::start(event.a), h), t = forms.place(TurningForms::start(event.b), h);
  const double length = std::hypot(d.x, d.y), from = (d.x * (t.x - s.x) + d.y * (t.y - s.y)) / length;
  const double first = std::max(0.0, from), last = std::min(length, from + std::hypot(e.x, e.y)),
               middle = (first + last) / (2 * length);
  return {{s.x + middle * d.x, s.y + middle * d.y}, std::max(0.0, last - first) / 2 + 4 * kAngle * forms.span()};
}

// The place start + (side / cross) d of a crossing moves by at most span (1 + 4 / sin) for every radian, the sine being
// that of the angle between the segments, and errs by less than 2^-40 span / sin.
Spot spot_of(const TurnEvent& event, const TurningForms& forms, Heading h) {
  Spot spot;
  if (event.high - event.low > kAngle) return spot;
  if (event.kind == TurnEvent::Kind::vertex_on_segment) return {forms.place(event.v, h), 2 * kAngle * forms.span()};
  if (event.kind == TurnEvent::Kind::overlap) return around_common_stretch(event, forms, h);
  if (event.kind != TurnEvent::Kind::three_segments) return spot;
  const EventPlace place = place_of(event, forms, h);
  if (place.sine > 0x1p-10) spot = {place.at, 8 * kAngle * forms.span() / place.sine};
  return spot;
}

}  // namespace

std::vector<ObstacleSweep::Group> ObstacleSweep::clusters(const Group& group) const {
  if (group.size() == 1) return {group};
  std::vector<Spot> spots;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> segments;  // id, event
  bool unsure = false;
  for (std::uint32_t k = 0; k < group.size(); ++k) {
    spots.push_back(spot_of(*group[k], forms_, Heading::of(group[k]->theta())));
    for (const std::uint32_t s : segments_of(*group[k], unsure)) segments.emplace_back(s, k);
  }
  if (unsure) return {group};
  std::sort(segments.begin(), segments.end());
  std::vector<std::uint32_t> root(group.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::uint32_t k) {
    while (root[k] != k) k = root[k] = root[root[k]];
    return k;
  };
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = i + 1; j < segments.size() && segments[j].first == segments[i].first; ++j)
      if (!spots[segments[i].second].apart_from(spots[segments[j].second]))
        root[find(segments[j].second)] = find(segments[i].second);
  std::vector<Group> parts(group.size());
  for (std::uint32_t k = 0; k < group.size(); ++k) parts[find(k)].push_back(group[k]);
  std::erase_if(parts, [](const Group& part) { return part.empty(); });
  return parts;
}

}  // namespace dymsum::planar
