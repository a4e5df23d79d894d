// What happens at one angle only: configurations that are free and that no free configurations with clearance come near, contacts that
// can be held but neither reached nor left; and places where the boundary touches itself. Where neither is found and no sub-edge began or
// ended, nothing happens, and the angle is not listed.
//
// A tight place z of the angle is not covered, so at least one segment of the convolution goes through it; one contact, two contacts
// whose lines cross, and the sum of two vertices can be left into free space. So either z is the place of an event at which lines cross,
// or an end of a segment on another one; or a segment passes through z and another one in the opposite direction, along a stretch. What
// is covered changes along that stretch only where a further segment comes in, at places that are not covered either. Hence: the places
// of events, and the stretches between neighbouring ones on two opposite segments, tell all, each by one exact test. Near a place that
// sub-edges before or behind the angle come to there is free space with clearance; near any other free place there is none, as it is on
// the boundary of the obstacle.
#include <algorithm>
#include <stdexcept>

#include "planar/rotation/free_place.h"
#include "planar/rotation/obstacle_sweep.h"
#include "planar/rotation/slice.h"
#include "planar/rotation/turn.h"

namespace dymsum::planar {

void ObstacleSweep::examine(const TurnRange& range, OverlapFilter& filter) {
  const bool listed = now_ != kNobody;
  if (!listed) now_ = angle(range, *doubtful_[0]);
  const SignsAt signs(forms_, angles[now_]);
  // Behind a whole slice at a rational angle one more slice, at the angle, tells what is tight in it; of a crowded quarter turn there are
  // no events.
  const bool by_slice = listed && exact::rational_value(angles[now_].t);
  std::vector<std::array<std::uint32_t, 2>> between;
  std::vector<Candidate> found = by_slice ? candidates_of_open_slice(signs, between) : candidates(signs, filter);
  const std::vector<std::uint32_t> nodes = nodes_now();
  const auto see = [&] {
    for (Candidate& z : found) z.visible = std::any_of(nodes.begin(), nodes.end(), [&](std::uint32_t n) { return reaches(signs, n, z); });
  };
  see();
  if (!by_slice) {
    std::erase_if(found, [&](const Candidate& z) { return !z.visible && !is_free(signs, z.place); });
    between = open_stretches(signs, found);
  }
  std::vector<bool> tight;
  for (const Candidate& z : found) tight.push_back(!z.visible);
  for (const auto& [y, z] : between)
    if (!reached_all_along(signs, nodes, found[y], found[z])) tight[y] = tight[z] = true;
  bool any = false;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (!tight[k]) continue;
    any = true;
    note(signs.heading(), ObstacleEvent::Kind::tight, drawn(signs, found[k].place));
  }
  // What touches at a crowded quarter turn is not looked for.
  if (any || changed_ || (listed && (keeps_all_angles || crowded_ != nullptr))) return;
  if (by_slice) {
    found = candidates(signs, filter);
    see();
  }
  const auto touching = std::find_if(found.begin(), found.end(), [&](const Candidate& z) { return listed && passes(signs, nodes, z) > 1; });
  if (touching != found.end()) {
    events.pop_back();
    note(signs.heading(), ObstacleEvent::Kind::vertex_on_segment, drawn(signs, touching->place));
    return;
  }
  if (listed) events.pop_back();
  angles.pop_back();
  now_ = kNobody;
}

Point ObstacleSweep::drawn(const SignsAt& signs, const ExactPlace& z) const {
  if (const std::optional<Point> near = signs.near(z)) return *near;
  const WalkSegment &a = z.first.a, &b = z.first.b;
  const Heading h = signs.heading();
  const double t = std::clamp(forms_.side(b, TurningForms::start(a)).at(h) / forms_.cross(a, b).at(h), 0.0, 1.0);
  const Point from = forms_.place(TurningForms::start(a), h), d = forms_.direction(a, h);
  return {from.x + t * d.x, from.y + t * d.y};
}

// Places of the doubtful events that are not certainly covered, each once.
std::vector<ObstacleSweep::Candidate> ObstacleSweep::candidates(const SignsAt& signs, const OverlapFilter& filter) const {
  std::vector<Candidate> all;
  for (const TurnEvent* event : doubtful_) {
    if (event->kind == TurnEvent::Kind::alignment) continue;
    bool unsure = false;
    const std::vector<std::uint32_t> through = segments_of(*event, unsure);
    const auto add = [&](const ExactPlace::Simple& place) {
      Candidate z{{place, {}}, {}, through, false};
      z.near = signs.near(z.place);
      if (!z.near || !filter.inside(*z.near, signs.heading())) all.push_back(std::move(z));
    };
    if (event->kind == TurnEvent::Kind::vertex_on_segment) {
      add({false, event->v, {}, {}});
    } else if (event->kind == TurnEvent::Kind::overlap) {
      for (const WalkSegment* s : {&event->a, &event->b})
        for (const Pair v : {TurningForms::start(*s), forms_.end(*s)}) add({false, v, {}, {}});
    } else {
      // The two that are least parallel; where all three are, they meet along a stretch, and other events tell its ends.
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
      if (signs.cross(*s[best], *s[(best + 1) % 3]) != 0) add({true, {}, *s[best], *s[(best + 1) % 3]});
    }
  }
  return each_once(signs, std::move(all));
}

std::vector<ObstacleSweep::Candidate> ObstacleSweep::each_once(const SignsAt& signs, std::vector<Candidate> all) const {
  // Those with doubles by x; one at a place that doubles do not tell is compared with all.
  const double apart = 0x1p-35 * forms_.span();
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& y, const Candidate& z) { return y.near && (!z.near || y.near->x < z.near->x); });
  std::vector<Candidate> once;
  for (Candidate& z : all) {
    bool known = false;
    for (std::size_t k = once.size(); k-- > 0 && !known;) {
      Candidate& y = once[k];
      if (z.near && y.near && z.near->x - y.near->x > apart) break;
      if (z.near && y.near && std::abs(z.near->y - y.near->y) > apart) continue;
      if (!signs.same(y.place, z.place)) continue;
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
std::vector<ObstacleSweep::Candidate> ObstacleSweep::candidates_of_open_slice(const SignsAt& signs,
                                                                              std::vector<std::array<std::uint32_t, 2>>& between) const {
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
    else
      z.place.first = {true, {}, walk_segment(v.in), walk_segment(v.out)};
    z.near = signs.near(z.place);
    std::uint32_t k = 0;
    while (k < all.size() && !signs.same(all[k].place, z.place)) ++k;
    if (k == all.size()) all.push_back(std::move(z));
    return k;
  };
  for (const SumVertex& v : sum->tight_points) number(v);
  for (const SumSegment& s : sum->tight_segments) between.push_back({number(s.from), number(s.to)});
  return all;
}

// Pairs of free places with nothing but free ones between them, along two segments of opposite directions.
std::vector<std::array<std::uint32_t, 2>> ObstacleSweep::open_stretches(const SignsAt& signs, const std::vector<Candidate>& places) const {
  struct Opposite {
    std::uint32_t place = 0;
    WalkSegment s, t;
  };
  std::vector<Opposite> opposite;
  const auto holds = [&](const WalkSegment& s, const Candidate& z) { return signs.holds(s, z.place, z.near); };
  for (std::uint32_t k = 0; k < places.size(); ++k)
    for (const std::uint32_t s : places[k].through)
      for (const std::uint32_t t : places[k].through) {
        const WalkSegment a = segment_of(s), b = segment_of(t);
        if (s < t && signs.antiparallel(a, b) && holds(a, places[k]) && holds(b, places[k])) opposite.push_back({k, a, b});
      }
  std::vector<std::array<std::uint32_t, 2>> found;
  for (const Opposite& o : opposite) {
    // The next place on both, in the direction of s.
    std::optional<std::uint32_t> next;
    const Fraction from = signs.along(o.s, places[o.place].place);
    for (std::uint32_t k = 0; k < places.size(); ++k) {
      if (k == o.place || !holds(o.s, places[k])) continue;
      const Fraction at = signs.along(o.s, places[k].place);
      if (signs.compare(at, from) > 0 && (!next || signs.compare(at, signs.along(o.s, places[*next].place)) < 0)) next = k;
    }
    if (!next || !holds(o.t, places[*next])) continue;
    const std::array<std::uint32_t, 2> pair{o.place, *next};
    if (std::find(found.begin(), found.end(), pair) != found.end()) continue;
    if (is_free(signs, {places[pair[0]].place.first, places[pair[1]].place.first})) found.push_back(pair);
  }
  return found;
}

// The boundary before and behind the angle.
std::vector<std::uint32_t> ObstacleSweep::nodes_now() const {
  std::vector<std::uint32_t> all;
  for (std::uint32_t n = 0; n < nodes_.size(); ++n)
    if (nodes_[n].alive) all.push_back(n);
  for (const std::uint32_t n : ended_)
    if (nodes_[n].begin != now_) all.push_back(n);
  return all;
}

// Whether a sub-edge, before or behind the angle, comes to z at the angle.
bool ObstacleSweep::reaches(const SignsAt& signs, std::uint32_t n, const Candidate& z) const {
  const WalkSegment& s = nodes_[n].segment;
  if (!signs.holds(s, z.place, z.near)) return false;
  const Fraction at = signs.along(s, z.place);
  const std::optional<Fraction> from = place_along(s, n, false), to = place_along(s, n, true);
  if (!from || !to) throw std::logic_error("ObstacleSweep: a sub-edge ends nowhere on its line");
  return compare_now(*from, at) <= 0 && compare_now(at, *to) <= 0;
}

// Whether sub-edges together come to the whole stretch from y to z.
bool ObstacleSweep::reached_all_along(const SignsAt& signs, const std::vector<std::uint32_t>& nodes, const Candidate& y,
                                      const Candidate& z) const {
  std::vector<std::uint32_t> on_line;
  for (const std::uint32_t n : nodes)
    if (signs.side_sign(nodes_[n].segment, y.place, y.near) == 0 && signs.side_sign(nodes_[n].segment, z.place, z.near) == 0)
      on_line.push_back(n);
  if (on_line.empty()) return false;
  const WalkSegment line = nodes_[on_line[0]].segment;
  Fraction at = signs.along(line, y.place), end = signs.along(line, z.place);
  if (compare_now(end, at) < 0) std::swap(at, end);
  for (bool grown = true; grown && compare_now(at, end) < 0;) {
    grown = false;
    for (const std::uint32_t n : on_line) {
      std::optional<Fraction> from = place_along(line, n, false), to = place_along(line, n, true);
      if (!from || !to) throw std::logic_error("ObstacleSweep: a sub-edge ends nowhere on its line");
      if (compare_now(*to, *from) < 0) std::swap(from, to);
      if (compare_now(*from, at) > 0 || compare_now(*to, at) <= 0) continue;
      at = *to;
      grown = true;
    }
  }
  return compare_now(at, end) >= 0;
}

// How often the boundary passes z, where it is the same before and behind the angle.
int ObstacleSweep::passes(const SignsAt& signs, const std::vector<std::uint32_t>& nodes, const Candidate& z) const {
  int halves = 0;
  for (const std::uint32_t n : nodes) {
    if (!reaches(signs, n, z)) continue;
    const Fraction at = signs.along(nodes_[n].segment, z.place);
    const bool starts = compare_now(*place_along(nodes_[n].segment, n, false), at) == 0;
    const bool ends = compare_now(*place_along(nodes_[n].segment, n, true), at) == 0;
    halves += starts || ends ? starts + ends : 2;
  }
  return halves / 2;
}

}  // namespace dymsum::planar
