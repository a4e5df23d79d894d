#include "planar/arrangement.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace dymsum::planar {

// A ray at a node: the sub-edge that leaves or arrives there, by its direction away from the node.
struct Arrangement::Ray {
  double dx, dy;
  std::uint32_t segment, sub;
  bool out;
};

// The events [begin, end) of a segment, all at one parameter.
struct Arrangement::Spot {
  std::uint32_t segment, begin, end;
  friend bool operator==(const Spot&, const Spot&) = default;
};

Arrangement::Arrangement(const Soup& soup, Meetings meetings, const Chain& chain, const Array<DeadMark>& dead_marks)
    : soup_(soup),
      chain_(chain),
      meetings_(std::move(meetings)),
      first_event_(soup.memory),
      events_(soup.memory),
      positions_(soup.memory),
      flags_(soup.memory),
      links_(soup.memory),
      nodes_(soup.memory),
      covered_subs_(soup.memory),
      suspects_(soup.memory) {
  build_events();
  sort_events();
  flags_.assign(sub_count(), 0);
  mark_dead(dead_marks);
  find_degenerate_nodes();
}

std::size_t Arrangement::bytes() const {
  return meetings_.crossings.capacity() * sizeof(Crossing) + meetings_.touches.capacity() * sizeof(Touch) +
         first_event_.capacity() * 4 + events_.capacity() * sizeof(Event) + positions_.capacity() * sizeof(Positions) +
         flags_.capacity();
}

std::uint32_t Arrangement::segment_of(std::uint32_t sub) const {
  // first_sub(s) = first_event_[s] + s increases strictly.
  std::uint32_t low = 0, high = static_cast<std::uint32_t>(soup_.size());
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    (first_sub(middle) <= sub ? low : high) = middle;
  }
  return low;
}

void Arrangement::build_events() {
  const std::size_t n = soup_.size();
  first_event_.assign(n + 1, 0);
  for (const Crossing& c : meetings_.crossings) {
    ++first_event_[c.a + 1];
    ++first_event_[c.b + 1];
  }
  for (const Touch& t : meetings_.touches) ++first_event_[t.segment + 1];
  for (std::size_t s = 0; s < n; ++s) first_event_[s + 1] += first_event_[s];
  events_.resize(first_event_[n]);
  Array<std::uint32_t> at(first_event_.begin(), first_event_.end() - 1, soup_.memory);
  for (std::uint32_t c = 0; c < meetings_.crossings.size(); ++c) {
    const Crossing& x = meetings_.crossings[c];
    events_[at[x.a]++] = {x.ta, x.ea, c};
    events_[at[x.b]++] = {x.tb, x.eb, c};
  }
  for (std::uint32_t k = 0; k < meetings_.touches.size(); ++k) {
    const Touch& t = meetings_.touches[k];
    events_[at[t.segment]++] = {t.t, t.error, k | kTouchBit};
  }
  positions_.resize(meetings_.crossings.size());
}

Cut Arrangement::event_cut(const Event& e, std::uint32_t s) const {
  Cut cut;
  if (e.ref & kTouchBit) {
    cut.pair = soup_.exact(meetings_.touches[e.ref & ~kTouchBit].pair);
  } else {
    const Crossing& c = meetings_.crossings[e.ref];
    cut.kind = Cut::Kind::crossing;
    cut.by = soup_.exact(c.a == s ? c.b : c.a);
  }
  return cut;
}

int Arrangement::compare_events(std::uint32_t s, const Event& a, const Event& b) const {
  const double gap = a.t - b.t, error = double(a.error) + double(b.error);
  if (gap > error) return 1;
  if (gap < -error) return -1;
  if (a.ref == b.ref) return 0;
  ++exact_orders_;
  return soup_.lattice.compare(soup_.exact(s), event_cut(a, s), event_cut(b, s));
}

// By parameter first. Only where neighbours are closer than their errors, by exact comparison; those are remembered.
void Arrangement::sort_events() {
  constexpr std::uint32_t kInsertion = 24;
  const auto by_parameter = [](const Event& a, const Event& b) { return a.t < b.t; };
  const auto insertion = [](Event* first, std::uint32_t n, auto&& less) {
    for (std::uint32_t i = 1; i < n; ++i) {
      const Event e = first[i];
      std::uint32_t j = i;
      for (; j > 0 && less(e, first[j - 1]); --j) first[j] = first[j - 1];
      first[j] = e;
    }
  };
  for (std::uint32_t s = 0; s < soup_.size(); ++s) {
    Event* first = events_.data() + first_event_[s];
    const std::uint32_t n = event_count(s);
    if (n == 0) continue;
    if (n > kInsertion)
      std::sort(first, first + n, by_parameter);
    else
      insertion(first, n, by_parameter);
    bool close = false, touched = (first[0].ref & kTouchBit) != 0;
    for (std::uint32_t i = 1; i < n; ++i) {
      close |= !(first[i].t - first[i - 1].t > double(first[i].error) + double(first[i - 1].error));
      touched |= (first[i].ref & kTouchBit) != 0;
    }
    if (close) {
      const auto exactly = [&](const Event& a, const Event& b) { return compare_events(s, a, b) < 0; };
      if (n > kInsertion)
        std::sort(first, first + n, exactly);
      else
        insertion(first, n, exactly);
    }
    if (close || touched) suspects_.push_back(s);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (first[i].ref & kTouchBit) continue;
      Positions& p = positions_[first[i].ref];
      (is_a(first[i], s) ? p.a : p.b) = i;
    }
  }
}

// A mark near an event may fall on either side of it: both sub-edges are dead then, so either answer is right.
void Arrangement::mark_dead(const Array<DeadMark>& marks) {
  for (const DeadMark& m : marks) {
    const Event* first = events_.data() + first_event_[m.segment];
    const Event* last = first + event_count(m.segment);
    const auto k = std::partition_point(first, last, [&](const Event& e) { return e.t < m.t; }) - first;
    flags_[first_sub(m.segment) + k] |= kDead;
  }
}

std::pair<std::uint32_t, std::uint32_t> Arrangement::equal_run(std::uint32_t s, std::uint32_t k) const {
  const Event* first = events_.data() + first_event_[s];
  std::uint32_t begin = k, end = k + 1;
  while (begin > 0 && compare_events(s, first[begin - 1], first[k]) == 0) --begin;
  while (end < event_count(s) && compare_events(s, first[end], first[k]) == 0) ++end;
  return {begin, end};
}

// Places where crossings coincide, or segments end on others, are classes of crossings and pairs of vertices.
void Arrangement::find_degenerate_nodes() {
  std::pmr::unordered_map<std::uint64_t, std::uint32_t> index(soup_.memory);  // element -> dense number
  Array<std::uint64_t> elements(soup_.memory);
  Array<std::uint32_t> parent(soup_.memory);
  constexpr std::uint64_t kPair = std::uint64_t{1} << 63;
  const auto element = [&](std::uint64_t key) {
    const auto [it, fresh] = index.try_emplace(key, static_cast<std::uint32_t>(elements.size()));
    if (fresh) {
      elements.push_back(key);
      parent.push_back(it->second);
    }
    return it->second;
  };
  const auto pair_key = [&](WalkPair v) { return kPair | (std::uint64_t{v.p} << 31) | v.q; };
  const auto event_key = [&](const Event& e) {
    return e.ref & kTouchBit ? pair_key(meetings_.touches[e.ref & ~kTouchBit].pair) : std::uint64_t{e.ref};
  };
  const auto find = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto unite = [&](std::uint32_t i, std::uint32_t j) { parent[find(i)] = find(j); };

  for (const auto& [a, b] : meetings_.same) unite(element(pair_key(a)), element(pair_key(b)));
  struct Touched {
    std::uint32_t element;
    Spot spot;
  };
  Array<Touched> spots(soup_.memory);
  for (const std::uint32_t s : suspects_) {
    const Event* first = events_.data() + first_event_[s];
    const std::uint32_t n = event_count(s);
    for (std::uint32_t k = 0; k < n;) {
      std::uint32_t end = k + 1;
      while (end < n && compare_events(s, first[k], first[end]) == 0) ++end;
      bool degenerate = end - k > 1;
      for (std::uint32_t i = k; i < end; ++i) degenerate |= (first[i].ref & kTouchBit) != 0;
      if (degenerate) {
        const std::uint32_t e = element(event_key(first[k]));
        for (std::uint32_t i = k + 1; i < end; ++i) unite(e, element(event_key(first[i])));
        spots.push_back({e, {s, k, end}});
      }
      k = end;
    }
  }
  if (elements.empty()) return;
  // A crossing of a class has two segments; one of them may meet nothing else there.
  for (std::uint32_t e = 0; e < elements.size(); ++e) {
    if (elements[e] & kPair) continue;
    const std::uint32_t c = static_cast<std::uint32_t>(elements[e]);
    const Crossing& x = meetings_.crossings[c];
    for (const auto& [s, k] : {std::pair{x.a, positions_[c].a}, std::pair{x.b, positions_[c].b}}) {
      const auto [begin, end] = equal_run(s, k);
      spots.push_back({e, {s, begin, end}});
    }
  }
  Array<std::pair<std::uint32_t, std::uint32_t>> pair_elements(soup_.memory);  // class, element
  for (std::uint32_t e = 0; e < elements.size(); ++e)
    if (elements[e] & kPair) pair_elements.emplace_back(find(e), e);
  for (Touched& t : spots) t.element = find(t.element);
  std::sort(pair_elements.begin(), pair_elements.end());
  std::sort(spots.begin(), spots.end(), [](const Touched& a, const Touched& b) {
    return std::tie(a.element, a.spot.segment, a.spot.begin) < std::tie(b.element, b.spot.segment, b.spot.begin);
  });
  Array<Spot> node(soup_.memory);
  Array<WalkPair> pairs(soup_.memory);
  std::size_t i = 0, j = 0;
  while (i < spots.size() || j < pair_elements.size()) {
    const std::uint32_t root = std::min(i < spots.size() ? spots[i].element : kNone,
                                        j < pair_elements.size() ? pair_elements[j].first : kNone);
    node.clear();
    pairs.clear();
    for (; i < spots.size() && spots[i].element == root; ++i)
      if (node.empty() || !(node.back() == spots[i].spot)) node.push_back(spots[i].spot);
    for (; j < pair_elements.size() && pair_elements[j].first == root; ++j) {
      const std::uint64_t key = elements[pair_elements[j].second] & ~kPair;
      pairs.push_back({static_cast<std::uint32_t>(key >> 31), static_cast<std::uint32_t>(key & 0x7fffffff)});
    }
    process_node(node, pairs);
  }
}

void Arrangement::process_node(const Array<Spot>& spots, const Array<WalkPair>& pairs) {
  ++degenerate_nodes_;
  Array<Ray> rays(soup_.memory);
  const auto add = [&](std::uint32_t s, std::uint32_t k, bool out) {
    const double sign = out ? 1 : -1;
    const std::uint32_t sub = first_sub(s) + k;
    rays.push_back({sign * soup_.dx(s), sign * soup_.dy(s), s, sub, out});
    flags_[sub] |= out ? kDegenerateStart : kDegenerateEnd;
  };
  Node where;
  where.number = static_cast<std::uint32_t>(degenerate_nodes_);
  bool placed = false;
  for (const Spot& spot : spots) {
    const Event& e = events_[first_event_[spot.segment] + spot.begin];
    if (!placed) {
      where.segment = spot.segment;
      where.end = event_end(e, spot.segment);
      where.place = place(spot.segment, event_cut(e, spot.segment), e.t, e.error);
    }
    placed = true;
    // Between events at one place there is nothing.
    for (std::uint32_t k = spot.begin + 1; k < spot.end; ++k) flags_[first_sub(spot.segment) + k] |= kDead;
    add(spot.segment, spot.begin, false);
    add(spot.segment, spot.end, true);
  }
  Array<Incidence> incident(soup_.memory);
  for (const WalkPair& v : pairs) {
    incident.clear();
    chain_.incident(v, incident);
    for (const Incidence& at : incident) {
      if (!placed) {
        Cut cut;
        cut.pair = soup_.exact(v);
        where.segment = at.segment;
        where.end = {true, v, 0};
        where.place = place(at.segment, cut, at.starts ? 0 : 1, 0);
      }
      placed = true;
      add(at.segment, at.starts ? 0 : event_count(at.segment), at.starts);
    }
  }
  if (placed) link_rays(rays, where);
}

// A sector between two neighbouring rays is free unless the ray before it leaves with it on its left, or the ray behind it arrives
// with it on its left. The boundary of a free sector comes in on the first and goes out on the second.
void Arrangement::link_rays(Array<Ray>& rays, const Node& where) {
  const auto half = [](const Ray& r) { return r.dy > 0 || (r.dy == 0 && r.dx > 0) ? 0 : 1; };
  const auto compare = [&](const Ray& a, const Ray& b) {
    if (half(a) != half(b)) return half(a) < half(b) ? -1 : 1;
    const int c = soup_.cross(a.segment, b.segment);
    return a.out == b.out ? -c : c;
  };
  std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) {
    const int c = compare(a, b);
    return c != 0 ? c < 0 : std::tie(a.segment, a.sub) < std::tie(b.segment, b.sub);
  });
  struct Group {
    std::size_t begin, end;
    bool left = false, right = false;  // covered on the ray's left (something leaves), right (something arrives)
  };
  Array<Group> groups(soup_.memory);
  for (std::size_t i = 0; i < rays.size();) {
    Group g{i, i + 1};
    while (g.end < rays.size() && compare(rays[i], rays[g.end]) == 0) ++g.end;
    for (std::size_t k = g.begin; k < g.end; ++k) (rays[k].out ? g.left : g.right) = true;
    groups.push_back(g);
    i = g.end;
  }
  nodes_.push_back(where);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Group &from = groups[g], &to = groups[(g + 1) % groups.size()];
    if (from.left && from.right) {
      // Covered from both sides: a crack, unless inside M. Each is seen from both ends; keep the one that leaves upwards.
      for (std::size_t k = from.begin; k < from.end; ++k)
        if (rays[k].out) {
          if (half(rays[k]) == 0) covered_subs_.push_back({rays[k].sub, rays[k].segment});
          break;
        }
    }
    if (from.left || to.right) continue;
    const Step step{rays[to.begin].sub, rays[to.begin].segment};
    flags_[step.sub] |= kEntered;
    const Link link{step, where.number};
    for (std::size_t k = from.begin; k < from.end; ++k) links_[rays[k].sub] = link;
  }
}

bool Arrangement::alive_at_start(Step at) const {
  const std::uint8_t f = flags_[at.sub];
  if (f & kDead) return false;
  if (f & kDegenerateStart) return f & kEntered;
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k == 0) return true;
  const Crossing& c = meetings_.crossings[events_[first_event_[at.segment] + k - 1].ref];
  return (c.a == at.segment ? c.sign : -c.sign) > 0;
}

Arrangement::Step Arrangement::successor(Step from) const {
  const std::uint8_t f = flags_[from.sub];
  if (f & kDead) return {};
  if (f & kDegenerateEnd) {
    const auto it = links_.find(from.sub);
    return it == links_.end() ? Step{} : it->second.to;
  }
  const std::uint32_t k = from.sub - first_sub(from.segment);
  if (k == event_count(from.segment)) {
    const std::uint32_t next = chain_.next(from.segment);
    if (next == kNone) return {};
    const std::uint32_t sub = first_sub(next);
    return flags_[sub] & kDead ? Step{} : Step{sub, next};
  }
  const Event& e = events_[first_event_[from.segment] + k];
  const Crossing& c = meetings_.crossings[e.ref];
  const bool a = c.a == from.segment;
  if ((a ? c.sign : -c.sign) > 0) return {};
  const std::uint32_t other = a ? c.b : c.a;
  const std::uint32_t sub = first_sub(other) + (a ? positions_[e.ref].b : positions_[e.ref].a) + 1;
  return flags_[sub] & kDead ? Step{} : Step{sub, other};
}

std::uint32_t Arrangement::end_node(Step at) const {
  if (!(flags_[at.sub] & kDegenerateEnd)) return kNone;
  const auto it = links_.find(at.sub);
  return it == links_.end() ? kNone : it->second.node;
}

SubEnd Arrangement::event_end(const Event& e, std::uint32_t s) const {
  if (e.ref & kTouchBit) return {true, meetings_.touches[e.ref & ~kTouchBit].pair, 0};
  const Crossing& c = meetings_.crossings[e.ref];
  return {false, {}, c.a == s ? c.b : c.a};
}

SubEnd Arrangement::start_of(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k > 0) return event_end(events_[first_event_[at.segment] + k - 1], at.segment);
  return {true, soup_.start(at.segment), 0};
}

SubEnd Arrangement::end_of(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k < event_count(at.segment)) return event_end(events_[first_event_[at.segment] + k], at.segment);
  return {true, soup_.end(at.segment), 0};
}

Place Arrangement::start_place(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k == 0) return place(at.segment, start_cut(at), 0, 0);
  const Event& e = events_[first_event_[at.segment] + k - 1];
  return place(at.segment, event_cut(e, at.segment), e.t, e.error);
}

Place Arrangement::end_place(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k == event_count(at.segment)) return place(at.segment, end_cut(at), 1, 0);
  const Event& e = events_[first_event_[at.segment] + k];
  return place(at.segment, event_cut(e, at.segment), e.t, e.error);
}

// As place() does.
Arrangement::RoundedEnd Arrangement::rounded_end(Step at) const {
  const std::uint32_t s = at.segment, k = at.sub - first_sub(s);
  const SoupBox& b = soup_.boxes[s];
  if (k == event_count(s)) return {b.bx, b.by, soup_.point_error};
  const Event& e = events_[first_event_[s] + k];
  const double dx = soup_.dx(s), dy = soup_.dy(s);
  return {b.ax + e.t * dx, b.ay + e.t * dy, step_error(e.error, dx, dy)};
}

// The start, the step (t's own error, its rounding and the direction's) and the final sum.
double Arrangement::step_error(double t_error, double dx, double dy) const {
  return 2 * soup_.point_error + (t_error + 0x1p-51) * std::max(std::abs(dx), std::abs(dy)) + 0x1p-52 * soup_.lattice.span;
}

Cut Arrangement::start_cut(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k > 0) return event_cut(events_[first_event_[at.segment] + k - 1], at.segment);
  Cut cut;
  cut.pair = soup_.exact(soup_.start(at.segment));
  return cut;
}

Cut Arrangement::end_cut(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k < event_count(at.segment)) return event_cut(events_[first_event_[at.segment] + k], at.segment);
  Cut cut;
  cut.pair = soup_.exact(soup_.end(at.segment));
  return cut;
}

double Arrangement::start_parameter(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  return k > 0 ? events_[first_event_[at.segment] + k - 1].t : 0;
}

double Arrangement::end_parameter(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  return k < event_count(at.segment) ? events_[first_event_[at.segment] + k].t : 1;
}

Place Arrangement::place(std::uint32_t s, const Cut& cut, double t, double t_error) const {
  Place p;
  p.on = soup_.exact(s);
  p.first = cut;
  const SoupBox& b = soup_.boxes[s];
  const double dx = soup_.dx(s), dy = soup_.dy(s);
  p.x = t == 1 ? b.bx : b.ax + t * dx;
  p.y = t == 1 ? b.by : b.ay + t * dy;
  p.error = t == 0 || t == 1 ? soup_.point_error : step_error(t_error, dx, dy);
  return p;
}

// |denominator| of a cut's parameter as the lattice takes it, for the mediant.
double Arrangement::denominator(std::uint32_t s, const Cut& cut, double& relative_error) const {
  const double dx = soup_.dx(s), dy = soup_.dy(s);
  relative_error = 0x1p-50;  // three roundings
  if (cut.kind == Cut::Kind::pair) return dx != 0 ? std::abs(dx) : std::abs(dy);
  const Point b = soup_.lattice.vector(cut.by.edge);
  const double u = dx * b.y, v = dy * b.x, d = std::abs(u - v);
  relative_error = d > 0 ? std::min(1.0, 0x1p-49 * (std::abs(u) + std::abs(v)) / d) : 1.0;
  // In the integers of the exact layer, against which the other kind of cut is measured once less.
  return d * soup_.lattice.integers_per_unit;
}

Place Arrangement::sample(Step at) const {
  const Cut from = start_cut(at), to = end_cut(at);
  double error_from = 0, error_to = 0;
  const double d0 = denominator(at.segment, from, error_from), d1 = denominator(at.segment, to, error_to);
  const double t0 = start_parameter(at), t1 = end_parameter(at);
  double weight = d0 + d1 > 0 ? d1 / (d0 + d1) : 0.5;
  if (!(weight >= 0 && weight <= 1)) {
    weight = 0.5;
    error_from = 1;  // beyond the doubles: anywhere on the sub-edge
  }
  const std::uint32_t k = at.sub - first_sub(at.segment);
  const Event* first = events_.data() + first_event_[at.segment];
  const double e0 = k > 0 ? first[k - 1].error : 0.0, e1 = k < event_count(at.segment) ? first[k].error : 0.0;
  const double t = t0 + weight * (t1 - t0);
  const double error = e0 + e1 + std::abs(t1 - t0) * 2 * (error_from + error_to) + 0x1p-50;
  Place p = place(at.segment, from, t == 0 || t == 1 ? 0.5 : t, error + (t == 0 || t == 1 ? 0.5 : 0));
  p.second = to;
  p.between = true;
  return p;
}

}  // namespace dymsum::planar
