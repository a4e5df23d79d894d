// Configurations that are free at one angle only: contacts that can be held, but neither reached nor left.
#include "planar/collision.h"
#include "planar/rotation/obstacle_sweep.h"
#include "planar/rotation/slice.h"
#include "planar/rotation/turn.h"

namespace dymsum::planar {

// Nothing is visible at the event on either side of it. At a rational tangent the exact open slice tells; elsewhere
// doubles do, where every pair of edges is clearly apart except those that meet in the event's own contacts.
void ObstacleSweep::note_tight(TurnEvent& event, const TurnRange& range, Point at, Heading h, const OverlapFilter& filter) {
  if (exact::rational_value(exact_root(event, forms_, range))) return note_tight_slice(event, range);
  std::vector<WalkSegment> contacts{event.a};
  if (event.kind == TurnEvent::Kind::three_segments) {
    contacts.push_back(event.b);
    contacts.push_back(event.c);
  } else {
    const TurnCatalog::Joint joint = catalog_.joint(event.v, event.theta());
    if (joint.has_in) contacts.push_back(joint.in);
    if (joint.has_out) contacts.push_back(joint.out);
  }
  if (!filter.touches_only(at, h, contacts)) return;
  now_ = angle(range, event);
  note(event, ObstacleEvent::Kind::tight, at);
}

void ObstacleSweep::note_tight_slice(TurnEvent& event, const TurnRange& range) {
  const std::optional<exact::BigRational> t = exact::rational_value(exact_root(event, forms_, range));
  if (!t) return;
  SumOptions options;
  options.semantics = Semantics::open;
  const Result<PlanarSum> sum = sum_at(*base_, orientation_at(range.chart, *t), options);
  if (!sum) throw std::logic_error("ObstacleSweep: a slice failed");
  const auto add = [&](Point at) {
    now_ = angle(range, event);
    ObstacleEvent noted;
    noted.kind = ObstacleEvent::Kind::tight;
    noted.angle = now_;
    noted.at = at;
    events.push_back(noted);
  };
  for (const SumVertex& v : sum->tight_points) add(v.at);
  for (const SumSegment& s : sum->tight_segments) {
    add(s.from.at);
    add(s.to.at);
  }
}

}  // namespace dymsum::planar
