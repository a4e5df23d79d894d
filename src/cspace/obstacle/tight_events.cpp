#include "cspace/obstacle/tight_events.h"

#include <algorithm>
#include <cmath>

#include "cspace/boundary/free_position.h"
#include "cspace/events/event_signs.h"
#include "cspace/obstacle/tight_curves.h"

namespace dymsum::planar {
namespace {

using Intervals = std::vector<std::array<std::uint32_t, 2>>;

/// Positions that may be tight, and intervals between them.
struct Candidates {
  std::vector<TightCandidate> at;
  Intervals between;
};

// The segments of an overlap and what goes on at an end of one of them.
std::vector<std::uint32_t> through_end(const RotationEvent& event, Pair v, const SweepScene& scene) {
  const SegmentIndex& index = scene.graph.segments();
  std::vector<std::uint32_t> all{index.of(event.a), index.of(event.b)};
  const RotationCatalog::Joint joint = scene.catalog.joint(v, event.theta());
  if (joint.has_in) all.push_back(index.of(joint.in));
  if (joint.has_out) all.push_back(index.of(joint.out));
  return all;
}

// The two of three segments that are least parallel; nothing where all three are: they meet along an interval, and
// other events tell its ends.
std::optional<ExactPosition::Simple> crossing_of(const RotationEvent& event, const SignsAt& signs) {
  const TurningForms& forms = signs.forms();
  const std::array<const WalkSegment*, 3> s{&event.a, &event.b, &event.c};
  std::size_t best = 0;
  double most = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const WalkSegment &a = *s[k], &b = *s[(k + 1) % 3];
    const double sine = std::abs(forms.cross(a, b).at(signs.heading())) / (forms.length1(a) * forms.length1(b));
    if (sine > most) {
      most = sine;
      best = k;
    }
  }
  const WalkSegment &a = *s[best], &b = *s[(best + 1) % 3];
  if (signs.cross(a, b) == 0) return std::nullopt;
  return ExactPosition::Simple{true, {}, a, b};
}

// The positions of events that are not provably covered, each once. Events are a superset: where a segment does not
// exist at the angle, or does not reach the position, that may be anywhere, in free space too.
std::vector<TightCandidate> positions_of(const EventGroup& events, const SweepScene& scene, const SignsAt& signs,
                                         const OverlapFilter& filter) {
  std::vector<TightCandidate> all;
  const auto add = [&](const ExactPosition::Simple& position, const std::vector<WalkSegment>& on,
                       std::vector<std::uint32_t> through) {
    const ExactPosition at{position, {}};
    const std::optional<Point> near = signs.near(at);
    if (!near || filter.inside(*near, signs.heading())) return;
    for (const WalkSegment& s : on)
      if (!exists_at(signs, scene.catalog, s) || !signs.within(s, at, *near)) return;
    all.push_back({at, *near, std::move(through), false});
  };
  for (const RotationEvent* event : events) switch (event->kind) {
      case RotationEvent::Kind::alignment:
        break;
      case RotationEvent::Kind::vertex_on_segment:
        add({false, event->v, {}, {}}, {event->a}, segments_of(*event, scene));
        break;
      case RotationEvent::Kind::overlap:
        for (const WalkSegment* s : {&event->a, &event->b})
          for (const Pair v : {TurningForms::start(*s), scene.forms.end(*s)})
            add({false, v, {}, {}}, {event->a, event->b}, through_end(*event, v, scene));
        break;
      case RotationEvent::Kind::three_segments:
        if (const auto crossing = crossing_of(*event, signs))
          add(*crossing, {event->a, event->b, event->c}, segments_of(*event, scene));
        break;
    }
  return PositionsAtAngle(scene, signs).each_once(std::move(all));
}

// Tight points and intervals of the open slice.
Candidates candidates_in_slice(const Orientation& at, const SignsAt& signs, const SliceReader& reader) {
  const PlanarSum sum = reader.slice(at, Semantics::open);
  Candidates found;
  const auto index = [&](const SumVertex& v) {
    TightCandidate z;
    if (v.corner_p != SumVertex::kNone) z.position.first.corner = reader.corner(v);
    else z.position.first = {true, {}, reader.segment(v.in), reader.segment(v.out)};
    z.near = signs.near(z.position).value();
    std::uint32_t k = 0;
    while (k < found.at.size() && !signs.same(found.at[k].position, z.position)) ++k;
    if (k == found.at.size()) found.at.push_back(std::move(z));
    return k;
  };
  for (const SumVertex& v : sum.tight_points) index(v);
  for (const SumSegment& s : sum.tight_segments) {
    const std::uint32_t from = index(s.from);
    found.between.push_back({from, index(s.to)});
  }
  return found;
}

/// What is held of the candidates, and what of that is an event.
class Judge {
 public:
  Judge(Candidates candidates, const TightCurves& curves, const PositionsAtAngle& positions)
      : positions_(positions), found_(std::move(candidates.at)), between_(std::move(candidates.between)) {
    out_.looked = !found_.empty();
    // Positions that are tight before and after the angle too are events only where that begins and ends.
    goes_on_ = positions.positions_of(common_curves(curves.before, curves.after));
    changes_ = positions.positions_of(other_curves(curves.before, curves.after));
    for (const TightCandidate& z : found_) {
      held_.push_back(!z.visible);
      is_event_.push_back(!z.visible && !goes_on(z));
    }
    on_interval_.resize(found_.size());
  }

  template <class Free>
  TightFindings run(const std::vector<NodeNow>& nodes, const Free& free_between) {
    for (const auto& [y, z] : between_) {
      const std::vector<PositionsAtAngle::PartEnds> parts = positions_.not_reached(nodes, found_[y], found_[z]);
      if (parts.empty() || !free_between(found_[y], found_[z])) continue;
      for (const auto& [from, to] : parts) {
        const TightCandidate begin = end_of_part(from, y);
        out_.held.emplace_back(begin, end_of_part(to, z));
      }
    }
    for (std::size_t k = 0; k < found_.size(); ++k) {
      if (held_[k] && !on_interval_[k]) out_.held.emplace_back(found_[k], found_[k]);
      if (is_event_[k]) out_.events.push_back(found_[k].near);
    }
    for (const TightCandidate& z : changes_)
      if (!goes_on(z)) add_change(z);
    return std::move(out_);
  }

 private:
  bool goes_on(const TightCandidate& z) const {
    return std::any_of(goes_on_.begin(), goes_on_.end(),
                       [&](const TightCandidate& y) { return positions_.same_position(y, z); });
  }
  // The end of a part of an interval, `at` it or where the interval itself ends: an event.
  TightCandidate end_of_part(const std::optional<Point>& at, std::uint32_t k) {
    if (!at) {
      held_[k] = is_event_[k] = on_interval_[k] = true;
      return found_[k];
    }
    out_.events.push_back(*at);
    TightCandidate end;
    end.position.first.crossing = true;  // it errs as crossings do
    end.near = *at;
    return end;
  }
  // A curve begins or ends.
  void add_change(const TightCandidate& z) {
    const auto known = std::find_if(found_.begin(), found_.end(),
                                    [&](const TightCandidate& y) { return positions_.same_position(y, z); });
    const auto k = static_cast<std::size_t>(known - found_.begin());
    if (known == found_.end() || !held_[k]) out_.held.emplace_back(z, z);
    if (known == found_.end() || !is_event_[k]) out_.events.push_back(z.near);
  }

  const PositionsAtAngle& positions_;
  std::vector<TightCandidate> found_, goes_on_, changes_;
  Intervals between_;
  std::vector<bool> held_, is_event_, on_interval_;
  TightFindings out_;
};

void see(std::vector<TightCandidate>& all, const std::vector<NodeNow>& nodes, const PositionsAtAngle& positions) {
  for (TightCandidate& z : all)
    z.visible = std::any_of(nodes.begin(), nodes.end(), [&](const NodeNow& n) { return positions.reaches(n, z); });
}

}  // namespace

TightFindings tight_at_events(const EventGroup& doubtful, const TightCurves& curves, const SweepScene& scene,
                              const AngleNow& now, const OverlapFilter& filter) {
  const SignsAt& signs = now.signs();
  const PositionsAtAngle positions(scene, signs);
  const std::vector<NodeNow> nodes = positions.nodes_now(true);
  Candidates found;
  found.at = positions_of(doubtful, scene, signs, filter);
  see(found.at, nodes, positions);
  std::erase_if(found.at, [&](const TightCandidate& z) { return !z.visible && !is_free(signs, z.position); });
  found.between = positions.opposite_intervals(found.at, now.theta());
  return Judge(std::move(found), curves, positions).run(nodes, [&](const TightCandidate& y, const TightCandidate& z) {
    return is_free(signs, {y.position.first, z.position.first});
  });
}

TightFindings tight_in_slice(const Orientation& at, const TightCurves& curves, const SweepScene& scene,
                             const AngleNow& now, const SliceReader& reader) {
  const PositionsAtAngle positions(scene, now.signs());
  const std::vector<NodeNow> nodes = positions.nodes_now(true);
  Candidates found = candidates_in_slice(at, now.signs(), reader);
  see(found.at, nodes, positions);
  return Judge(std::move(found), curves, positions).run(nodes, [](const TightCandidate&, const TightCandidate&) {
    return true;
  });
}

}  // namespace dymsum::planar
