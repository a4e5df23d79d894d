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

// Rays of one direction: [begin, end) of the sorted rays.
struct Arrangement::Group {
  std::size_t begin, end;
  bool left = false, right = false;  // covered on the ray's left (something leaves), right (something arrives)
};

// What one node after another needs.
struct Arrangement::NodeBuffers {
  explicit NodeBuffers(Scratch* memory) : rays(memory), incident(memory), groups(memory) {
    rays.reserve(16);
    incident.reserve(8);
    groups.reserve(16);
  }
  Array<Ray> rays;
  Array<Incidence> incident;
  Array<Group> groups;
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
      sub_after_(soup.memory),
      flags_(soup.memory),
      linked_subs_(soup.memory),
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

void Arrangement::build_events() {
  const std::size_t n = soup_.size();
  first_event_.assign(n + 1, 0);
  if (meetings_.crossings.empty() && meetings_.touches.empty()) return;
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
    events_[at[x.a]++] = c;
    events_[at[x.b]++] = c;
  }
  for (std::uint32_t k = 0; k < meetings_.touches.size(); ++k)
    events_[at[meetings_.touches[k].segment]++] = k | kTouchBit;
  sub_after_.resize(meetings_.crossings.size());
}

// Where on s an event is.
std::uint32_t Arrangement::position(std::uint32_t s, std::uint32_t event) const {
  const auto first = events_.begin() + first_event_[s];
  return static_cast<std::uint32_t>(std::find(first, first + event_count(s), event) - first);
}

Cut Arrangement::event_cut(std::uint32_t s, std::uint32_t event) const {
  Cut cut;
  if (event & kTouchBit) {
    cut.pair = soup_.exact(meetings_.touches[event & ~kTouchBit].pair);
  } else {
    cut.kind = Cut::Kind::crossing;
    cut.by = soup_.exact(other(s, event));
  }
  return cut;
}

int Arrangement::compare_events(std::uint32_t s, std::uint32_t a, std::uint32_t b) const {
  if (a == b) return 0;
  const double gap = parameter(s, a) - parameter(s, b), error = parameter_error(s, a) + parameter_error(s, b);
  if (gap > error) return 1;
  if (gap < -error) return -1;
  ++exact_orders_;
  return soup_.lattice.compare(soup_.exact(s), event_cut(s, a), event_cut(s, b));
}

// By parameter first. Only where neighbours are closer than their errors, by exact comparison; those are remembered.
void Arrangement::sort_events() {
  if (events_.empty()) return;
  constexpr std::uint32_t kInsertion = 24;
  const auto sort = [](auto* first, std::uint32_t n, auto&& less) {
    if (n > kInsertion) return std::sort(first, first + n, less);
    for (std::uint32_t i = 1; i < n; ++i) {
      const auto e = first[i];
      std::uint32_t j = i;
      for (; j > 0 && less(e, first[j - 1]); --j) first[j] = first[j - 1];
      first[j] = e;
    }
  };
  struct Timed {
    double t;
    std::uint32_t event;
  };
  Array<Timed> buffer(soup_.memory);
  // Then neighbours farther apart than twice that need no closer look.
  const bool fine = !meetings_.rough && meetings_.touches.empty();
  const Crossing* const crossings = meetings_.crossings.data();
  const auto segments = static_cast<std::uint32_t>(soup_.size());
  for (std::uint32_t s = 0, begin = 0, end = 0; s < segments; ++s, begin = end) {
    end = first_event_[s + 1];
    const std::uint32_t n = end - begin;
    if (n == 0) continue;
    std::uint32_t* const first = events_.data() + begin;
    std::uint32_t kinds = first[0];
    bool close = false;
    if (n > 1) {
      if (buffer.size() < n) buffer.resize(2 * n);
      Timed* const timed = buffer.data();
      for (std::uint32_t i = 0; i < n; ++i) timed[i] = {parameter(s, first[i]), first[i]};
      sort(timed, n, [](const Timed& a, const Timed& b) { return a.t < b.t; });
      for (std::uint32_t i = 0; i < n; ++i) kinds |= first[i] = timed[i].event;
      for (std::uint32_t i = 1; i < n; ++i) {
        const double gap = timed[i].t - timed[i - 1].t;
        if (gap > 2 * Meetings::kFine && fine) continue;
        close |= !(gap > parameter_error(s, first[i - 1]) + parameter_error(s, first[i]));
      }
      if (close) sort(first, n, [&](std::uint32_t a, std::uint32_t b) { return compare_events(s, a, b) < 0; });
    }
    if (close || (kinds & kTouchBit)) suspects_.push_back(s);
    for (std::uint32_t i = 0, sub = begin + s + 1; i < n; ++i, ++sub)
      if (!(first[i] & kTouchBit) && crossings[first[i]].a == s) sub_after_[first[i]] = sub;
  }
}

// A mark near an event may fall on either side of it: both sub-edges are dead then, so either answer is right.
void Arrangement::mark_dead(const Array<DeadMark>& marks) {
  for (const DeadMark& m : marks) {
    const std::uint32_t* first = events_.data() + first_event_[m.segment];
    const std::uint32_t* last = first + event_count(m.segment);
    const auto before = [&](std::uint32_t e) { return parameter(m.segment, e) < m.t; };
    const auto k = std::partition_point(first, last, before) - first;
    flags_[first_sub(m.segment) + k] |= kDead;
  }
}

std::pair<std::uint32_t, std::uint32_t> Arrangement::equal_run(std::uint32_t s, std::uint32_t k) const {
  const std::uint32_t* first = events_.data() + first_event_[s];
  std::uint32_t begin = k, end = k + 1;
  while (begin > 0 && compare_events(s, first[begin - 1], first[k]) == 0) --begin;
  while (end < event_count(s) && compare_events(s, first[end], first[k]) == 0) ++end;
  return {begin, end};
}

// Places where crossings coincide, or segments end on others, are classes of crossings and pairs of vertices.
void Arrangement::find_degenerate_nodes() {
  KeyNumbers index(soup_.memory);
  const Array<std::uint64_t>& elements = index.keys();
  Array<std::uint32_t> parent(soup_.memory);
  constexpr std::uint64_t kPair = std::uint64_t{1} << 63;
  const auto element = [&](std::uint64_t key) {
    const auto [number, fresh] = index.add(key);
    if (fresh) parent.push_back(number);
    return number;
  };
  const auto pair_key = [&](WalkPair v) { return kPair | (std::uint64_t{v.p} << 31) | v.q; };
  const auto event_key = [&](std::uint32_t e) {
    return e & kTouchBit ? pair_key(meetings_.touches[e & ~kTouchBit].pair) : std::uint64_t{e};
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
    const std::uint32_t* first = events_.data() + first_event_[s];
    const std::uint32_t n = event_count(s);
    for (std::uint32_t k = 0; k < n;) {
      std::uint32_t end = k + 1;
      while (end < n && compare_events(s, first[k], first[end]) == 0) ++end;
      bool degenerate = end - k > 1;
      for (std::uint32_t i = k; i < end; ++i) degenerate |= (first[i] & kTouchBit) != 0;
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
    for (const std::uint32_t s : {x.a, x.b}) {
      const auto [begin, end] = equal_run(s, position(s, c));
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
  NodeBuffers buffers(soup_.memory);
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
    process_node(node, pairs, buffers);
  }
}

void Arrangement::process_node(const Array<Spot>& spots, const Array<WalkPair>& pairs, NodeBuffers& buffers) {
  ++degenerate_nodes_;
  Array<Ray>& rays = buffers.rays;
  rays.clear();
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
    if (!placed) {
      where.segment = spot.segment;
      where.end = event_end(spot.segment, event(spot.segment, spot.begin));
      where.sub_after = first_sub(spot.segment) + spot.begin + 1;
    }
    placed = true;
    // Between events at one place there is nothing.
    for (std::uint32_t k = spot.begin + 1; k < spot.end; ++k) flags_[first_sub(spot.segment) + k] |= kDead;
    add(spot.segment, spot.begin, false);
    add(spot.segment, spot.end, true);
  }
  Array<Incidence>& incident = buffers.incident;
  for (const WalkPair& v : pairs) {
    incident.clear();
    chain_.incident(v, incident);
    for (const Incidence& at : incident) {
      if (!placed) {
        where.segment = at.segment;
        where.end = {true, v, 0};
        where.sub_after = at.starts ? first_sub(at.segment) : first_sub(at.segment + 1);
      }
      placed = true;
      add(at.segment, at.starts ? 0 : event_count(at.segment), at.starts);
    }
  }
  if (placed) link_rays(buffers, where);
}

// A sector between two neighbouring rays is free unless the ray before it leaves with it on its left, or the ray behind it arrives
// with it on its left. The boundary of a free sector comes in on the first and goes out on the second.
void Arrangement::link_rays(NodeBuffers& buffers, const Node& where) {
  Array<Ray>& rays = buffers.rays;
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
  Array<Group>& groups = buffers.groups;
  groups.clear();
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
    for (std::size_t k = from.begin; k < from.end; ++k) {
      const auto [number, fresh] = linked_subs_.add(rays[k].sub);
      if (fresh)
        links_.push_back(link);
      else
        links_[number] = link;
    }
  }
}

// The successor at a degenerate end.
Arrangement::Step Arrangement::linked(Step from) const {
  if (flags_[from.sub] & kDead) return {};
  const std::uint32_t link = linked_subs_.find(from.sub);
  return link == KeyNumbers::kMissing ? Step{} : links_[link].to;
}

std::uint32_t Arrangement::linked_node(Step at) const {
  const std::uint32_t link = linked_subs_.find(at.sub);
  return link == KeyNumbers::kMissing ? kNone : links_[link].node;
}

Place Arrangement::event_place(std::uint32_t s, std::uint32_t event) const {
  return place(s, event_cut(s, event), parameter(s, event), parameter_error(s, event));
}

Place Arrangement::place_of(const Node& node) const {
  const std::uint32_t s = node.segment, k = node.sub_after - first_sub(s);
  if (k > 0 && k <= event_count(s)) return event_place(s, event(s, k - 1));
  Cut cut;
  cut.pair = soup_.exact(node.end.at);
  return place(s, cut, k == 0 ? 0 : 1, 0);
}

Place Arrangement::start_place(Step at) const {
  const std::uint32_t s = at.segment, k = at.sub - first_sub(s);
  return k == 0 ? place(s, start_cut(at), 0, 0) : event_place(s, event(s, k - 1));
}

Place Arrangement::end_place(Step at) const {
  const std::uint32_t s = at.segment, k = at.sub - first_sub(s);
  return k == event_count(s) ? place(s, end_cut(at), 1, 0) : event_place(s, event(s, k));
}

Cut Arrangement::start_cut(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k > 0) return event_cut(at.segment, event(at.segment, k - 1));
  Cut cut;
  cut.pair = soup_.exact(soup_.start(at.segment));
  return cut;
}

Cut Arrangement::end_cut(Step at) const {
  const std::uint32_t k = at.sub - first_sub(at.segment);
  if (k < event_count(at.segment)) return event_cut(at.segment, event(at.segment, k));
  Cut cut;
  cut.pair = soup_.exact(soup_.end(at.segment));
  return cut;
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

std::optional<double> Arrangement::inner_parameter(Step at) const {
  const std::uint32_t s = at.segment, k = at.sub - first_sub(s);
  const double t0 = start_parameter(at), t1 = end_parameter(at);
  const double e0 = k > 0 ? parameter_error(s, event(s, k - 1)) : 0;
  const double e1 = k < event_count(s) ? parameter_error(s, event(s, k)) : 0;
  const double middle = 0.5 * (t0 + t1);
  if (!(middle - t0 > e0 + 0x1p-50 && t1 - middle > e1 + 0x1p-50)) return std::nullopt;
  return middle;
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
  const std::uint32_t* first = events_.data() + first_event_[at.segment];
  const double e0 = k > 0 ? parameter_error(at.segment, first[k - 1]) : 0.0;
  const double e1 = k < event_count(at.segment) ? parameter_error(at.segment, first[k]) : 0.0;
  const double t = t0 + weight * (t1 - t0);
  const double error = e0 + e1 + std::abs(t1 - t0) * 2 * (error_from + error_to) + 0x1p-50;
  Place p = place(at.segment, from, t == 0 || t == 1 ? 0.5 : t, error + (t == 0 || t == 1 ? 0.5 : 0));
  p.second = to;
  p.between = true;
  return p;
}

}  // namespace dymsum::planar
