#include "planar/scaling/frame_loops.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

int half(const LiveSegment& s) { return s.dy > 0 || (s.dy == 0 && s.dx > 0) ? 0 : 1; }

// Window coordinates of sums: each operand's coordinate one rounding, tau one, product, sum.
constexpr double kPoint = 0x1p-49;

}  // namespace

std::size_t FrameLoops::bytes() const {
  std::size_t n = seen_.capacity() * 4 + loops_.capacity() * sizeof(FrameLoop);
  for (const FrameLoop& l : loops_) n += l.steps.capacity() * sizeof(Step) + l.vertices.capacity() * sizeof(MovingVertex);
  return n;
}

// Whether a sub-edge has existed, with nothing between its ends, at every scale since the last frame. A point inside it then moved
// continuously without meeting another segment, so what lies on its right is inside or outside the sum as it was (docs/design/scaling-sum.md).
bool FrameLoops::undisturbed(const FrameLoop::Between& edge, double tau) const {
  const Window& window = lists_.window();
  const double low = std::min(tau, last_tau_), high = std::max(tau, last_tau_);
  const LiveSegment& segment = window.segments[window.pieces[edge.piece].segment];
  struct End {
    Linear t;
    double error;
  };
  const auto end = [&](std::uint32_t id, Linear at_end) {
    if (id == kNone) return End{at_end, 0};
    if (id & kTouchBit) return End{window.touches[id & ~kTouchBit].t, window.touches[id & ~kTouchBit].error};
    const Candidate& c = window.candidates[id];
    return c.a == edge.piece ? End{c.ta, c.error_a} : End{c.tb, c.error_b};
  };
  for (const std::uint32_t id : {edge.from, edge.to}) {
    if (id == kNone) continue;
    const auto stays = [&](const auto& c) { return c.in_low < low && c.in_high > high; };
    if (id & kTouchBit ? !stays(window.touches[id & ~kTouchBit]) : !stays(window.candidates[id])) return false;
  }
  const End from = end(edge.from, {0, 0}), to = end(edge.to, segment.moving ? Linear{0, 1} : Linear{1, 0});
  const double margin = from.error + to.error + 0x1p-48 * std::max(1.0, high);
  for (const double x : {low, high})
    if (!(to.t.at(x) - from.t.at(x) > margin)) return false;
  for (std::uint32_t k = window.first_of[edge.piece]; k < window.first_of[edge.piece + 1]; ++k) {
    const std::uint32_t id = window.of[k];
    const Candidate& c = window.candidates[id];
    if (id == edge.from || id == edge.to || c.out_high <= low || c.out_low >= high) continue;
    const bool a = c.a == edge.piece;
    const Linear& t = a ? c.ta : c.tb;
    const double apart = margin + (a ? c.error_a : c.error_b), u = std::max(low, c.out_low), v = std::min(high, c.out_high);
    const bool before = from.t.at(u) - t.at(u) > apart && from.t.at(v) - t.at(v) > apart;
    const bool behind = t.at(u) - to.t.at(u) > apart && t.at(v) - to.t.at(v) > apart;
    if (!before && !behind) return false;
  }
  for (std::uint32_t k = window.first_touch[edge.piece]; k < window.first_touch[edge.piece + 1]; ++k) {
    const PersistentTouch& c = window.touches[k];
    if ((k | kTouchBit) == edge.from || (k | kTouchBit) == edge.to || c.out_high <= low || c.out_low >= high) continue;
    const double apart = margin + c.error, u = std::max(low, c.out_low), v = std::min(high, c.out_high);
    const bool before = from.t.at(u) - c.t.at(u) > apart && from.t.at(v) - c.t.at(v) > apart;
    const bool behind = c.t.at(u) - to.t.at(u) > apart && c.t.at(v) - to.t.at(v) > apart;
    if (!before && !behind) return false;
  }
  return true;
}

bool FrameLoops::update(double tau, FramePlace& place, bool whole, FrameWork& work) {
  const Window& window = lists_.window();
  if (seen_.size() != lists_.sub_limit() || walk_ > 0xfffffff0) {
    seen_.assign(lists_.sub_limit(), 0);
    owners_.assign(window.pieces.size(), {});
    nodes_.assign(window.nodes.size(), {});
    visited_.assign(window.nodes.size(), 0);
    walk_ = 0;
  }
  ended_.clear();
  ++walk_;
  std::vector<FrameLoop> gone;
  std::vector<Look> look;
  const auto any_undisturbed = [&](const FrameLoop& loop) {
    for (const FrameLoop::Between& edge : loop.edges)
      if (undisturbed(edge, tau)) return true;
    return false;
  };
  if (whole) {
    loops_.clear();
  } else {
    std::size_t to = 0;
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      bool changed = false, touched = false;
      for (const Step& s : loops_[i].steps) {
        changed |= lists_.has_changed(s.piece);
        touched |= lists_.touched(s.piece);
      }
      if (changed) {
        gone.push_back(std::move(loops_[i]));
        continue;
      }
      work.loops_kept += !touched;
      look.push_back(!touched ? Look::none : any_undisturbed(loops_[i]) ? Look::known : Look::test);
      loops_[i].fresh = false;
      if (to != i) loops_[to] = std::move(loops_[i]);
      ++to;
    }
    loops_.resize(to);
  }
  const std::size_t fresh = loops_.size();
  if (whole) {
    for (std::uint32_t i = 0; i < window.pieces.size(); ++i) trace(i, work);
  } else {
    // A new cycle passes a piece whose list changed: elsewhere the successor map is as it was.
    for (const std::uint32_t i : lists_.changed()) trace(i, work);
  }
  // What is new inherits its status from any sub-edge that it shares with an old loop, if nothing came between.
  if (loops_.size() > fresh)
    for (std::uint32_t g = 0; g < gone.size(); ++g)
      for (std::uint32_t k = 0; k < gone[g].edges.size(); ++k)
        if (Owner& owner = owners_[gone[g].edges[k].piece]; owner.walk != walk_) owner = {walk_, g, k};
  for (std::size_t i = fresh; i < loops_.size(); ++i) {
    FrameLoop& loop = loops_[i];
    Look status = Look::test;
    for (const FrameLoop::Between& e : loop.edges) {
      const Owner& owner = owners_[e.piece];
      if (owner.walk != walk_ || !(gone[owner.loop].edges[owner.edge] == e)) continue;
      if (!loop.witness) loop.witness = gone[owner.loop].witness;
      if (!undisturbed(e, tau)) continue;
      loop.kept = gone[owner.loop].kept;
      status = Look::known;
      break;
    }
    look.push_back(status);
  }
  verify(tau, place, look, work);
  std::vector<std::uint8_t> claimed(gone.size(), 0);
  for (std::size_t i = 0; i < loops_.size(); ++i)
    if (loops_[i].kept && loops_[i].vertices.empty()) make_vertices(loops_[i], gone, claimed);
  for (std::size_t g = 0; g < gone.size(); ++g)
    if (gone[g].kept && !claimed[g] && gone[g].ring != 0) ended_.push_back({gone[g].ring, static_cast<std::uint32_t>(gone[g].vertices.size())});
  const bool plain = window.nodes.empty() || nodes_are_plain(tau, place, whole, work);
  last_tau_ = tau;
  return plain;
}

// Whether nothing on its piece passed a touch at any scale since the last frame.
bool FrameLoops::quiet(std::uint32_t touch, double tau) const {
  const Window& window = lists_.window();
  const PersistentTouch& v = window.touches[touch];
  const double low = std::min(tau, last_tau_), high = std::max(tau, last_tau_);
  if (!(v.in_low < low && v.in_high > high)) return false;
  const auto passes = [&](const Linear& t, double error, const auto& c) {
    if (c.out_high <= low || c.out_low >= high) return false;
    const double apart = v.error + error + 0x1p-48 * std::max(1.0, high), u = std::max(low, c.out_low), w = std::min(high, c.out_high);
    const double gap_u = t.at(u) - v.t.at(u), gap_w = t.at(w) - v.t.at(w);
    return !(gap_u > apart && gap_w > apart) && !(gap_u < -apart && gap_w < -apart);
  };
  for (std::uint32_t k = window.first_of[v.piece]; k < window.first_of[v.piece + 1]; ++k) {
    const Candidate& c = window.candidates[window.of[k]];
    if (c.a == v.piece ? passes(c.ta, c.error_a, c) : passes(c.tb, c.error_b, c)) return false;
  }
  for (std::uint32_t k = window.first_touch[v.piece]; k < window.first_touch[v.piece + 1]; ++k)
    if (k != touch && passes(window.touches[k].t, window.touches[k].error, window.touches[k])) return false;
  return true;
}

// At every scale something touches in these nodes. The boundary passes those that it passes once; the others have to lie in the open sum.
// A node that did so does so as long as nothing passes it on a piece it lies inside of: what could uncover it would cross that piece there.
bool FrameLoops::nodes_are_plain(double tau, FramePlace& place, bool whole, FrameWork& work) {
  const Window& window = lists_.window();
  std::fill(visited_.begin(), visited_.end(), 0);
  for (const FrameLoop& loop : loops_)
    if (loop.kept)
      for (const Step& s : loop.steps)
        if (const std::uint32_t node = lists_.end_node(s); node != kNone && ++visited_[node] > 1) return false;
  for (std::uint32_t n = 0; n < window.nodes.size(); ++n) {
    if (!lists_.active(n)) {
      nodes_[n].inside = false;
      continue;
    }
    bool changed = whole || lists_.relinked(n);
    for (std::uint32_t r = window.nodes[n].first_ray; r < window.nodes[n].last_ray && nodes_[n].inside && !changed; ++r) {
      const PersistentNode::Ray& ray = window.rays[r];
      changed = ray.touch != kNone && ray.out && lists_.active_touch(ray.touch) && lists_.touched(ray.piece) && !quiet(ray.touch, tau);
    }
    if (changed) nodes_[n].inside = false;
    if (visited_[n] > 0 || nodes_[n].inside) continue;
    if (!node_inside(n, tau, place, work)) return false;
    nodes_[n].inside = true;
  }
  return true;
}

bool FrameLoops::node_inside(std::uint32_t node, double tau, FramePlace& place, FrameWork& work) {
  const Window& window = lists_.window();
  const PersistentNode& n = window.nodes[node];
  const Lattice& l = *window.base().lattice;
  const Pair v = window.exact(n.at);
  const std::uint32_t m = window.frame().moving, move = m == 0 ? v.p : v.q, rest = m == 0 ? v.q : v.p;
  const double x = l.points[1 - m]->x[rest] + tau * l.points[m]->x[move], y = l.points[1 - m]->y[rest] + tau * l.points[m]->y[move];
  if (nodes_[node].witness && crosses_at(*nodes_[node].witness, x, y, kPoint * window.span(), tau)) {
    ++work.witnessed;
    return true;
  }
  Place p;
  p.on = window.exact(window.pieces[window.rays[n.first_ray].piece].segment);
  p.first.pair = v;
  const double grow = place.blow_up(m);
  p.x = grow * x;
  p.y = grow * y;
  p.error = grow * 2 * kPoint * window.span();
  ++work.collision_tests;
  const bool inside = place.collision().overlaps(p);
  nodes_[node].witness = place.collision().crossing_edges();
  return inside;
}

void FrameLoops::trace(std::uint32_t piece, FrameWork& work) {
  const auto n_of = [&](std::uint32_t i) { return lists_.count(i); };
  const std::uint32_t n = n_of(piece);
  for (std::uint32_t k = 0; k <= n; ++k) {
    const Step start{piece, k};
    if (seen_[lists_.first_sub(piece) + k] >= walk_ || !lists_.alive_at_start(start)) continue;
    path_.clear();
    Step at = start;
    do {
      seen_[lists_.first_sub(at.piece) + at.sub] = walk_;
      path_.push_back(at);
      at = lists_.successor(at);
    } while (at.piece != kNone && seen_[lists_.first_sub(at.piece) + at.sub] < walk_);
    if (!(at == start)) continue;
    ++work.loops_traced;
    FrameLoop loop;
    loop.steps = path_;
    loop.turning = turning_number(path_);
    loop.edges.reserve(path_.size());
    for (const Step& s : path_)
      loop.edges.push_back({s.piece, s.sub == 0 ? kNone : lists_.entry(s.piece, s.sub - 1),
                            s.sub == n_of(s.piece) ? kNone : lists_.entry(s.piece, s.sub)});
    loops_.push_back(std::move(loop));
  }
}

int FrameLoops::turning_number(const std::vector<Step>& steps) const {
  const Window& window = lists_.window();
  int turns = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step &from = steps[i], &to = steps[(i + 1) % steps.size()];
    const Piece& p = window.pieces[from.piece];
    const int hf = half(window.segments[p.segment]), ht = half(window.segments[window.pieces[to.piece].segment]);
    if (hf == ht) continue;
    int c = p.next_turn;
    if (lists_.end_node(from) != kNone) {
      c = window.cross(p.segment, window.pieces[to.piece].segment);
    } else if (from.sub < lists_.count(from.piece)) {
      const Candidate& x = window.candidates[lists_.entry(from.piece, from.sub)];
      c = x.a == from.piece ? x.sign : -x.sign;
    }
    if (c > 0 && hf == 1) ++turns;
    if (c < 0 && hf == 0) --turns;
  }
  return turns;
}

void FrameLoops::verify(double tau, FramePlace& place, const std::vector<Look>& look, FrameWork& work) {
  // A connected sum has exactly one counter-clockwise true loop, the one that reaches farthest left.
  std::size_t outer = loops_.size();
  if (place.base().connected) {
    std::size_t ccw = 0, last = 0;
    for (std::size_t i = 0; i < loops_.size(); ++i)
      if (loops_[i].turning > 0) {
        ++ccw;
        last = i;
        if (look[i] != Look::test && loops_[i].kept) outer = i;
      }
    if (outer == loops_.size() && ccw == 1) outer = last;
    if (outer == loops_.size()) {
      double best = INFINITY, second = INFINITY, error = 0;
      std::size_t leftmost = loops_.size();
      for (std::size_t i = 0; i < loops_.size(); ++i) {
        if (loops_[i].turning < 0) continue;
        double low = INFINITY;
        for (const Step& s : loops_[i].steps) {
          const MovingVertex v = vertex_after(s, 0, 0);
          low = std::min(low, v.x.at(tau) - v.error);
          error = std::max(error, v.error);
        }
        if (low < best) {
          second = best;
          best = low;
          leftmost = i;
        } else {
          second = std::min(second, low);
        }
      }
      if (second - best > 4 * error) outer = leftmost;
    }
  }
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    if (look[i] != Look::test) continue;
    FrameLoop& loop = loops_[i];
    if (i == outer) {
      loop.kept = true;
    } else if (outer != loops_.size() && loop.turning > 0) {
      loop.kept = false;
    } else {
      loop.kept = !is_false(loop, tau, place, work);
    }
  }
}

bool FrameLoops::is_false(FrameLoop& loop, double tau, FramePlace& place, FrameWork& work) {
  if (loop.witness && witnessed(loop, tau)) {
    ++work.witnessed;
    return true;
  }
  ++work.collision_tests;
  Collision& collision = place.collision();
  const bool overlap = collision.overlaps_right_of(sample(loop, tau, place));
  loop.witness = collision.crossing_edges();
  return overlap;
}

FrameLoops::Cutting FrameLoops::end_cut(Step s, bool at_end) const {
  const Window& window = lists_.window();
  const LiveSegment& on = window.segments[window.pieces[s.piece].segment];
  Cutting c;
  c.relative_error = 0x1p-50;
  const bool end = at_end && s.sub == lists_.count(s.piece), start = !at_end && s.sub == 0;
  if (end || start) {
    c.cut.pair = window.exact(end ? on.end : on.start);
    c.t = end ? (on.moving ? Linear{0, 1} : Linear{1, 0}) : Linear{0, 0};
    c.error = 0;
    c.denominator = on.dx != 0 ? std::abs(on.dx) : std::abs(on.dy);
    return c;
  }
  const std::uint32_t entry = lists_.entry(s.piece, at_end ? s.sub : s.sub - 1);
  if (entry & kTouchBit) {
    const PersistentTouch& touch = window.touches[entry & ~kTouchBit];
    c.cut.pair = window.exact(window.nodes[touch.node].at);
    c.t = touch.t;
    c.error = touch.error;
    c.denominator = on.dx != 0 ? std::abs(on.dx) : std::abs(on.dy);
    return c;
  }
  const Candidate& x = window.candidates[entry];
  const bool a = x.a == s.piece;
  const std::uint32_t other = window.pieces[a ? x.b : x.a].segment;
  const LiveSegment& by = window.segments[other];
  c.t = a ? x.ta : x.tb;
  c.error = a ? x.error_a : x.error_b;
  c.cut.kind = Cut::Kind::crossing;
  c.cut.by = window.exact(other);
  const double u = on.dx * by.dy, v = on.dy * by.dx, d = std::abs(u - v);
  c.denominator = d * window.base().lattice->integers_per_unit;
  c.relative_error = d > 0 ? std::min(1.0, 0x1p-48 * (std::abs(u) + std::abs(v)) / d) : 1.0;
  return c;
}

// The mediant of the cuts at both ends of the longest sub-edge, as the exact layer takes it.
Place FrameLoops::sample(const FrameLoop& loop, double tau, FramePlace& place) const {
  const Window& window = lists_.window();
  const std::uint32_t moving = window.frame().moving;
  const Step* longest = nullptr;
  double best = -1;
  for (const Step& s : loop.steps) {
    const LiveSegment& on = window.segments[window.pieces[s.piece].segment];
    const double l = (end_cut(s, true).t.at(tau) - end_cut(s, false).t.at(tau)) * (std::abs(on.dx) + std::abs(on.dy));
    if (l > best) {
      best = l;
      longest = &s;
    }
  }
  const std::uint32_t segment = window.pieces[longest->piece].segment;
  const LiveSegment& on = window.segments[segment];
  const Cutting from = end_cut(*longest, false), to = end_cut(*longest, true);
  // Denominators of crossings with an edge of the scaled operand grow with the scale; all are integers over the scale's denominator.
  const auto weight_of = [&](const Cutting& c) {
    if (c.cut.kind == Cut::Kind::pair) return c.denominator;
    const double den = exact::round_to_double(exact::BigRational(place.value().den));
    return c.denominator * den * (c.cut.by.edge.op == place.base().scaled ? place.value().approx : 1);
  };
  const double d0 = weight_of(from), d1 = weight_of(to), t0 = from.t.at(tau), t1 = to.t.at(tau);
  double weight = d0 + d1 > 0 ? d1 / (d0 + d1) : 0.5, relative = from.relative_error + to.relative_error + 0x1p-50;
  if (!(weight >= 0 && weight <= 1)) {
    weight = 0.5;
    relative = 1;
  }
  const double t = t0 + weight * (t1 - t0), t_error = from.error + to.error + std::abs(t1 - t0) * 2 * relative + 0x1p-49 * std::max(1.0, tau);
  Place p;
  p.on = window.exact(segment);
  p.first = from.cut;
  p.second = to.cut;
  p.between = true;
  const double grow = place.blow_up(moving);
  p.x = grow * (on.x.at(tau) + t * on.dx);
  p.y = grow * (on.y.at(tau) + t * on.dy);
  p.error = grow * (t_error * std::max(std::abs(on.dx), std::abs(on.dy)) + kPoint * window.span()) * (1 + 0x1p-40);
  if (!std::isfinite(p.error)) {
    // Nearly parallel lines, of which the doubles know nothing: the exact position, rounded.
    const Lattice& l = place.lattice();
    const Lattice::Position at = l.position(p);
    const Place origin{window.exact(segment), {Cut::Kind::pair, start_of(window.exact(segment)), {}}, {}, false, 0, 0, 0};
    const Lattice::Position start = l.position(origin);
    p.x = grow * on.x.at(tau) + exact::round_to_double(exact::BigRational(at.x - start.x)) / l.unit;
    p.y = grow * on.y.at(tau) + exact::round_to_double(exact::BigRational(at.y - start.y)) / l.unit;
    p.error = grow * 0x1p-48 * window.span();
  }
  return p;
}

// The remembered edges cross properly when Q, reflected, stands at some point of the loop, and so they do at a point just right of it.
bool FrameLoops::witnessed(const FrameLoop& loop, double tau) const {
  const Window& window = lists_.window();
  const Step s = loop.steps[0];
  const LiveSegment& on = window.segments[window.pieces[s.piece].segment];
  const Cutting from = end_cut(s, false), to = end_cut(s, true);
  const double t = 0.5 * (from.t.at(tau) + to.t.at(tau));
  const double x = on.x.at(tau) + t * on.dx, y = on.y.at(tau) + t * on.dy;
  const double error = (from.error + to.error + 0x1p-49 * std::max(1.0, tau)) * std::max(std::abs(on.dx), std::abs(on.dy)) + kPoint * window.span();
  return crosses_at(*loop.witness, x, y, error, tau);
}

// Doubles only: the edges of both operands cross properly when Q, reflected, stands at (x, y).
bool FrameLoops::crosses_at(const std::array<std::uint32_t, 2>& edges, double x, double y, double error, double tau) const {
  const Window& window = lists_.window();
  const std::uint32_t m = window.frame().moving;
  const Lattice& l = *window.base().lattice;
  const auto sides = [&](std::uint32_t op, std::uint32_t edge, std::uint32_t other_edge) {
    const Operand &o = window.base().operands[op], &other = window.base().operands[1 - op];
    const std::uint32_t a = o.source[edge];
    const double ex = o.ex[edge], ey = o.ey[edge], bound = (std::abs(ex) + std::abs(ey)) * (error + 0x1p-48 * window.span());
    const auto value = [&](std::uint32_t v) {
      const double sx = (op == m ? tau : 1) * l.points[op]->x[a] + (op == m ? 1 : tau) * l.points[1 - op]->x[v];
      const double sy = (op == m ? tau : 1) * l.points[op]->y[a] + (op == m ? 1 : tau) * l.points[1 - op]->y[v];
      return ex * (y - sy) - ey * (x - sx);
    };
    const double u = value(other.source[other_edge]), v = value(other.source[other.next[other_edge]]);
    return (u > bound && v < -bound) || (u < -bound && v > bound);
  };
  const auto [e, f] = edges;
  return sides(0, e, f) && sides(1, f, e);
}

MovingVertex FrameLoops::vertex_after(Step s, std::uint32_t in, std::uint32_t out) const {
  const Window& window = lists_.window();
  const LiveSegment& on = window.segments[window.pieces[s.piece].segment];
  MovingVertex v;
  v.error = kPoint * window.span();
  const bool end = s.sub == lists_.count(s.piece);
  const std::uint32_t entry = end ? kNone : lists_.entry(s.piece, s.sub);
  if (end || entry & kTouchBit) {
    const WalkPair at = end ? on.end : window.nodes[window.touches[entry & ~kTouchBit].node].at;
    v.vertex.corner_p = window.base().operands[0].vertex_number[at.p];
    v.vertex.corner_q = window.base().operands[1].vertex_number[at.q];
    const Lattice& l = *window.base().lattice;
    const Pair x = window.exact(at);
    const std::uint32_t m = window.frame().moving, move = m == 0 ? x.p : x.q, rest = m == 0 ? x.q : x.p;
    v.x = {l.points[1 - m]->x[rest], l.points[m]->x[move]};
    v.y = {l.points[1 - m]->y[rest], l.points[m]->y[move]};
  } else {
    const Candidate& c = window.candidates[entry];
    const LiveSegment &a = window.segments[window.pieces[c.a].segment], &b = window.segments[window.pieces[c.b].segment];
    const double ea = c.error_a * std::max(std::abs(a.dx), std::abs(a.dy)), eb = c.error_b * std::max(std::abs(b.dx), std::abs(b.dy));
    const LiveSegment& best = ea <= eb ? a : b;
    const Linear& t = ea <= eb ? c.ta : c.tb;
    v.x = {best.x.a + best.dx * t.a, best.x.b + best.dx * t.b};
    v.y = {best.y.a + best.dy * t.a, best.y.b + best.dy * t.b};
    v.error += std::min(ea, eb);
    // Where the line is followed far outside the piece, a and b cancel at tau.
    v.error += 0x1p-50 * (std::abs(v.x.a) + std::abs(v.y.a) + (std::abs(v.x.b) + std::abs(v.y.b)) * window.frame().tau1);
  }
  v.vertex.in = window.segments[in].contact;
  v.vertex.out = window.segments[out].contact;
  return v;
}

void FrameLoops::make_vertices(FrameLoop& loop, const std::vector<FrameLoop>& gone, std::vector<std::uint8_t>& claimed) const {
  const Window& window = lists_.window();
  loop.vertices.clear();
  loop.vertices.reserve(loop.steps.size());
  std::uint32_t from = kNone;
  for (std::size_t i = 0; i < loop.steps.size(); ++i) {
    const Step &s = loop.steps[i], &t = loop.steps[i + 1 == loop.steps.size() ? 0 : i + 1];
    const Piece& p = window.pieces[s.piece];
    if (lists_.end_node(s) != kNone ? window.cross(p.segment, window.pieces[t.piece].segment) == 0
                                    : s.sub == lists_.count(s.piece) && p.next_turn == 0)
      continue;  // straight on
    loop.vertices.push_back(vertex_after(s, p.segment, window.pieces[t.piece].segment));
    const Owner& owner = owners_[s.piece];
    if (gone.empty() || owner.walk != walk_ || gone[owner.loop].edges[owner.edge].to != loop.edges[i].to) continue;
    // The first ring with a common vertex lends its identity.
    if (from == kNone && gone[owner.loop].kept && !claimed[owner.loop]) {
      from = owner.loop;
      claimed[from] = 1;
      loop.ring = gone[from].ring;
      loop.vertices_before = static_cast<std::uint32_t>(gone[from].vertices.size());
    }
    loop.vertices_shared += owner.loop == from;
  }
}

}  // namespace dymsum::planar
