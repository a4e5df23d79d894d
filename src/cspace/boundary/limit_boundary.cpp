#include "cspace/boundary/limit_boundary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "base/scratch.h"
#include "planar/window/rotating_window.h"

namespace dymsum::planar {
namespace {

constexpr std::uint32_t kNone = kNobody;

[[noreturn]] void not_a_boundary(const char* why) { throw std::logic_error(std::string("limit_of: ") + why); }

/// Ends that err by more than this fraction of the span are taken from exact quotients.
constexpr double kKnownEnd = 0x1p-39;

/// A way along the boundary through a position: in along one sub-edge and out along another one, or along one that
/// passes the position.
struct Visit {
  std::uint32_t in = 0, out = 0;
};
/// One of the two directions in which a visit leaves its position.
struct Germ {
  std::uint32_t edge = 0;
  int sign = 1;             ///< 1 along the boundary, -1 backwards
  std::uint32_t visit = 0;  ///< of the position
};

class Limit {
 public:
  Limit(const SignsAt& signs, const std::vector<LimitEdge>& edges)
      : signs_(signs),
        forms_(signs.forms()),
        edges_(edges),
        near_(2 * SignsAt::kNear * forms_.span()),
        own_(edges.size()) {
    out_.halves.assign(edges.size(), 0);
  }

  BoundaryLimit run() {
    for (std::uint32_t i = 0; i < edges_.size(); ++i) ends_.push_back({end_near(i, false), end_near(i, true)});
    for (std::uint32_t i = 0; i < edges_.size(); ++i) is_point_.push_back(shrinks(i));
    find_visits();
    find_touches();
    look_at_positions();
    return std::move(out_);
  }

 private:
  const WalkSegment& segment(std::uint32_t i) const { return edges_[i].at.segment; }

  Fraction end_on(const WalkSegment& line, std::uint32_t i, bool at_end) const {
    std::optional<Fraction> f = end_along(signs_, line, edges_[i].at, at_end);
    if (!f) not_a_boundary("a sub-edge ends nowhere on its line");
    return *std::move(f);
  }
  const Fraction& own_end(std::uint32_t i, bool at_end) {
    std::optional<Fraction>& f = own_[i][at_end];
    if (!f) f = end_on(segment(i), i, at_end);
    return *f;
  }
  Point end_near(std::uint32_t i, bool at_end) {
    const WalkSegment& s = segment(i);
    const Located l =
        position_on(forms_, s, at_end ? edges_[i].at.right : edges_[i].at.left, !at_end, signs_.heading());
    double t = l.t;
    if (!(l.error * forms_.length1(s) < kKnownEnd * forms_.span())) {
      const Fraction& f = own_end(i, at_end);
      t = signs_.quotient(f.num, product(f.den, signs_.length(s).num));
    }
    t = std::clamp(t, 0.0, 1.0);
    const Point from = forms_.position(TurningForms::start(s), signs_.heading()),
                d = forms_.direction(s, signs_.heading());
    return {from.x + t * d.x, from.y + t * d.y};
  }
  bool apart(Point a, Point b) const { return std::abs(a.x - b.x) > near_ || std::abs(a.y - b.y) > near_; }
  bool shrinks(std::uint32_t i) {
    return !apart(ends_[i][0], ends_[i][1]) && signs_.compare(own_end(i, false), own_end(i, true)) == 0;
  }

  // One at the end of every sub-edge that has a length, under its index; points in between belong to it.
  void find_visits() {
    const auto n = static_cast<std::uint32_t>(edges_.size());
    visits_.assign(n, {kNone, kNone});
    before_.assign(n, kNone);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (is_point_[i]) continue;
      std::uint32_t j = edges_[i].next;
      while (j != kNone && is_point_[j]) j = edges_[j].next;
      if (j == kNone) continue;
      visits_[i] = {i, j};
      before_[j] = i;
    }
    // Loops of points only: born or gone at the angle.
    std::vector<std::uint8_t> known = is_point_;  // of loops not yet counted
    for (std::uint32_t i = 0; i < n; ++i) {
      if (is_point_[i]) continue;
      for (std::uint32_t j = edges_[i].next; j != kNone && is_point_[j]; j = edges_[j].next) known[j] = 0;
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      if (!known[i]) continue;
      out_.halves[i] += 2;
      for (std::uint32_t j = i; j != kNone && known[j]; j = edges_[j].next) {
        out_.more_is_needed |= edges_[j].next == kNone;
        known[j] = 0;
      }
    }
  }

  // Ends of sub-edges on other ones. Limits of disjoint loops do not cross, so they touch at ends of one of them.
  void find_touches() {
    position_ = UnionFind(static_cast<std::uint32_t>(visits_.size()));
    Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
    std::vector<std::uint32_t> long_ones;
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      if (is_point_[i]) continue;
      long_ones.push_back(i);
      for (const Point& p : ends_[i]) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    }
    BoxPairs boxes(std::max(high.x - low.x, high.y - low.y) + 4 * near_);
    boxes.reserve(long_ones.size());
    for (const std::uint32_t i : long_ones) {
      const auto [a, b] = ends_[i];
      boxes.add(std::min(a.x, b.x) - low.x, std::min(a.y, b.y) - low.y, std::max(a.x, b.x) - low.x + 2 * near_,
                std::max(a.y, b.y) - low.y + 2 * near_);
    }
    for (const auto& [k, l] : boxes.find()) {
      end_on_edge(long_ones[k], long_ones[l]);
      end_on_edge(long_ones[l], long_ones[k]);
    }
  }

  void end_on_edge(std::uint32_t i, std::uint32_t j) {
    if (j == visits_[i].out || visits_[i].in == kNone) return;
    const WalkSegment& s = segment(j);
    const Point z = ends_[i][1];
    const double error = 2 * SignsAt::kNear * forms_.length1(s) * forms_.span(), at = signs_.along_near(s, z);
    if (at < signs_.along_near(s, ends_[j][0]) - error || at > signs_.along_near(s, ends_[j][1]) + error ||
        !on_line(i, j, error))
      return;
    const int from = order(i, j, false), to = order(i, j, true);
    if (from < 0 || to > 0) return;
    if (from == 0 || to == 0) {
      const std::uint32_t at = from == 0 ? before_[j] : j;
      if (at == kNone || visits_[at].in == kNone) out_.more_is_needed = true;
      else position_.unite(i, at);
      return;
    }
    const auto passing = static_cast<std::uint32_t>(visits_.size());
    visits_.push_back({j, j});
    position_.add();
    position_.unite(i, passing);
  }
  // The end of sub-edge i on the line of j: the start of i's segment, and its fraction of the segment's vector.
  bool on_line(std::uint32_t i, std::uint32_t j, double error) {
    const WalkSegment &s = segment(j), &t = segment(i);
    const Point from = forms_.position(TurningForms::start(s), signs_.heading()),
                d = forms_.direction(s, signs_.heading()), z = ends_[i][1];
    if (std::abs(d.x * (z.y - from.y) - d.y * (z.x - from.x)) > error) return false;
    const auto is = [&](const WalkSegment& u) { return u.side == s.side && u.edge == s.edge && u.vertex == s.vertex; };
    if (is(t) || is(edges_[i].at.right)) return true;
    const Fraction& f = own_end(i, true);
    const exact::Polynomial whole = product(f.den, signs_.length(t).num);
    return signs_.sign(sum_of(product(forms_.exact_side(s, TurningForms::start(t), signs_.chart()), whole),
                              product(f.num, forms_.exact_cross(s, t, signs_.chart())), 1)) == 0;
  }
  // The order along j: 1 where the end of i comes after an end of j.
  int order(std::uint32_t i, std::uint32_t j, bool at_end) {
    const WalkSegment& s = segment(j);
    const double d = signs_.along_near(s, ends_[i][1]) - signs_.along_near(s, ends_[j][at_end]);
    if (std::abs(d) > 2 * SignsAt::kNear * forms_.length1(s) * forms_.span()) return d > 0 ? 1 : -1;
    return signs_.compare(end_on(s, i, true), own_end(j, at_end));
  }

  void look_at_positions() {
    std::vector<std::array<std::uint32_t, 2>> order;  // place, visit
    for (std::uint32_t v = 0; v < visits_.size(); ++v)
      if (visits_[v].in != kNone) order.push_back({position_.root(v), v});
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k < order.size();) {
      std::size_t l = k;
      std::vector<Visit> here;
      // A sub-edge passes a position once, however many end on it there.
      for (; l < order.size() && order[l][0] == order[k][0]; ++l) {
        const Visit& v = visits_[order[l][1]];
        const bool passes = v.in == v.out;
        if (!passes ||
            std::none_of(here.begin(), here.end(), [&](const Visit& w) { return w.in == v.in && w.out == v.out; }))
          here.push_back(v);
      }
      if (here.size() > 1 || turns_back(here[0])) look_at(here);
      k = l;
    }
  }
  bool turns_back(const Visit& v) const { return v.in != v.out && signs_.antiparallel(segment(v.in), segment(v.out)); }

  int cross(const Germ& g, const Germ& h) const {
    return g.sign * h.sign * signs_.cross(segment(g.edge), segment(h.edge));
  }
  bool same(const Germ& g, const Germ& h) const {
    return cross(g, h) == 0 && g.sign * h.sign * signs_.dot(segment(g.edge), segment(h.edge)) > 0;
  }
  // Clockwise from `first`: g comes before h. Of other directions than its own.
  bool before(const Germ& first, const Germ& g, const Germ& h) const {
    const int a = cross(first, g), b = cross(first, h);
    return a != b ? a < b : a != 0 && cross(g, h) < 0;
  }

  // Free sectors lie clockwise from a way out to the next way in. Where both have one direction the walls of a passage
  // meet along it.
  void look_at(const std::vector<Visit>& here) {
    std::vector<Germ> outs, ins;
    for (std::uint32_t v = 0; v < here.size(); ++v) {
      outs.push_back({here[v].out, 1, v});
      ins.push_back({here[v].in, -1, v});
    }
    constexpr std::uint32_t kNobody = 0xffffffff;
    std::vector<std::uint32_t> sector_of(outs.size(), kNobody);
    UnionFind room(static_cast<std::uint32_t>(here.size()));
    std::vector<std::uint8_t> meets(ins.size()), bounds(ins.size());
    for (std::uint32_t o = 0; o < outs.size(); ++o)
      for (std::uint32_t i = 0; i < ins.size(); ++i) {
        if (!same(outs[o], ins[i])) continue;
        if (sector_of[o] != kNobody || meets[i]) not_a_boundary("three walls along one line");
        sector_of[o] = i;
        meets[i] = 1;
        out_.halves[outs[o].edge] += 1;
        out_.touch = position_of(here);
      }
    for (std::uint32_t o = 0; o < outs.size(); ++o) {
      if (sector_of[o] != kNobody) continue;
      for (std::uint32_t i = 0; i < ins.size(); ++i)
        if (!meets[i] && (sector_of[o] == kNobody || before(outs[o], ins[i], ins[sector_of[o]]))) sector_of[o] = i;
    }
    for (const std::uint32_t i : sector_of) {
      if (i == kNobody || bounds[i]) not_a_boundary("the free sectors of a place overlap");
      bounds[i] = 1;
    }
    for (std::uint32_t o = 0; o < outs.size(); ++o) {
      room.unite(outs[o].visit, ins[sector_of[o]].visit);
      out_.together.push_back({outs[o].edge, ins[sector_of[o]].edge});
    }
    for (std::uint32_t v = 0; v < here.size(); ++v) {
      out_.together.push_back({here[v].in, here[v].out});
      if (room.root(v) != v) out_.halves[here[v].out] -= 2;
    }
    if (here.size() > 1) out_.touch = position_of(here);
  }
  // Visits that pass along one sub-edge have no end there.
  Point position_of(const std::vector<Visit>& here) const {
    for (const Visit& v : here)
      if (v.in != v.out) return ends_[v.in][1];
    not_a_boundary("nothing ends at a place");
  }

  const SignsAt& signs_;
  const TurningForms& forms_;
  const std::vector<LimitEdge>& edges_;
  double near_ = 0;
  std::vector<std::array<std::optional<Fraction>, 2>> own_;
  std::vector<std::array<Point, 2>> ends_;
  std::vector<std::uint8_t> is_point_;
  std::vector<Visit> visits_;
  std::vector<std::uint32_t> before_;
  UnionFind position_;  // of visits
  BoundaryLimit out_;
};

}  // namespace

BoundaryLimit limit_of(const SignsAt& signs, const std::vector<LimitEdge>& edges) { return Limit(signs, edges).run(); }

namespace {

// Adds the limits of the nodes before the angle, or after it; false where `near` leaves out what is needed.
bool add_limit(const SignsAt& signs, const BoundaryGraph& graph, const std::vector<std::uint32_t>& near, bool after,
               LimitsOfAngle& found) {
  std::map<std::uint32_t, std::uint32_t> next_before;
  for (const auto& [n, next] : graph.relinked()) next_before.emplace(n, next);
  std::vector<std::uint32_t> all = near;
  if (near.empty()) {
    all = graph.alive();
    all.insert(all.end(), graph.ended().begin(), graph.ended().end());
    std::sort(all.begin(), all.end());
  }
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t n : all)
    if (after ? graph[n].alive : graph[n].begin != graph.angle() && (graph[n].alive || graph[n].end == graph.angle()))
      nodes.push_back(n);
  std::vector<LimitEdge> edges;
  for (const std::uint32_t n : nodes) {
    const auto before = after ? next_before.end() : next_before.find(n);
    const std::uint32_t next = before == next_before.end() ? graph[n].next : before->second;
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), next);
    const bool known = at != nodes.end() && *at == next;
    edges.push_back({graph.sub_edge(n), known ? static_cast<std::uint32_t>(at - nodes.begin()) : kNone});
  }
  const BoundaryLimit limit = limit_of(signs, edges);
  if (limit.more_is_needed) return false;
  for (std::uint32_t k = 0; k < nodes.size(); ++k)
    if (limit.halves[k] != 0) found.halves.emplace_back(nodes[k], limit.halves[k]);
  for (const auto& [k, l] : limit.together) found.together.push_back({nodes[k], nodes[l]});
  if (limit.touch) found.touch = limit.touch;
  return true;
}

}  // namespace

LimitsOfAngle limits_of_angle(const SignsAt& signs, const BoundaryGraph& graph,
                              const std::vector<std::uint32_t>& near) {
  LimitsOfAngle found;
  if (add_limit(signs, graph, near, false, found) && add_limit(signs, graph, near, true, found)) return found;
  return limits_of_angle(signs, graph);
}

}  // namespace dymsum::planar
