#include "cspace/obstacle/event_clusters.h"

#include <algorithm>

#include "cspace/events/event_position.h"

namespace dymsum::planar {
namespace {

/// Angles of events err by less, or their positions are not computed.
constexpr double kAngle = 0x1p-30;
/// Positions of lines at a smaller sine are not used. They err by less than kCrossing / sine, times the span.
constexpr double kPlacedLeast = 0x1p-10, kCrossing = 0x1p-40;
static_assert(kTurnedSide + kTurnedCross + kTurnedPosition <= kCrossing && kCrossing / kPlacedLeast <= kAngle);

/// A disc that provably holds the position of an event, or the interval along which it changes the boundary; infinite
/// for alignments and where doubles do not decide.
struct Spot {
  Point at;
  double radius = INFINITY;
  bool apart_from(const Spot& o) const { return std::hypot(at.x - o.at.x, at.y - o.at.y) > radius + o.radius; }
};

Spot around_common_interval(const RotationEvent& event, const TurningForms& forms, Heading h) {
  const Point d = forms.direction(event.a, h), e = forms.direction(event.b, h);
  const Point s = forms.position(TurningForms::start(event.a), h), t = forms.position(TurningForms::start(event.b), h);
  const double length = std::hypot(d.x, d.y), from = (d.x * (t.x - s.x) + d.y * (t.y - s.y)) / length;
  const double first = std::max(0.0, from), last = std::min(length, from + std::hypot(e.x, e.y)),
               midpoint = (first + last) / (2 * length);
  return {{s.x + midpoint * d.x, s.y + midpoint * d.y}, std::max(0.0, last - first) / 2 + 4 * kAngle * forms.span()};
}

// The position start + (side / cross) d of a crossing moves by at most span (1 + 4 / sin) for every radian, the sine
// being that of the angle between the segments, and errs by less than 2^-40 span / sin.
Spot spot_of(const RotationEvent& event, const TurningForms& forms, Heading h) {
  Spot spot;
  if (event.high - event.low > kAngle) return spot;
  if (event.kind == RotationEvent::Kind::vertex_on_segment)
    return {forms.position(event.v, h), 2 * kAngle * forms.span()};
  if (event.kind == RotationEvent::Kind::overlap) return around_common_interval(event, forms, h);
  if (event.kind != RotationEvent::Kind::three_segments) return spot;
  const EventPosition position = position_of(event, forms, h);
  if (position.sine > kPlacedLeast) spot = {position.at, 8 * kAngle * forms.span() / position.sine};
  return spot;
}

bool may_exist_near(const RotationCatalog& catalog, const WalkSegment& s, const RotationEvent& event) {
  if (!catalog.may_exist(s)) return false;
  const RotationCatalog::Span span = catalog.span(s, event.theta());
  const double slack = kAngleSlack + (event.high - event.low);
  return span.from <= slack && span.to >= -slack;
}

}  // namespace

std::vector<std::uint32_t> segments_of(const RotationEvent& event, const SweepScene& scene) {
  const TurningForms& forms = scene.forms;
  std::vector<std::uint32_t> found;
  const auto add = [&](const WalkSegment& s) { found.push_back(scene.graph.segments().of(s)); };
  const auto add_at = [&](Pair v) {
    for (std::uint32_t side = 0; side < 2; ++side) {
      const std::uint32_t own = side == 0 ? v.p : v.q, other = side == 0 ? v.q : v.p;
      for (const WalkSegment& s : {WalkSegment{side, own, other}, {side, forms.operand(side).prev[own], other}})
        if (may_exist_near(scene.catalog, s, event)) add(s);
    }
  };
  switch (event.kind) {
    case RotationEvent::Kind::three_segments:
      for (const WalkSegment& s : {event.a, event.b, event.c}) add(s);
      break;
    case RotationEvent::Kind::vertex_on_segment:
      add(event.a);
      add_at(event.v);
      break;
    case RotationEvent::Kind::overlap:
      for (const WalkSegment& s : {event.a, event.b}) {
        add(s);
        add_at(TurningForms::start(s));
        add_at(forms.end(s));
      }
      break;
    case RotationEvent::Kind::alignment: {
      const std::uint32_t e1 = forms.operand(1).next[event.e], f1 = forms.operand(0).next[event.f];
      for (const WalkSegment& s : {WalkSegment{1, event.e, event.f}, WalkSegment{0, event.f, e1},
                                   WalkSegment{0, event.f, event.e}, WalkSegment{1, event.e, f1}})
        add(s);
      break;
    }
  }
  return found;
}

std::vector<EventGroup> clusters(const EventGroup& group, const SweepScene& scene) {
  if (group.size() == 1) return {group};
  std::vector<Spot> spots;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> segments;  // id, event
  for (std::uint32_t k = 0; k < group.size(); ++k) {
    spots.push_back(spot_of(*group[k], scene.forms, Heading::of(group[k]->theta())));
    for (const std::uint32_t s : segments_of(*group[k], scene)) segments.emplace_back(s, k);
  }
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  Partition together(group.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = i + 1; j < segments.size() && segments[j].first == segments[i].first; ++j)
      if (!spots[segments[i].second].apart_from(spots[segments[j].second]))
        together.join(segments[i].second, segments[j].second);
  std::vector<EventGroup> parts(group.size());
  for (std::uint32_t k = 0; k < group.size(); ++k) parts[together.find(k)].push_back(group[k]);
  std::erase_if(parts, [](const EventGroup& part) { return part.empty(); });
  return parts;
}

}  // namespace dymsum::planar
