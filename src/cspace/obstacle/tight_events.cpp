// What happens at one angle only: configurations that are free and that no free configurations with clearance come
// near, contacts that can be held but neither reached nor left; and places where the boundary touches itself. Where
// neither is found and no sub-edge began or ended, nothing happens, and the angle is not listed.
//
// A tight place z of the angle is not covered, so at least one segment of the convolution goes through it; one contact,
// two contacts whose lines cross, and the sum of two vertices can be left into free space. So either z is the place of
// an event at which lines cross, or an end of a segment on another one; or a segment passes through z and another one
// in the opposite direction, along a stretch. What is covered changes along that stretch only where a further segment
// comes in, at places that are not covered either. Hence: the places of events, and the stretches between neighbouring
// ones on two opposite segments, tell all, each by one exact test. Near a place that sub-edges before or behind the
// angle come to there is free space with clearance; near any other free place there is none, as it is on the boundary
// of the obstacle.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cspace/boundary/free_place.h"
#include "cspace/boundary/limit_boundary.h"
#include "cspace/obstacle/obstacle_sweep.h"
#include "cspace/obstacle/tight_curves.h"
#include "planar/turning/slice.h"
#include "planar/turning/turn.h"

namespace dymsum::planar {

void ObstacleSweep::examine(const TurnRange& range, const OverlapFilter& filter,
                            const std::vector<AlwaysConcurrent>& curves_behind) {
  const bool listed = now_ != kNobody;
  if (!listed) now_ = angle(range, *doubtful_[0]);
  const SignsAt& signs = signs_now();
  // Behind a whole slice at a rational angle one more slice, at the angle, tells what is tight in it; of a crowded
  // quarter turn there are no events.
  const bool by_slice = listed && exact::rational_value(angles[now_].t);
  std::vector<std::array<std::uint32_t, 2>> between;
  std::vector<Candidate> found = by_slice ? candidates_of_open_slice(signs, between) : candidates(signs, filter);
  const std::vector<NodeNow> nodes = nodes_now(signs, true);
  const auto see = [&] {
    for (Candidate& z : found)
      z.visible = std::any_of(nodes.begin(), nodes.end(), [&](const NodeNow& n) { return reaches(signs, n, z); });
  };
  see();
  if (!by_slice) {
    std::erase_if(found, [&](const Candidate& z) { return !z.visible && !is_free(signs, z.place); });
    between = opposite_stretches(signs, found);
  }
  // Places that are tight before and behind the angle too are events only where that begins and ends.
  const std::vector<Candidate> goes_on = places_of(signs, common_curves(curves_, curves_behind));
  const auto is_one_of = [&](const std::vector<Candidate>& places, const Candidate& z) {
    return std::any_of(places.begin(), places.end(), [&](const Candidate& y) { return same_place(signs, y, z); });
  };
  const std::size_t noted = tight.size();
  std::vector<bool> held, is_event, on_stretch(found.size(), false);
  for (const Candidate& z : found) {
    held.push_back(!z.visible);
    is_event.push_back(!z.visible && !is_one_of(goes_on, z));
  }
  for (const auto& [y, z] : between) {
    if (reached_all_along(signs, nodes, found[y], found[z])) continue;
    if (!by_slice && !is_free(signs, {found[y].place.first, found[z].place.first})) continue;
    held[y] = held[z] = is_event[y] = is_event[z] = on_stretch[y] = on_stretch[z] = true;
    note_tight(found[y], found[z]);
  }
  bool any = false;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (held[k] && !on_stretch[k]) note_tight(found[k], found[k]);
    if (!is_event[k]) continue;
    any = true;
    note(signs.heading(), ObstacleEvent::Kind::tight, found[k].near);
  }
  for (const Candidate& z : places_of(signs, other_curves(curves_, curves_behind))) {
    if (is_one_of(goes_on, z)) continue;
    any = true;
    const auto known =
        std::find_if(found.begin(), found.end(), [&](const Candidate& y) { return same_place(signs, y, z); });
    const auto k = static_cast<std::size_t>(known - found.begin());
    if (known == found.end() || !held[k]) note_tight(z, z);
    if (known == found.end() || !is_event[k]) note(signs.heading(), ObstacleEvent::Kind::tight, z.near);
  }
  std::optional<Point> touch;
  if (sliced_ || !found.empty()) touch = look_at_limits(signs);
  if (any || changed_ || (listed && keeps_all_angles)) return;
  if (listed) events.pop_back();
  if (touch) return note(signs.heading(), ObstacleEvent::Kind::vertex_on_segment, *touch);
  tight.resize(noted);  // of an angle that is not listed
  if (!limit_angles_.empty() && limit_angles_.back() == now_) limit_angles_.pop_back();
  angles.pop_back();
  now_ = kNobody;
}

// Crossings are known within 2^-37 of the span (SignsAt::near), sums of two vertices within 2^-45: they err by the
// angle's 2^-49 and some roundings. What turns places into positions rounds each of four terms.
void ObstacleSweep::note_tight(const Candidate& from, const Candidate& to) {
  const Lattice& l = *base_->lattice;
  const Heading h = signs_now().heading();
  TightFeature feature{now_, position(h, from.near), position(h, to.near), 0};
  const double offsets = std::hypot(l.points[0]->offset.x, l.points[0]->offset.y) +
                         std::hypot(l.points[1]->offset.x, l.points[1]->offset.y);
  const double share = from.place.first.crossing || to.place.first.crossing ? 0x1p-37 : 0x1p-45;
  feature.error = (share + 0x1p-47) * forms_.span() * l.unit + 0x1p-47 * offsets;
  tight.push_back(feature);
}

// The boundary's limits from before and from behind: surfaces, what they gain at the angle, and a place where one of
// the two touches itself.
std::optional<Point> ObstacleSweep::look_at_limits(const SignsAt& signs) {
  std::vector<std::uint32_t> next_before(nodes_.size(), kNobody), number(nodes_.size());
  for (const auto& [n, next] : relinked_)
    if (next_before[n] == kNobody) next_before[n] = next;
  std::optional<Point> touch;
  for (const bool behind : {false, true}) {
    std::vector<std::uint32_t> nodes;
    const auto is_there = [&](std::uint32_t n) { return behind ? nodes_[n].alive : nodes_[n].begin != now_; };
    for (std::uint32_t n = 0; n < nodes_.size(); ++n)
      if (nodes_[n].alive && is_there(n)) nodes.push_back(n);
    for (const std::uint32_t n : ended_)
      if (is_there(n)) nodes.push_back(n);
    for (std::uint32_t k = 0; k < nodes.size(); ++k) number[nodes[k]] = k;
    std::vector<LimitEdge> edges;
    for (const std::uint32_t n : nodes)
      edges.push_back({sub_edge(n), number[behind || next_before[n] == kNobody ? nodes_[n].next : next_before[n]]});
    const BoundaryLimit limit = limit_of(signs, edges);
    for (std::uint32_t k = 0; k < nodes.size(); ++k)
      if (limit.halves[k] != 0) limit_halves_.emplace_back(nodes[k], limit.halves[k]);
    for (const auto& [k, l] : limit.together) join(shell_, nodes[k], nodes[l]);
    if (limit.touch) touch = limit.touch;
  }
  limit_angles_.push_back(now_);
  return touch;
}

// Places of the doubtful events that are not certainly covered, each once.
std::vector<ObstacleSweep::Candidate> ObstacleSweep::candidates(const SignsAt& signs,
                                                                const OverlapFilter& filter) const {
  std::vector<Candidate> all;
  for (const TurnEvent* event : doubtful_) {
    if (event->kind == TurnEvent::Kind::alignment) continue;
    bool unsure = false;
    const auto add = [&](const ExactPlace::Simple& place, std::vector<std::uint32_t> through) {
      const ExactPlace at{place, {}};
      const std::optional<Point> near = signs.near(at);
      if (near && !filter.inside(*near, signs.heading())) all.push_back({at, *near, std::move(through), false});
    };
    if (event->kind == TurnEvent::Kind::vertex_on_segment) {
      add({false, event->v, {}, {}}, segments_of(*event, unsure));
    } else if (event->kind == TurnEvent::Kind::overlap) {
      for (const WalkSegment* s : {&event->a, &event->b})
        for (const Pair v : {TurningForms::start(*s), forms_.end(*s)}) add({false, v, {}, {}}, through_end(*event, v));
    } else {
      // The two that are least parallel; where all three are, they meet along a stretch, and other events tell its
      // ends.
      const std::array<const WalkSegment*, 3> s{&event->a, &event->b, &event->c};
      std::size_t best = 0;
      double most = -1;
      for (std::size_t k = 0; k < 3; ++k) {
        const WalkSegment &a = *s[k], &b = *s[(k + 1) % 3];
        const double sine = std::abs(forms_.cross(a, b).at(signs.heading())) / (forms_.length1(a) * forms_.length1(b));
        if (sine > most) {
          most = sine;
          best = k;
        }
      }
      if (signs.cross(*s[best], *s[(best + 1) % 3]) != 0)
        add({true, {}, *s[best], *s[(best + 1) % 3]}, segments_of(*event, unsure));
    }
  }
  return each_once(signs, std::move(all));
}

// Of an overlap's two segments and what goes on at an end of one of them.
std::vector<std::uint32_t> ObstacleSweep::through_end(const TurnEvent& event, Pair v) const {
  std::vector<std::uint32_t> all{id(event.a), id(event.b)};
  const TurnCatalog::Joint joint = catalog_.joint(v, event.theta());
  if (joint.has_in) all.push_back(id(joint.in));
  if (joint.has_out) all.push_back(id(joint.out));
  return all;
}

// Known to be one place without exact signs where the lines that cross at the one go through the other.
bool ObstacleSweep::same_place(const SignsAt& signs, const Candidate& y, const Candidate& z) const {
  const auto crosses_on = [&](const ExactPlace::Simple& crossing, const Candidate& other) {
    return crossing.crossing && other.goes_through(id(crossing.a)) && other.goes_through(id(crossing.b));
  };
  return crosses_on(y.place.first, z) || crosses_on(z.place.first, y) || signs.same(y.place, z.place);
}

std::vector<ObstacleSweep::Candidate> ObstacleSweep::each_once(const SignsAt& signs, std::vector<Candidate> all) const {
  const double apart = 0x1p-35 * forms_.span();
  std::stable_sort(all.begin(), all.end(), [](const Candidate& y, const Candidate& z) { return y.near.x < z.near.x; });
  std::vector<Candidate> once;
  for (Candidate& z : all) {
    bool known = false;
    for (std::size_t k = once.size(); k-- > 0 && !known;) {
      Candidate& y = once[k];
      if (z.near.x - y.near.x > apart) break;
      if (std::abs(z.near.y - y.near.y) > apart) continue;
      if (!same_place(signs, y, z)) continue;
      known = true;
      y.through.insert(y.through.end(), z.through.begin(), z.through.end());
    }
    if (!known) once.push_back(std::move(z));
  }
  for (Candidate& z : once) {
    std::sort(z.through.begin(), z.through.end());
    z.through.erase(std::unique(z.through.begin(), z.through.end()), z.through.end());
  }
  return once;
}

// At a rational angle: tight places and stretches of the open slice.
std::vector<ObstacleSweep::Candidate> ObstacleSweep::candidates_of_open_slice(
    const SignsAt& signs, std::vector<std::array<std::uint32_t, 2>>& between) const {
  SumOptions options;
  options.semantics = Semantics::open;
  const ExactAngle& at = angles[now_];
  const Result<PlanarSum> sum = sum_at(*base_, orientation_at(at.chart, *exact::rational_value(at.t)), options);
  if (!sum) throw std::logic_error("ObstacleSweep: a slice failed");
  std::vector<Candidate> all;
  const auto number = [&](const SumVertex& v) {
    Candidate z;
    if (v.corner_p != SumVertex::kNone)
      z.place.first.corner = {walk_vertex_[0][v.corner_p], walk_vertex_[1][v.corner_q]};
    else z.place.first = {true, {}, walk_segment(v.in), walk_segment(v.out)};
    z.near = signs.near(z.place).value();
    std::uint32_t k = 0;
    while (k < all.size() && !signs.same(all[k].place, z.place)) ++k;
    if (k == all.size()) all.push_back(std::move(z));
    return k;
  };
  for (const SumVertex& v : sum->tight_points) number(v);
  for (const SumSegment& s : sum->tight_segments) between.push_back({number(s.from), number(s.to)});
  return all;
}

// Neighbouring places along two segments of opposite directions that are there at the angle: of the two sides of a
// polyline with one vertex mostly one is.
std::vector<std::array<std::uint32_t, 2>> ObstacleSweep::opposite_stretches(
    const SignsAt& signs, const std::vector<Candidate>& places) const {
  std::vector<std::array<std::uint32_t, 2>> found;
  const auto exists = [&](std::uint32_t s) {
    return catalog_.exists(segment_of(s), theta_now_) != TurnCatalog::Existence::no;
  };
  const auto holds = [&](std::uint32_t s, const Candidate& z) {
    return z.goes_through(s) ? signs.within(segment_of(s), z.place, z.near)
                             : signs.holds(segment_of(s), z.place, z.near);
  };
  for (std::uint32_t k = 0; k < places.size(); ++k)
    for (const std::uint32_t s : places[k].through)
      for (const std::uint32_t t : places[k].through) {
        if (s >= t || !signs.antiparallel(segment_of(s), segment_of(t)) || !exists(s) || !exists(t) ||
            !holds(s, places[k]) || !holds(t, places[k]))
          continue;
        // The next place on both, in the direction of s.
        std::optional<std::uint32_t> next;
        const auto follows = [&](std::uint32_t l, std::uint32_t m) {
          return signs.order(segment_of(s), places[l].place, places[l].near, places[m].place, places[m].near) > 0;
        };
        for (std::uint32_t l = 0; l < places.size(); ++l)
          if (l != k && holds(s, places[l]) && follows(l, k) && (!next || follows(*next, l))) next = l;
        if (!next || !holds(t, places[*next])) continue;
        const std::array<std::uint32_t, 2> pair{k, *next};
        if (std::find(found.begin(), found.end(), pair) == found.end()) found.push_back(pair);
      }
  return found;
}

// The boundary behind the angle, and before it.
std::vector<ObstacleSweep::NodeNow> ObstacleSweep::nodes_now(const SignsAt& signs, bool before) const {
  std::vector<NodeNow> all;
  const Heading h = signs.heading();
  const auto add = [&](std::uint32_t n) {
    const Node& node = nodes_[n];
    const Point e = forms_.edge(node.segment.side, node.segment.edge);
    const double length2 = e.x * e.x + e.y * e.y;
    const Located from = place_on(forms_, node.segment, segment_of(node.left), true, h),
                  to = place_on(forms_, node.segment, segment_of(node.right), false, h);
    NodeNow now{n, from.t * length2, to.t * length2, 2 * (from.error + to.error) * length2};
    now.error += SignsAt::kNear * forms_.span() * forms_.length1(node.segment);
    if (!std::isfinite(now.error)) now = {n, 0, 0, INFINITY};
    all.push_back(now);
  };
  for (std::uint32_t n = 0; n < nodes_.size(); ++n)
    if (nodes_[n].alive) add(n);
  for (const std::uint32_t n : ended_)
    if (before && nodes_[n].begin != now_) add(n);
  return all;
}

// Whether an end of a sub-edge comes behind z along it (1), is z (0) or comes before it (-1). z is on its line.
int ObstacleSweep::order_of_end(const SignsAt& signs, const NodeNow& n, const Candidate& z, bool at_end) const {
  const Node& node = nodes_[n.node];
  const double d = (at_end ? n.to : n.from) - signs.along_near(node.segment, z.near);
  if (std::abs(d) > n.error) return d > 0 ? 1 : -1;
  const std::uint32_t by = at_end ? node.right : node.left;
  if (z.goes_through(node.id) && z.goes_through(by) && signs.cross(node.segment, segment_of(by)) != 0) return 0;
  const std::optional<Fraction> end = end_along(signs, node.segment, sub_edge(n.node), at_end);
  if (!end) throw std::logic_error("ObstacleSweep: a sub-edge ends nowhere on its line");
  return signs.compare(*end, signs.along(node.segment, z.place));
}

bool ObstacleSweep::on_line(const SignsAt& signs, const NodeNow& n, const Candidate& z) const {
  return z.goes_through(nodes_[n.node].id) || signs.side_sign(nodes_[n.node].segment, z.place, z.near) == 0;
}

// Whether a sub-edge, before or behind the angle, comes to z at the angle.
bool ObstacleSweep::reaches(const SignsAt& signs, const NodeNow& n, const Candidate& z) const {
  const double at = signs.along_near(nodes_[n.node].segment, z.near);
  if (at < n.from - n.error || at > n.to + n.error || !on_line(signs, n, z)) return false;
  return order_of_end(signs, n, z, false) <= 0 && order_of_end(signs, n, z, true) >= 0;
}

// Whether sub-edges together come to the whole stretch from y to z.
bool ObstacleSweep::reached_all_along(const SignsAt& signs, const std::vector<NodeNow>& nodes, const Candidate& y,
                                      const Candidate& z) const {
  std::vector<std::uint32_t> line;
  for (const NodeNow& n : nodes) {
    const double a = signs.along_near(nodes_[n.node].segment, y.near),
                 b = signs.along_near(nodes_[n.node].segment, z.near);
    if (std::max(a, b) < n.from - n.error || std::min(a, b) > n.to + n.error || !on_line(signs, n, y) ||
        !on_line(signs, n, z))
      continue;
    if (reaches(signs, n, y) && reaches(signs, n, z)) return true;
    line.push_back(n.node);
  }
  if (line.empty()) return false;
  const WalkSegment first = nodes_[line[0]].segment;
  std::vector<std::array<Fraction, 2>> parts;
  for (const std::uint32_t n : line) {
    std::optional<Fraction> from = end_along(signs, first, sub_edge(n), false),
                            to = end_along(signs, first, sub_edge(n), true);
    if (!from || !to) throw std::logic_error("ObstacleSweep: a sub-edge ends nowhere on its line");
    if (signs.compare(*to, *from) < 0) std::swap(from, to);
    parts.push_back({*from, *to});
  }
  Fraction at = signs.along(first, y.place), end = signs.along(first, z.place);
  if (signs.compare(end, at) < 0) std::swap(at, end);
  for (bool grown = true; grown && signs.compare(at, end) < 0;) {
    grown = false;
    for (const auto& [from, to] : parts) {
      if (signs.compare(from, at) > 0 || signs.compare(to, at) <= 0) continue;
      at = to;
      grown = true;
    }
  }
  return signs.compare(at, end) >= 0;
}

}  // namespace dymsum::planar
