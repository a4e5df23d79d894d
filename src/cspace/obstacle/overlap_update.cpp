// Where two segments with one direction pass over each other: along the stretch that they share the boundary changes
// from one to the other, and at the ends of that stretch it turns into the next or the previous segment of a chain.
#include <algorithm>
#include <map>

#include "cspace/obstacle/obstacle_sweep.h"

namespace dymsum::planar {

// Visible sub-edges along the common line, put together where only a vanishing piece of a chain is between them. In
// units of a's direction from a's start.
std::vector<ObstacleSweep::Stretch> ObstacleSweep::stretches(const WalkSegment& a, const WalkSegment& b,
                                                             Heading h) const {
  const Point d = forms_.direction(a, h), origin = forms_.place(TurningForms::start(a), h);
  const double length = std::hypot(d.x, d.y);
  std::vector<Stretch> found;
  for (const WalkSegment* s : {&a, &b})
    for (std::uint32_t n = first_[id(*s)]; n != kNobody; n = nodes_[n].same) {
      const Point e = forms_.direction(*s, h), from = forms_.place(TurningForms::start(*s), h);
      const double base = (d.x * (from.x - origin.x) + d.y * (from.y - origin.y)) / length, own = std::hypot(e.x, e.y);
      Stretch stretch;
      stretch.nodes = {n};
      const Located first = place_on(forms_, *s, nodes_[nodes_[n].prev].segment, true, h),
                    last = place_on(forms_, *s, nodes_[nodes_[n].next].segment, false, h);
      stretch.from = base + own * first.t;
      stretch.to = base + own * last.t;
      stretch.error = own * (first.error + last.error);
      found.push_back(stretch);
    }
  const std::uint32_t ia = id(a), ib = id(b);
  const auto follows = [&](const Stretch& s, const Stretch& t) {
    const std::uint32_t between = nodes_[s.nodes.back()].next;
    if (nodes_[between].next != t.nodes.front()) return false;
    return (nodes_[s.nodes.back()].id == ia && nodes_[t.nodes.front()].id == ib) ||
           (nodes_[s.nodes.back()].id == ib && nodes_[t.nodes.front()].id == ia);
  };
  for (bool joined = true; joined;) {
    joined = false;
    for (std::size_t k = 0; k < found.size() && !joined; ++k)
      for (std::size_t l = 0; l < found.size() && !joined; ++l) {
        if (k == l || !follows(found[k], found[l])) continue;
        found[k].nodes.push_back(nodes_[found[k].nodes.back()].next);
        found[k].nodes.insert(found[k].nodes.end(), found[l].nodes.begin(), found[l].nodes.end());
        found[k].to = found[l].to;
        found[k].error += found[l].error;
        found.erase(found.begin() + static_cast<std::ptrdiff_t>(l));
        joined = true;
      }
  }
  return found;
}

// Behind the event the boundary runs along the outer segment where that reaches and along the inner one elsewhere. From
// the inner to the outer one leads the segment before the outer one in its chain, back leads the one behind it.
bool ObstacleSweep::overlap_update(TurnEvent& event, const TurnRange& range) {
  if (first_[id(event.a)] == kNobody && first_[id(event.b)] == kNobody) return true;
  const double theta = event.theta();
  const Heading h = Heading::of(theta);
  const auto exists = [&](const WalkSegment& s) { return catalog_.exists(s, theta) == TurnCatalog::Existence::yes; };
  if (!event.root->changes_sign() || !exists(event.a) || !exists(event.b)) return false;
  const double slope = forms_.side(event.a, TurningForms::start(event.b)).slope(h);
  if (std::abs(slope) <= 4096 * forms_.side_error(event.a)) return false;
  const WalkSegment &outer = slope < 0 ? event.b : event.a, &inner = slope < 0 ? event.a : event.b;
  const Point d = forms_.direction(event.a, h), origin = forms_.place(TurningForms::start(event.a), h);
  const double length = std::hypot(d.x, d.y), unsure = 1e-9 * (length + forms_.length1(event.b));
  const auto at = [&](Pair v) {
    const Point p = forms_.place(v, h);
    return (d.x * (p.x - origin.x) + d.y * (p.y - origin.y)) / length;
  };
  const Pair start = TurningForms::start(outer), end = forms_.end(outer);
  const double low = at(start), high = at(end);
  const TurnCatalog::Joint before = catalog_.joint(start, theta), behind = catalog_.joint(end, theta);
  if (before.unsure || behind.unsure) return false;
  std::map<std::uint32_t, std::uint32_t> starts, ends;
  std::vector<std::uint32_t> touched, old;
  std::vector<std::pair<const Stretch*, std::vector<WalkSegment>>> changes;
  const std::vector<Stretch> found = stretches(event.a, event.b, h);
  for (const Stretch& s : found) {
    const bool from_start = forms_.end(nodes_[nodes_[s.nodes.front()].prev].segment) == start;
    const bool to_end = TurningForms::start(nodes_[nodes_[s.nodes.back()].next].segment) == end;
    const double near = unsure + s.error;
    for (const double v : {low, high})
      if ((!(from_start && v == low) && !(std::abs(s.from - v) > near)) ||
          (!(to_end && v == high) && !(std::abs(s.to - v) > near)))
        return false;
    std::vector<WalkSegment> segments;
    if (!from_start && s.from < low) {
      segments.push_back(inner);
      if (s.to > low) {
        if (!before.has_in) return false;
        segments.push_back(before.in);
      }
    }
    if ((from_start || s.from < high) && (to_end || s.to > low)) segments.push_back(outer);
    if (!to_end && s.to > high) {
      if (from_start || s.from < high) {
        if (!behind.has_out) return false;
        segments.push_back(behind.out);
      }
      segments.push_back(inner);
    }
    if (segments.empty()) return false;
    bool same = segments.size() == s.nodes.size();
    for (std::size_t k = 0; same && k < segments.size(); ++k) same = id(segments[k]) == nodes_[s.nodes[k]].id;
    if (!same) changes.emplace_back(&s, std::move(segments));
  }
  if (changes.empty() || trying_) return true;
  now_ = angle(range, event);
  note(h, ObstacleEvent::Kind::vertex_on_segment, forms_.place(start, h));
  ++work.local_updates;
  for (const auto& [s, segments] : changes) {
    replace(s->nodes, segments, starts, ends, touched);
    old.insert(old.end(), s->nodes.begin(), s->nodes.end());
  }
  relink(starts, ends, touched);
  for (const std::uint32_t n : old) end_node(n);
  refresh(touched);
  return true;
}

// New nodes along `segments` in place of old ones that follow each other, with the start of the first and the end of
// the last.
void ObstacleSweep::replace(const std::vector<std::uint32_t>& old, const std::vector<WalkSegment>& segments,
                            std::map<std::uint32_t, std::uint32_t>& starts,
                            std::map<std::uint32_t, std::uint32_t>& ends, std::vector<std::uint32_t>& touched) {
  std::uint32_t last = kNobody;
  for (const WalkSegment& s : segments) {
    const std::uint32_t n = add_node(s, nodes_[old.front()].cell);
    if (last == kNobody) {
      starts[old.front()] = n;
      join(shell_, old.front(), n);
    } else {
      link(last, n);
    }
    touched.push_back(n);
    last = n;
  }
  ends[old.back()] = last;
}

}  // namespace dymsum::planar
