#include "planar/arrangement/segment_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "base/scratch.h"

namespace dymsum::planar {
namespace {

constexpr double kListed = 8;  // times as many entries as segments, about
constexpr double kMostRows = 1 << 16;

}  // namespace

RayRows::RayRows(const Soup& soup) : soup_(soup) {
  margin_ = 2 * soup.point_error + kSumHeight * soup.lattice.span;
  double high = 0, heights = 0;
  if (soup.size() > 0) low_ = high = soup.boxes[0].ay;
  for (const SoupBox& b : soup.boxes) {
    low_ = std::min({low_, b.ay, b.by});
    high = std::max({high, b.ay, b.by});
    heights += std::abs(b.dy);
  }
  const auto n = static_cast<double>(soup.size());
  const double most = heights > 0 ? (kListed - 1) * n * ((high - low_) / heights) : 1;
  const double rows = std::floor(std::clamp(std::min(most, n), 1.0, kMostRows));
  last_ = rows - 1;
  const double per_row = high > low_ ? rows / (high - low_) : 0;
  per_row_ = std::isfinite(per_row) ? per_row : 0;
  const auto each_row = [&](const SoupBox& b, auto&& f) {
    const std::size_t last = row(std::max(b.ay, b.by) + margin_);
    for (std::size_t r = row(std::min(b.ay, b.by) - margin_); r <= last; ++r) f(r);
  };
  first_.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (const SoupBox& b : soup.boxes) each_row(b, [&](std::size_t r) { ++first_[r + 1]; });
  for (std::size_t r = 0; r + 1 < first_.size(); ++r) first_[r + 1] += first_[r];
  listed_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t s = 0; s < soup.size(); ++s)
    each_row(soup.boxes[s], [&](std::size_t r) { listed_[next[r]++] = s; });
}

SegmentGraph::SegmentGraph(const Soup& soup, Meetings meetings) : soup_(soup), meetings_(std::move(meetings)) {
  build_events();
  find_nodes();
  find_edges();
  find_rays();
}

std::size_t SegmentGraph::bytes() const {
  return meetings_.crossings.capacity() * sizeof(Crossing) + meetings_.touches.capacity() * sizeof(Touch) +
         first_event_.capacity() * 4 + events_.capacity() * sizeof(Event) + nodes_.capacity() * sizeof(Node) +
         sub_edges_.capacity() * sizeof(SubEdge) + edges_.capacity() * sizeof(Edge) + first_ray_.capacity() * 4 +
         rays_.capacity() * sizeof(Ray);
}

SegmentGraph::Stop SegmentGraph::stop(std::uint32_t s, const Event& e) const {
  Stop out;
  out.t = e.t;
  out.error = e.error;
  if (is_touch(e)) {
    out.end.at = touched(e);
    out.cut.pair = soup_.exact(out.end.at);
  } else {
    const Crossing& c = meetings_.crossings[e.ref];
    out.end.pair = false;
    out.end.other = c.a == s ? c.b : c.a;
    out.cut.kind = Cut::Kind::crossing;
    out.cut.by = soup_.exact(out.end.other);
  }
  return out;
}

SegmentGraph::Stop SegmentGraph::end_stop(std::uint32_t s, bool start) const {
  Stop out;
  out.end.at = start ? soup_.start(s) : soup_.end(s);
  out.cut.pair = soup_.exact(out.end.at);
  out.t = start ? 0 : 1;
  return out;
}

SegmentPosition SegmentGraph::position(std::uint32_t s, const Stop& stop) const {
  SegmentPosition p;
  p.on = soup_.exact(s);
  p.first = stop.cut;
  const SoupBox& b = soup_.boxes[s];
  const double dx = soup_.dx(s), dy = soup_.dy(s);
  const bool at_end = stop.t == 1 && stop.error == 0;
  p.x = at_end ? b.bx : b.ax + stop.t * dx;
  p.y = at_end ? b.by : b.ay + stop.t * dy;
  p.error = stop.error == 0 ? soup_.point_error : soup_.step_error(stop.error, dx, dy);
  return p;
}

int SegmentGraph::compare_events(std::uint32_t s, const Event& a, const Event& b) {
  const double gap = a.t - b.t, error = double(a.error) + double(b.error);
  if (gap > error) return 1;
  if (gap < -error) return -1;
  if (a.ref == b.ref) return 0;
  ++exact_orders_;
  return soup_.lattice.compare(soup_.exact(s), stop(s, a).cut, stop(s, b).cut);
}

void SegmentGraph::build_events() {
  const std::size_t n = soup_.size();
  first_event_.assign(n + 1, 0);
  for (const Crossing& c : meetings_.crossings) {
    ++first_event_[c.a + 1];
    ++first_event_[c.b + 1];
  }
  for (const Touch& t : meetings_.touches) ++first_event_[t.segment + 1];
  std::partial_sum(first_event_.begin(), first_event_.end(), first_event_.begin());
  events_.resize(first_event_[n]);
  std::vector<std::uint32_t> at(first_event_.begin(), first_event_.end() - 1);
  std::uint32_t ref = 0;
  for (const Crossing& c : meetings_.crossings) {
    events_[at[c.a]++] = {c.ta, soup_.parameter_error(c.a, c.b), ref};
    events_[at[c.b]++] = {c.tb, soup_.parameter_error(c.b, c.a), ref++};
  }
  for (const Touch& t : meetings_.touches) events_[at[t.segment]++] = {t.t, t.error, ref++};
  for (std::uint32_t s = 0; s < n; ++s)
    std::sort(events_.begin() + first_event_[s], events_.begin() + first_event_[s + 1],
              [&](const Event& a, const Event& b) {
                const int order = compare_events(s, a, b);
                return order != 0 ? order < 0 : a.ref < b.ref;
              });
}

// A node is a class of crossings and pairs of vertices: those at one position of one segment, and pairs known to be at
// one position.
void SegmentGraph::find_nodes() {
  UnionFind classes(static_cast<std::uint32_t>(meetings_.crossings.size()));
  std::unordered_map<std::uint64_t, std::uint32_t> pairs;
  const auto element = [&](WalkPair v) {
    const std::uint64_t key = (std::uint64_t{v.p} << 32) | v.q;
    const auto [it, fresh] = pairs.try_emplace(key, classes.size());
    if (fresh) classes.add();
    return it->second;
  };
  const auto event_element = [&](const Event& e) { return is_touch(e) ? element(touched(e)) : e.ref; };
  for (const auto& [a, b] : meetings_.same) {
    // One after the other: compilers differ in which argument of a call comes first.
    const std::uint32_t of_b = element(b), of_a = element(a);
    classes.unite(of_a, of_b);
  }
  const std::uint32_t n = static_cast<std::uint32_t>(soup_.size());
  for (std::uint32_t s = 0; s < n; ++s)
    for (std::uint32_t k = first_event_[s]; k + 1 < first_event_[s + 1]; ++k)
      if (compare_events(s, events_[k], events_[k + 1]) == 0) {
        const std::uint32_t after = event_element(events_[k + 1]), at = event_element(events_[k]);
        classes.unite(at, after);
      }

  std::unordered_map<std::uint32_t, std::uint32_t> index;  // class -> node
  const auto visit = [&](std::uint32_t s, std::uint32_t e, const Stop& stop) {
    const auto [it, fresh] = index.try_emplace(classes.root(e), static_cast<std::uint32_t>(nodes_.size()));
    if (fresh) nodes_.emplace_back();
    Node& node = nodes_[it->second];
    // A pair of vertices is the better name: it needs no second segment.
    if (fresh || (stop.end.pair && !node.end.pair)) {
      node.end = stop.end;
      node.segment = s;
      node.position = position(s, stop);
    }
    return it->second;
  };
  for (std::uint32_t s = 0; s < n; ++s) {
    SubEdge sub;
    sub.segment = s;
    sub.from = visit(s, element(soup_.start(s)), end_stop(s, true));
    ++nodes_[sub.from].passes;
    const auto advance = [&](std::uint32_t node, std::uint32_t event) {
      if (node == sub.from) return;  // the same position again
      ++nodes_[node].passes;
      sub.to = node;
      sub.to_event = event;
      sub_edges_.push_back(sub);
      sub.from = node;
      sub.from_event = event;
    };
    for (std::uint32_t k = first_event_[s]; k < first_event_[s + 1]; ++k)
      advance(visit(s, event_element(events_[k]), stop(s, events_[k])), k);
    advance(visit(s, element(soup_.end(s)), end_stop(s, false)), kNone);
  }
}

// Segments are straight: sub-edges between the same two nodes coincide.
void SegmentGraph::find_edges() {
  const auto key = [](const SubEdge& s) { return std::pair{std::min(s.from, s.to), std::max(s.from, s.to)}; };
  std::stable_sort(sub_edges_.begin(), sub_edges_.end(),
                   [&](const SubEdge& a, const SubEdge& b) { return key(a) < key(b); });
  for (std::uint32_t i = 0; i < sub_edges_.size();) {
    const auto ends = key(sub_edges_[i]);
    Edge e{ends.first, ends.second, i, i + 1};
    while (e.last < sub_edges_.size() && key(sub_edges_[e.last]) == ends) ++e.last;
    i = e.last;
    edges_.push_back(e);
  }
}

void SegmentGraph::find_rays() {
  first_ray_.assign(nodes_.size() + 1, 0);
  for (const Edge& e : edges_) {
    ++first_ray_[e.low + 1];
    ++first_ray_[e.high + 1];
  }
  std::partial_sum(first_ray_.begin(), first_ray_.end(), first_ray_.begin());
  rays_.resize(2 * edges_.size());
  std::vector<std::uint32_t> at(first_ray_.begin(), first_ray_.end() - 1);
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    rays_[at[edges_[i].low]++] = {i, true};
    rays_[at[edges_[i].high]++] = {i, false};
  }
  for (std::size_t v = 0; v < nodes_.size(); ++v)
    std::sort(rays_.begin() + first_ray_[v], rays_.begin() + first_ray_[v + 1],
              [&](const Ray& a, const Ray& b) { return compare(a, b) < 0; });
}

int SegmentGraph::compare(const Ray& a, const Ray& b) const {
  const auto along = [&](const Ray& r) {
    const Edge& e = edges_[r.edge];
    return forward(e, sub_edges_[e.first]) == r.forward ? 1 : -1;
  };
  const auto segment = [&](const Ray& r) { return sub_edges_[edges_[r.edge].first].segment; };
  const auto half = [&](const Ray& r) {
    return half_plane(along(r) * soup_.dx(segment(r)), along(r) * soup_.dy(segment(r)));
  };
  if (half(a) != half(b)) return half(a) < half(b) ? -1 : 1;
  return -soup_.cross(segment(a), segment(b)) * along(a) * along(b);
}

SegmentPosition SegmentGraph::sample(std::uint32_t edge) const {
  const SubEdge& s = sub_edges_[edges_[edge].first];
  const Stop from = s.from_event == kNone ? end_stop(s.segment, true) : stop(s.segment, events_[s.from_event]);
  const Stop to = s.to_event == kNone ? end_stop(s.segment, false) : stop(s.segment, events_[s.to_event]);
  const SegmentPosition a = position(s.segment, from), b = position(s.segment, to);
  SegmentPosition p = a;
  p.second = to.cut;
  p.between = true;
  p.x = 0.5 * (a.x + b.x);
  p.y = 0.5 * (a.y + b.y);
  // Anywhere between the ends, so half of their distance away, which is rounded; the rest covers the midpoint's
  // roundings.
  constexpr double kHalf = 0.5 * (1 + exact::rounding_bound(3, 4));
  p.error = kHalf * std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)) + 2 * (a.error + b.error) +
            kStepSum * soup_.lattice.span;
  return p;
}

}  // namespace dymsum::planar
