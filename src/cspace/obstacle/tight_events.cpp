#include "cspace/obstacle/tight_events.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <tuple>

#include "cspace/boundary/free_position.h"
#include "cspace/events/exact_position.h"
#include "exact/rounding_bound.h"
#include "planar/motion/orientation.h"

namespace dymsum::planar {

// Known to be one position without exact signs where the lines that cross at the one go through the other.
bool PositionsAtAngle::same_position(const TightCandidate& y, const TightCandidate& z) const {
  const auto crosses_on = [&](const ExactPosition::Simple& crossing, const TightCandidate& other) {
    return crossing.crossing && other.goes_through(segments_.of(crossing.a)) &&
           other.goes_through(segments_.of(crossing.b));
  };
  return crosses_on(y.position.first, z) || crosses_on(z.position.first, y) || signs_.same(y.position, z.position);
}

std::vector<TightCandidate> PositionsAtAngle::each_once(std::vector<TightCandidate> all) const {
  const double apart = SignsAt::kNear * forms_.span();
  std::stable_sort(all.begin(), all.end(),
                   [](const TightCandidate& y, const TightCandidate& z) { return y.near.x < z.near.x; });
  std::vector<TightCandidate> once;
  for (TightCandidate& z : all) {
    bool known = false;
    for (std::size_t k = once.size(); k-- > 0 && !known;) {
      TightCandidate& y = once[k];
      if (z.near.x - y.near.x > apart) break;
      if (std::abs(z.near.y - y.near.y) > apart) continue;
      if (!same_position(y, z)) continue;
      known = true;
      y.through.insert(y.through.end(), z.through.begin(), z.through.end());
    }
    if (!known) once.push_back(std::move(z));
  }
  for (TightCandidate& z : once) {
    std::sort(z.through.begin(), z.through.end());
    z.through.erase(std::unique(z.through.begin(), z.through.end()), z.through.end());
  }
  return once;
}

std::vector<std::array<std::uint32_t, 2>> PositionsAtAngle::opposite_intervals(
    const std::vector<TightCandidate>& positions, double theta) const {
  std::vector<std::array<std::uint32_t, 2>> found;
  const auto exists = [&](std::uint32_t s) {
    return catalog_.exists(segments_.segment(s), theta) != RotationCatalog::Existence::no;
  };
  const auto holds = [&](std::uint32_t s, const TightCandidate& z) {
    return z.goes_through(s) ? signs_.within(segments_.segment(s), z.position, z.near)
                             : signs_.holds(segments_.segment(s), z.position, z.near);
  };
  for (std::uint32_t k = 0; k < positions.size(); ++k)
    for (const std::uint32_t s : positions[k].through)
      for (const std::uint32_t t : positions[k].through) {
        if (s >= t || !signs_.antiparallel(segments_.segment(s), segments_.segment(t)) || !exists(s) || !exists(t) ||
            !holds(s, positions[k]) || !holds(t, positions[k]))
          continue;
        // The next place on both, in the direction of s.
        std::optional<std::uint32_t> next;
        const auto follows = [&](std::uint32_t l, std::uint32_t m) {
          return signs_.order(segments_.segment(s), positions[l].position, positions[l].near, positions[m].position,
                              positions[m].near) > 0;
        };
        for (std::uint32_t l = 0; l < positions.size(); ++l)
          if (l != k && holds(s, positions[l]) && follows(l, k) && (!next || follows(*next, l))) next = l;
        if (!next || !holds(t, positions[*next])) continue;
        const std::array<std::uint32_t, 2> pair{k, *next};
        if (std::find(found.begin(), found.end(), pair) == found.end()) found.push_back(pair);
      }
  return found;
}

std::vector<NodeNow> PositionsAtAngle::nodes_now(bool before) const {
  std::vector<NodeNow> all;
  const Heading h = signs_.heading();
  const auto add = [&](std::uint32_t n) {
    const BoundaryGraph::Node& node = graph_[n];
    const Point e = forms_.edge(node.segment.side, node.segment.edge);
    const double length2 = e.x * e.x + e.y * e.y;
    const Located from = position_on(forms_, node.segment, segments_.segment(node.left), true, h),
                  to = position_on(forms_, node.segment, segments_.segment(node.right), false, h);
    NodeNow now{n, from.t * length2, to.t * length2, 2 * (from.error + to.error) * length2};
    now.error += SignsAt::kNear * forms_.span() * forms_.length1(node.segment);
    if (!std::isfinite(now.error)) now = {n, 0, 0, INFINITY};
    all.push_back(now);
  };
  for (const std::uint32_t n : graph_.alive()) add(n);
  for (const std::uint32_t n : graph_.ended())
    if (before && graph_[n].begin != graph_.angle()) add(n);
  return all;
}

// Whether an end of a sub-edge comes after z along it (1), is z (0) or comes before it (-1). z is on its line.
int PositionsAtAngle::order_of_end(const NodeNow& n, const TightCandidate& z, bool at_end) const {
  const BoundaryGraph::Node& node = graph_[n.node];
  const double d = (at_end ? n.to : n.from) - signs_.along_near(node.segment, z.near);
  if (std::abs(d) > n.error) return d > 0 ? 1 : -1;
  const std::uint32_t by = at_end ? node.right : node.left;
  if (z.goes_through(node.id) && z.goes_through(by) && signs_.cross(node.segment, segments_.segment(by)) != 0) return 0;
  const std::optional<Fraction> end = end_along(signs_, node.segment, graph_.sub_edge(n.node), at_end);
  if (!end) throw std::logic_error("PlacesAtAngle: a sub-edge ends nowhere on its line");
  return signs_.compare(*end, signs_.along(node.segment, z.position));
}

bool PositionsAtAngle::on_line(const NodeNow& n, const TightCandidate& z) const {
  return z.goes_through(graph_[n.node].id) || signs_.side_sign(graph_[n.node].segment, z.position, z.near) == 0;
}

bool PositionsAtAngle::reaches(const NodeNow& n, const TightCandidate& z) const {
  const double at = signs_.along_near(graph_[n.node].segment, z.near);
  if (at < n.from - n.error || at > n.to + n.error || !on_line(n, z)) return false;
  return order_of_end(n, z, false) <= 0 && order_of_end(n, z, true) >= 0;
}

std::array<Fraction, 2> PositionsAtAngle::limit_along(const WalkSegment& line, std::uint32_t node) const {
  std::optional<Fraction> from = end_along(signs_, line, graph_.sub_edge(node), false),
                          to = end_along(signs_, line, graph_.sub_edge(node), true);
  if (!from || !to) throw std::logic_error("PlacesAtAngle: a sub-edge ends nowhere on its line");
  if (signs_.compare(*to, *from) < 0) std::swap(from, to);
  return {*from, *to};
}

Point PositionsAtAngle::point_on(const WalkSegment& line, const Fraction& along) const {
  const double t = signs_.quotient(along.num, product(along.den, signs_.length(line).num));
  const Point from = forms_.position(TurningForms::start(line), signs_.heading()),
              d = forms_.direction(line, signs_.heading());
  return {from.x + t * d.x, from.y + t * d.y};
}

// Limits are closed: what is left out between two of them is longer than nothing.
std::vector<PositionsAtAngle::PartEnds> PositionsAtAngle::not_reached(const std::vector<NodeNow>& nodes,
                                                                      const TightCandidate& y,
                                                                      const TightCandidate& z) const {
  std::vector<std::uint32_t> line;
  for (const NodeNow& n : nodes) {
    const double a = signs_.along_near(graph_[n.node].segment, y.near),
                 b = signs_.along_near(graph_[n.node].segment, z.near);
    if (std::max(a, b) < n.from - n.error || std::min(a, b) > n.to + n.error || !on_line(n, y) || !on_line(n, z))
      continue;
    if (reaches(n, y) && reaches(n, z)) return {};
    line.push_back(n.node);
  }
  if (line.empty()) return {{}};
  const WalkSegment first = graph_[line[0]].segment;
  std::vector<std::array<Fraction, 2>> limits;
  for (const std::uint32_t n : line) limits.push_back(limit_along(first, n));
  std::stable_sort(limits.begin(), limits.end(),
                   [&](const auto& a, const auto& b) { return signs_.compare(a[0], b[0]) < 0; });
  Fraction at = signs_.along(first, y.position), end = signs_.along(first, z.position);
  const bool turned = signs_.compare(end, at) < 0;
  if (turned) std::swap(at, end);
  std::vector<PartEnds> parts;
  std::optional<Point> from;
  for (const auto& [low, high] : limits) {
    if (signs_.compare(low, end) >= 0 || signs_.compare(at, end) >= 0) break;
    if (signs_.compare(high, at) <= 0) continue;
    if (signs_.compare(low, at) > 0) parts.push_back({from, point_on(first, low)});
    at = high;
    from = point_on(first, high);
  }
  if (signs_.compare(at, end) < 0) parts.push_back({from, std::nullopt});
  if (turned)
    for (PartEnds& part : parts) std::swap(part[0], part[1]);
  return parts;
}

std::optional<TightCandidate> PositionsAtAngle::meeting_of(const AlwaysConcurrent& three) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const WalkSegment &a = three[k], &b = three[(k + 1) % 3], &c = three[(k + 2) % 3];
    if (signs_.cross(a, b) == 0) continue;
    const ExactPosition at{{true, {}, a, b}, {}};
    const std::optional<Point> near = signs_.near(at);
    if (!near) return std::nullopt;
    for (const WalkSegment& s : {a, b, c})
      if (!signs_.within(s, at, *near)) return std::nullopt;
    return TightCandidate{at, *near, {segments_.of(a), segments_.of(b), segments_.of(c)}, false};
  }
  return std::nullopt;
}

std::vector<TightCandidate> PositionsAtAngle::positions_of(const std::vector<AlwaysConcurrent>& curves) const {
  std::vector<TightCandidate> all;
  for (const AlwaysConcurrent& three : curves)
    if (std::optional<TightCandidate> z = meeting_of(three)) all.push_back(std::move(*z));
  return each_once(std::move(all));
}

// Three contacts that stay at one point z at every angle are no event. Each covers what lies to its left near z, so
// where their directions span the plane with positive weights z has no free space beside it: free or covered, z changes
// only at events of another segment or of an end of the three, all of which are listed. Between two events one exact
// test therefore determines whether z is free, hence tight, unless it is an end of one of them, beside which free space
// comes to it: then the boundary passes there.

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
