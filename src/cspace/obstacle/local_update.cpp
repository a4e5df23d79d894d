// What changes near an event at which three segments, or a vertex and a segment, meet and nothing else does: a small
// arrangement behind the event, the kill rule in it, and paths from the visible sub-edges that come in to those that go
// out.
#include <algorithm>

#include "cspace/events/walk_numbers.h"
#include "cspace/obstacle/obstacle_sweep.h"
#include "planar/boundary/collision.h"
#include "planar/turning/slice.h"
#include "planar/turning/turn.h"

namespace dymsum::planar {
namespace {

int sign_of(double v, double error) { return v > error ? 1 : v < -error ? -1 : 0; }

/// Places along a segment nearer than this (as parameters) are not told apart in doubles.
constexpr double kUnsure = 0x1p-30;

}  // namespace

bool ObstacleSweep::Cluster::any() const {
  for (int k = 0; k < size; ++k)
    if (local[k].in != kNobody || local[k].out != kNobody) return true;
  return !vanish.empty();
}

int ObstacleSweep::Cluster::find(std::uint32_t id) const {
  for (int k = 0; k < size; ++k)
    if (local[k].id == id) return k;
  return -1;
}

bool ObstacleSweep::find_signs(Cluster& cluster, Heading h) const {
  for (int i = 0; i < cluster.size; ++i)
    for (int j = i + 1; j < cluster.size; ++j) {
      const WalkSegment &s = cluster.local[i].segment, &t = cluster.local[j].segment;
      const int sign = sign_of(forms_.cross(s, t).at(h), 0x1p-32 * forms_.length1(s) * forms_.length1(t));
      if (sign == 0) return false;
      cluster.cross[i][j] = sign;
      cluster.cross[j][i] = -sign;
    }
  return true;
}

// Behind the event the crossings with b and c on a are in the order sign(G) sign(a x b) sign(a x c), G being the
// concurrency.
ObstacleSweep::Fill ObstacleSweep::fill_triple(Cluster& cluster, const TurnEvent& event, Heading h) const {
  cluster.size = 3;
  const std::array<WalkSegment, 3> s{event.a, event.b, event.c};
  for (int k = 0; k < 3; ++k) {
    cluster.local[k].segment = s[k];
    cluster.local[k].id = id(s[k]);
    const TurnCatalog::Existence exists = catalog_.exists(s[k], event.theta());
    if (exists != TurnCatalog::Existence::yes)
      return exists == TurnCatalog::Existence::no ? Fill::nothing : Fill::unsure;
  }
  if (!find_signs(cluster, h) || !event.root->changes_sign()) return Fill::unsure;
  for (int k = 0; k < 3; ++k) {
    const Located t = place_on(forms_, s[k], s[(k + 1) % 3], false, h),
                  u = place_on(forms_, s[k], s[(k + 2) % 3], false, h);
    if (const Fill inside = within(t.error < u.error ? t : u); inside != Fill::done) return inside;
  }
  const TrigForm2 g = forms_.concurrency(event.a, event.b, event.c);
  const int after = sign_of(g.slope(h), 4096 * forms_.concurrency_error(event.a, event.b, event.c));
  if (after == 0) return Fill::unsure;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const bool i_last = after * cluster.cross[k][i] * cluster.cross[k][j] > 0;
    cluster.local[k].count = 2;
    cluster.local[k].vertices = {LocalVertex{i_last ? j : i, false}, LocalVertex{i_last ? i : j, false}};
  }
  // The crossing of the two that are least parallel.
  cluster.at_error = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const Located t = place_on(forms_, s[k], s[(k + 1) % 3], false, h);
    const Point from = forms_.place(TurningForms::start(s[k]), h), d = forms_.direction(s[k], h);
    const double error = t.error * forms_.length1(s[k]) + 0x1p-46 * forms_.span();
    if (!(error < cluster.at_error)) continue;
    cluster.at_error = error;
    cluster.at = {from.x + t.t * d.x, from.y + t.t * d.y};
  }
  return Fill::done;
}

// Strictly between the ends of a segment, or not on it, or too near to an end.
ObstacleSweep::Fill ObstacleSweep::within(Located t) {
  if (t.t < -t.error || t.t > 1 + t.error) return Fill::nothing;
  return t.t > t.error && t.t < 1 - t.error ? Fill::done : Fill::unsure;
}

// The vertex goes to one side of a; the segments that end and start there cross a or not.
ObstacleSweep::Fill ObstacleSweep::fill_vertex(Cluster& cluster, const TurnEvent& event, Heading h) const {
  const TurnCatalog::Joint joint = catalog_.joint(event.v, event.theta());
  const TurnCatalog::Existence exists = catalog_.exists(event.a, event.theta());
  if (exists == TurnCatalog::Existence::no) return Fill::nothing;
  if (joint.unsure || exists == TurnCatalog::Existence::unsure) return Fill::unsure;
  cluster.at = forms_.place(event.v, h);
  cluster.at_error = 0x1p-46 * forms_.span();
  const Point from = forms_.place(TurningForms::start(event.a), h), d = forms_.direction(event.a, h);
  const double t = (d.x * (cluster.at.x - from.x) + d.y * (cluster.at.y - from.y)) / (d.x * d.x + d.y * d.y);
  if (const Fill inside = within({t, 4 * cluster.at_error / forms_.length1(event.a)}); inside != Fill::done)
    return inside;
  cluster.size = 1;
  cluster.local[0].segment = event.a;
  cluster.local[0].id = id(event.a);
  int in = -1, out = -1;
  if (joint.has_in) {
    in = cluster.size++;
    cluster.local[in].segment = joint.in;
    cluster.local[in].closes = true;
  }
  if (joint.has_out) {
    out = cluster.size++;
    cluster.local[out].segment = joint.out;
    cluster.local[out].opens = true;
  }
  for (int k = 1; k < cluster.size; ++k) cluster.local[k].id = id(cluster.local[k].segment);
  if (!find_signs(cluster, h) || !event.root->changes_sign()) return Fill::unsure;
  const int side = sign_of(forms_.side(event.a, event.v).slope(h), 4096 * forms_.side_error(event.a));
  if (side == 0) return Fill::unsure;
  Local& a = cluster.local[0];
  const bool in_crosses = in >= 0 && side == cluster.cross[0][in],
             out_crosses = out >= 0 && side == -cluster.cross[0][out];
  if (in >= 0) {
    Local& b = cluster.local[in];
    if (in_crosses) b.vertices[b.count++] = {0, false};
    b.vertices[b.count++] = {out, true};
  }
  if (out >= 0) {
    Local& b = cluster.local[out];
    b.vertices[b.count++] = {in, true};
    if (out_crosses) b.vertices[b.count++] = {0, false};
  }
  if (in_crosses && out_crosses) {
    const bool in_first = -side * cluster.cross[in][out] * cluster.cross[0][in] * cluster.cross[0][out] < 0;
    a.vertices = {LocalVertex{in_first ? in : out, false}, LocalVertex{in_first ? out : in, false}};
    a.count = 2;
  } else if (in_crosses || out_crosses) {
    a.vertices[a.count++] = {in_crosses ? in : out, false};
  }
  return Fill::done;
}

// The visible sub-edges that reach the event: those bounded by another segment of the cluster, and those that pass.
bool ObstacleSweep::find_nodes(Cluster& cluster, Heading h) const {
  for (int k = 0; k < cluster.size; ++k) {
    Local& local = cluster.local[k];
    for (std::uint32_t n = first_[local.id]; n != kNobody; n = nodes_[n].same) {
      const Node& node = nodes_[n];
      const bool starts = cluster.find(nodes_[node.prev].id) >= 0, ends = cluster.find(nodes_[node.next].id) >= 0;
      if (starts && ends) {
        cluster.vanish.push_back(n);
        continue;
      }
      bool passes = false;
      if (!starts && !ends) {
        if (local.opens || local.closes) continue;
        const Point from = forms_.place(TurningForms::start(local.segment), h), d = forms_.direction(local.segment, h);
        const double t = (d.x * (cluster.at.x - from.x) + d.y * (cluster.at.y - from.y)) / (d.x * d.x + d.y * d.y);
        const double error = kUnsure + 4 * cluster.at_error / forms_.length1(local.segment);
        const Located u = place_on(forms_, local.segment, nodes_[node.prev].segment, true, h),
                      v = place_on(forms_, local.segment, nodes_[node.next].segment, false, h);
        if (!(std::abs(t - u.t) > error + u.error && std::abs(t - v.t) > error + v.error)) return false;
        passes = t > u.t && t < v.t;
        if (!passes) continue;
      }
      if (ends || passes) {
        if (local.in != kNobody) return false;
        local.in = n;
      }
      if (starts || passes) {
        if (local.out != kNobody) return false;
        local.out = n;
      }
    }
    if ((local.opens && local.in != kNobody) || (local.closes && local.out != kNobody)) return false;
  }
  return true;
}

// The kill rule, lemma 4: where b passes from right to left of a, what comes before on a is inside; where it passes
// from left to right, what follows.
bool ObstacleSweep::end_alive(const Cluster& c, int segment, int piece) const {
  const Local& l = c.local[segment];
  if (piece == l.count) return !l.closes;
  const LocalVertex& v = l.vertices[piece];
  return v.chain ? v.other >= 0 : c.cross[segment][v.other] < 0;
}

bool ObstacleSweep::start_alive(const Cluster& c, int segment, int piece) const {
  const Local& l = c.local[segment];
  if (piece == 0) return !l.opens;
  const LocalVertex& v = l.vertices[piece - 1];
  return v.chain ? v.other >= 0 : c.cross[segment][v.other] > 0;
}

std::optional<std::vector<ObstacleSweep::Path>> ObstacleSweep::paths(const Cluster& c,
                                                                     std::vector<std::vector<int>>& births) const {
  std::array<std::array<bool, 3>, 3> seen{};
  const auto successor = [&](int s, int piece) -> std::pair<int, int> {
    const LocalVertex& v = c.local[s].vertices[piece];
    const Local& to = c.local[v.other];
    for (int k = 0; k < to.count; ++k)
      if (to.vertices[k].other == s && to.vertices[k].chain == v.chain) return {v.other, k + 1};
    return {-1, 0};
  };
  std::vector<Path> found;
  int outs = 0;
  for (int s = 0; s < c.size; ++s) {
    outs += c.local[s].out != kNobody;
    if (c.local[s].in == kNobody) continue;
    Path path;
    path.in = c.local[s].in;
    int at = s, piece = 0;
    for (;;) {
      if (seen[at][piece] || !start_alive(c, at, piece) || !end_alive(c, at, piece)) return std::nullopt;
      seen[at][piece] = true;
      path.segments.push_back(at);
      if (piece == c.local[at].count) break;
      std::tie(at, piece) = successor(at, piece);
      if (at < 0) return std::nullopt;
    }
    path.out = c.local[at].out;
    if (path.out == kNobody) return std::nullopt;
    found.push_back(std::move(path));
  }
  if (outs != static_cast<int>(found.size())) return std::nullopt;
  for (int s = 0; s < c.size; ++s)
    for (int piece = 1; piece < c.local[s].count; ++piece) {
      std::vector<int> cycle;
      int at = s, p = piece;
      while (at >= 0 && p > 0 && p < c.local[at].count && !seen[at][p] && start_alive(c, at, p) &&
             end_alive(c, at, p)) {
        seen[at][p] = true;
        cycle.push_back(at);
        std::tie(at, p) = successor(at, p);
      }
      if (at == s && p == piece && cycle.size() > 1) births.push_back(std::move(cycle));
    }
  return found;
}

// A new loop of constant size: whether the face on its right is free, exactly, at an angle between this event and the
// next one.
bool ObstacleSweep::born(const Cluster& cluster, const std::vector<int>& cycle,
                         const std::function<Orientation()>& behind) {
  ++work.collision_tests;
  const SumState state = placed_at(*base_, behind());
  Collision collision(*state.lattice, *state.p, *state.q, true);
  const auto exact_segment = [&](int k) {
    const WalkSegment& s = cluster.local[k].segment;
    const Operand &o = s.side == 0 ? *state.p : *state.q, &other = s.side == 0 ? *state.q : *state.p;
    return Segment{o.edge(s.edge), other.source[s.vertex]};
  };
  const auto cut = [&](int from, int to) {
    // Where the boundary turns from one segment of the cycle into the next.
    Cut c;
    const WalkSegment &a = cluster.local[from].segment, &b = cluster.local[to].segment;
    if (forms_.end(a) == TurningForms::start(b)) {
      c.pair = {state.p->source[forms_.end(a).p], state.q->source[forms_.end(a).q]};
    } else {
      c.kind = Cut::Kind::crossing;
    }
    return c;
  };
  const std::size_t k = cycle.size();
  const int self = cycle[0], prev = cycle[k - 1], next = cycle[1];
  Place place;
  place.on = exact_segment(self);
  place.between = true;
  place.first = cut(prev, self);
  if (place.first.kind == Cut::Kind::crossing) place.first.by = exact_segment(prev);
  place.second = cut(self, next);
  if (place.second.kind == Cut::Kind::crossing) place.second.by = exact_segment(next);
  const Lattice::Position p = state.lattice->position(place);
  const Point low = state.lattice->base;
  place.x = exact::round_to_double(
      exact::BigRational((p.x - exact::exact_value(low.x)) / exact::exact_value(state.lattice->unit)));
  place.y = exact::round_to_double(
      exact::BigRational((p.y - exact::exact_value(low.y)) / exact::exact_value(state.lattice->unit)));
  place.error = 0x1p-44 * state.lattice->span +
                (state.lattice->base_reach * 0x1p-50 + state.lattice->base_error) / state.lattice->unit;
  return !collision.overlaps_right_of(place);
}

bool ObstacleSweep::apply(const Cluster& cluster, const std::vector<Path>& paths,
                          const std::vector<std::vector<int>>& births) {
  std::map<std::uint32_t, std::uint32_t> starts, ends;  // old node -> the new one that has its start, its end
  std::vector<std::uint32_t> old, fresh, touched;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> claims;
  const auto cell_of = [&](std::uint32_t n) { return nodes_[n].cell; };
  for (const Path& path : paths) {
    if (path.segments.size() == 1 && path.in == path.out) continue;
    std::uint32_t last = kNobody;
    for (std::size_t k = 0; k < path.segments.size(); ++k) {
      const std::uint32_t n = add_node(cluster.local[path.segments[k]].segment, cell_of(path.in));
      fresh.push_back(n);
      if (last != kNobody) link(last, n);
      if (k == 0) {
        starts[path.in] = n;
        claims.emplace_back(n, cell_of(path.in));
        join(shell_, path.in, n);
      }
      if (k + 1 == path.segments.size()) {
        ends[path.out] = n;
        claims.emplace_back(n, cell_of(path.out));
        join(shell_, path.out, n);
      }
      last = n;
    }
    old.push_back(path.in);
    old.push_back(path.out);
  }
  std::vector<std::uint32_t> lost;
  for (const std::uint32_t n : cluster.vanish) lost.push_back(cell_of(n));
  relink(starts, ends, touched);
  std::sort(old.begin(), old.end());
  old.erase(std::unique(old.begin(), old.end()), old.end());
  for (const std::uint32_t n : old) {
    lost.push_back(cell_of(n));
    end_node(n);
  }
  for (const std::uint32_t n : cluster.vanish) end_node(n);
  for (const std::vector<int>& cycle : births) {
    const std::size_t first = fresh.size();
    for (const int s : cycle) fresh.push_back(add_node(cluster.local[s].segment, kNobody));
    for (std::size_t k = first; k < fresh.size(); ++k) link(fresh[k], fresh[k + 1 == fresh.size() ? first : k + 1]);
  }
  touched.insert(touched.end(), fresh.begin(), fresh.end());
  for (const std::uint32_t n : touched)
    if (nodes_[n].begin == now_ && nodes_[n].alive) {
      nodes_[n].left = nodes_[nodes_[n].prev].id;
      nodes_[n].right = nodes_[nodes_[n].next].id;
    }
  refresh(touched);
  const bool loop_lost = !cluster.vanish.empty() && paths.empty();
  if (paths.size() > 1 || !births.empty() || loop_lost) {
    std::sort(lost.begin(), lost.end());
    lost.erase(std::unique(lost.begin(), lost.end()), lost.end());
    relabel(fresh, lost, claims);
  }
  return true;
}

bool ObstacleSweep::local_update(TurnEvent& event, const TurnRange& range, const std::function<Orientation()>& behind,
                                 OverlapFilter& filter) {
  if (event.kind == TurnEvent::Kind::alignment) return alignment_update(event, range);
  if (event.kind == TurnEvent::Kind::overlap) return overlap_update(event, range);
  const Heading h = Heading::of(event.theta());
  Cluster cluster;
  const Fill filled =
      event.kind == TurnEvent::Kind::three_segments ? fill_triple(cluster, event, h) : fill_vertex(cluster, event, h);
  if (filled == Fill::nothing) return true;
  // Not generic: of no interest where everything is covered.
  if (filled == Fill::unsure) return certainly_covered(event, forms_, filter);
  if (!find_nodes(cluster, h)) return false;
  std::vector<std::vector<int>> births;
  const std::optional<std::vector<Path>> found = paths(cluster, births);
  if (!cluster.any()) {
    if (births.empty() || filter.inside(cluster.at, h)) {
      if (births.empty() && !trying_) doubtful_.push_back(&event);
      return true;
    }
  }
  if (!found || trying_) return found.has_value();
  std::erase_if(births, [&](const std::vector<int>& cycle) { return !born(cluster, cycle, behind); });
  bool same = births.empty() && cluster.vanish.empty();
  for (const Path& path : *found) same &= path.segments.size() == 1 && path.in == path.out;
  if (same) return true;
  now_ = angle(range, event);
  note(h,
       event.kind == TurnEvent::Kind::three_segments ? ObstacleEvent::Kind::three_segments
                                                     : ObstacleEvent::Kind::vertex_on_segment,
       cluster.at);
  ++work.local_updates;
  return apply(cluster, *found, births);
}

}  // namespace dymsum::planar
