#include "planar/boundary/boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

namespace dymsum::planar {

int turning_number(const Soup& soup, const Array<Step>& steps) {
  const SoupBox* boxes = soup.boxes.data();
  int turns = 0;
  std::uint32_t last = steps.back().segment;
  int from = half_plane(boxes[last].dx, boxes[last].dy);
  for (const Step& step : steps) {
    const std::uint32_t s = step.segment;
    const int to = half_plane(boxes[s].dx, boxes[s].dy);
    if (from != to) {
      const int c = soup.cross(last, s);
      if (c > 0 && from == 1) ++turns;
      if (c < 0 && from == 0) --turns;
    }
    last = s;
    from = to;
  }
  return turns;
}

Array<BoundaryLoop> find_loops(const Soup& soup, const Arrangement& arrangement, const Poll* poll) {
  Array<BoundaryLoop> loops(soup.memory);
  Array<std::uint8_t> seen(arrangement.sub_count(), 0, soup.memory);
  Array<Step> path(soup.memory);
  path.reserve(arrangement.sub_count());
  const Arrangement::Walker walker(arrangement);
  const std::uint32_t segments = static_cast<std::uint32_t>(soup.size());
  std::uint8_t* const visited = seen.data();
  Step* const steps = path.data();
  for (std::uint32_t s = 0, sub = 0; s < segments; ++s) {
    if (poll != nullptr) poll->at(s, segments);
    for (const std::uint32_t end = walker.end(s); sub < end; ++sub) {
      if (visited[sub]) continue;
      const Step start{sub, s};
      if (!walker.alive_at_start(start)) continue;
      // The successor map is injective, so a walk either comes back to its start or belongs to no cycle.
      Step* last = steps;
      std::uint32_t at = sub, segment = s;
      do {
        visited[at] = 1;
        last->sub = at;
        last->segment = segment;
        ++last;
      } while (walker.advance(at, segment) && !visited[at]);
      if (at != sub) continue;
      BoundaryLoop& loop = loops.emplace_back(BoundaryLoop{Array<Step>(steps, last, soup.memory), 0});
      loop.turning = turning_number(soup, loop.steps);
    }
  }
  return loops;
}

namespace {

// The loop that is the outer boundary of a connected sum: the only counter-clockwise one, or of several false ones that
// which reaches farthest left. loops.size() when doubles do not decide.
std::size_t outer_loop(const Arrangement& arrangement, const Array<BoundaryLoop>& loops) {
  std::size_t outer = loops.size(), count = 0;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (loops[i].turning > 0) {
      outer = i;
      ++count;
    }
  if (count <= 1) return outer;
  const auto for_each_end = [&](std::size_t i, auto&& f) {
    for (const Step& step : loops[i].steps) {
      const Arrangement::RoundedEnd p = arrangement.rounded_end(step);
      f(p.x, p.error);
    }
  };
  return leftmost_loop(
      loops.size(), [&](std::size_t i) { return loops[i].turning < 0; }, for_each_end);
}

// Whether the midpoint of a sub-edge is covered: then the loop is false.
bool passes_covered(const Soup& soup, const Arrangement& arrangement, const BoundaryLoop& loop,
                    const KnownCover& cover) {
  return std::any_of(loop.steps.begin(), loop.steps.end(), [&](const Step& step) {
    const SoupBox& b = soup.boxes[step.segment];
    const double midpoint = 0.5 * (arrangement.start_parameter(step) + arrangement.end_parameter(step));
    return cover.covers(b.ax + midpoint * b.dx, b.ay + midpoint * b.dy) &&
           arrangement.inner_parameter(step).has_value();
  });
}

// The longest sub-edge gives the sample that is easiest to decide.
const Step& longest_step(const Soup& soup, const Arrangement& arrangement, const BoundaryLoop& loop) {
  const auto length = [&](const Step& s) {
    return (arrangement.end_parameter(s) - arrangement.start_parameter(s)) *
           (std::abs(soup.dx(s.segment)) + std::abs(soup.dy(s.segment)));
  };
  const Step* longest = &loop.steps[0];
  double best = length(*longest);
  for (const Step& step : loop.steps)
    if (const double l = length(step); l > best) {
      best = l;
      longest = &step;
    }
  return *longest;
}

}  // namespace

SortedLoops verify_loops(const Soup& soup, const Arrangement& arrangement, Array<BoundaryLoop> loops,
                         Collision& collision, bool connected, const KnownCover& cover, const Poll* poll) {
  SortedLoops out{Array<BoundaryLoop>(soup.memory), Array<BoundaryLoop>(soup.memory)};
  const std::size_t outer = connected ? outer_loop(arrangement, loops) : loops.size();
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (poll != nullptr) poll->at_test(i, loops.size());
    bool keep = i == outer;
    if (!keep && (outer == loops.size() || loops[i].turning < 0) &&
        (cover.mask == nullptr || !passes_covered(soup, arrangement, loops[i], cover)))
      keep = !collision.overlaps_right_of(arrangement.sample(longest_step(soup, arrangement, loops[i])));
    (keep ? out.kept : out.dropped).push_back(std::move(loops[i]));
  }
  return out;
}

double position_error(const Soup& soup, const SegmentPosition& position) {
  return std::min(position.error, kPoorPosition * soup.lattice.span);
}

SumVertex vertex_of(const Soup& soup, std::uint32_t in, std::uint32_t out, const SubEnd& end,
                    const SegmentPosition& position) {
  SumVertex v;
  v.in = contact_of(soup, in);
  v.out = contact_of(soup, out);
  if (end.pair) {
    v.corner_p = soup.operands[0]->vertex_index[end.at.p];
    v.corner_q = soup.operands[1]->vertex_index[end.at.q];
  }
  if (position_error(soup, position) < position.error) {
    // Nearly parallel lines: the doubles know too little.
    const Lattice::Position p = soup.lattice.position(position);
    v.at = {exact::round_to_double(p.x), exact::round_to_double(p.y)};
  } else {
    v.at = soup.lattice.to_input(position.x, position.y);
  }
  return v;
}

// The sum of the offsets errs by u of itself, the final sum by u of itself and by no more than what is added to the
// base: with R the reach and S the span, both by at most 2 u (R + S). (By 2 u R + u S, but for terms of u^2 R; those
// are less than u S where S > u R, and else the final sum errs by S at most.) Products may be subnormal besides.
constexpr double kInput = 2 * exact::kRoundoff;

double rounding_error(const Lattice& lattice) {
  return kInput * (lattice.base_reach + lattice.span * lattice.unit) + lattice.base_error + exact::kSubnormal;
}

double input_error(const Lattice& lattice, double grid_error) {
  if (grid_error == 0 && lattice.exact_input) return 0;
  return grid_error * lattice.unit + rounding_error(lattice);
}

namespace {

// contact_of, with the pair of vertices at the segment's end, for all vertices of a ring. Numbers one by one: a
// structure that is written in parts and read at once makes the processor wait.
struct Named {
  Contact::Kind kind;
  std::uint32_t p, q, corner_p, corner_q;
};
inline Named named(SoupSegment g, const Operand::Indices* of_p, const Operand::Indices* of_q) {
  if (g.side() == 0) {
    const Operand::Indices& own = of_p[g.edge()];
    const std::uint32_t q = of_q[g.vertex].vertex;
    return {Contact::Kind::edge_of_p, own.edge, q, own.next_vertex, q};
  }
  const Operand::Indices& own = of_q[g.edge()];
  const std::uint32_t p = of_p[g.vertex].vertex;
  return {Contact::Kind::edge_of_q, p, own.edge, p, own.next_vertex};
}
inline void set(Contact& contact, const Named& n) {
  contact.kind = n.kind;
  contact.p = n.p;
  contact.q = n.q;
}

// The step that ends at the lexicographically smallest vertex, crossings aside, as far as doubles decide: a ring that
// starts there hardly has to be rotated. (A crossing on an outer boundary is a notch.)
std::size_t leftmost_end(const Soup& soup, const Arrangement::Walker& walker, const Array<Step>& steps) {
  const SoupBox* boxes = soup.boxes.data();
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity(), low = least;
  for (std::size_t i = 0, n = steps.size(); i < n; ++i) {
    const SoupBox& b = boxes[steps[i].segment];
    if (b.bx > least || (b.bx == least && b.by > low) || !walker.ends_segment(steps[i])) continue;
    least = b.bx;
    low = b.by;
    best = i;
  }
  return best;
}

}  // namespace

SumRing make_ring(const Soup& soup, const Arrangement& arrangement, const BoundaryLoop& loop, double& error) {
  const Step* const steps = loop.steps.data();
  const std::size_t n = loop.steps.size();
  const double poor = kPoorPosition * soup.lattice.span, unit = soup.lattice.unit;
  const Point base = soup.lattice.base;
  const Operand::Indices *const of_p = soup.operands[0]->indices.data(), *const of_q = soup.operands[1]->indices.data();
  const SoupBox* const boxes = soup.boxes.data();
  const SoupSegment* const segments = soup.segments.data();
  const Arrangement::Walker walker(arrangement);
  SumRing ring;
  ring.vertices.resize(n);
  SumVertex* to = ring.vertices.data();
  double worst = error;
  bool ends = false;
  std::size_t i = leftmost_end(soup, walker, loop.steps);
  Named in = named(segments[steps[i].segment], of_p, of_q);
  for (std::size_t count = 0; count < n; ++count) {
    const std::uint32_t s = steps[i].segment, sub = steps[i].sub;
    i = i + 1 == n ? 0 : i + 1;
    const std::uint32_t next = steps[i].segment;
    if (s == next) continue;
    const Named out = named(segments[next], of_p, of_q);
    if (soup.cross(s, next) == 0) {  // straight on
      in = out;
      continue;
    }
    SumVertex& v = *to++;
    set(v.in, in);
    set(v.out, out);
    if (sub + 1 == walker.end(s)) [[likely]] {
      ends = true;
      v.at.x = boxes[s].bx * unit + base.x;
      v.at.y = boxes[s].by * unit + base.y;
      v.corner_p = in.corner_p;
      v.corner_q = in.corner_q;
    } else if (const Arrangement::RoundedEnd at = arrangement.rounded_end({sub, s}); at.error > poor) [[unlikely]] {
      const Step step{sub, s};
      const SegmentPosition position = arrangement.end_position(step);
      worst = std::max(worst, position_error(soup, position));
      v = vertex_of(soup, s, next, arrangement.end_of(step), position);
    } else {
      worst = std::max(worst, at.error);
      v.at.x = at.x * unit + base.x;
      v.at.y = at.y * unit + base.y;
      if (const SubEnd end = arrangement.end_of({sub, s}); end.pair) {
        v.corner_p = soup.operands[0]->vertex_index[end.at.p];
        v.corner_q = soup.operands[1]->vertex_index[end.at.q];
      }
    }
    in = out;
  }
  ring.vertices.resize(static_cast<std::size_t>(to - ring.vertices.data()));
  error = ends ? std::max(worst, soup.point_error) : worst;
  return ring;
}

// Loops that meet at nodes, cut and joined to simple rings.

namespace {

// A sub-edge at a node, by its direction away from the node.
struct Ray {
  Step step;
  bool out;
};

// The rays counter-clockwise from +x; those of one direction stand together.
void sort_rays(const Soup& soup, std::vector<Ray>& rays) {
  const auto half = [&](const Ray& r) {
    const SoupBox& b = soup.boxes[r.step.segment];
    return half_plane(b.dx, b.dy) ^ (r.out ? 0 : 1);
  };
  std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) {
    if (half(a) != half(b)) return half(a) < half(b);
    return soup.cross(a.step.segment, b.step.segment) * (a.out == b.out ? 1 : -1) > 0;
  });
}

// The successors of the kept sub-edges, joined anew at nodes that loops pass several times.
class Joined {
 public:
  Joined(const Soup& soup, const Arrangement& arrangement, const Array<BoundaryLoop>& loops,
         const Array<std::uint32_t>& visits)
      : soup_(soup), arrangement_(arrangement) {
    std::unordered_map<std::uint32_t, std::vector<Ray>> nodes;
    for (const BoundaryLoop& loop : loops)
      for (std::size_t i = 0; i < loop.steps.size(); ++i) {
        const Step &in = loop.steps[i], &out = loop.steps[(i + 1) % loop.steps.size()];
        next_[in.sub] = out;
        order_.push_back(in);
        const std::uint32_t node = arrangement.end_node(in);
        if (node == kNone || visits[node] < 2) continue;
        nodes[node].push_back({in, false});
        nodes[node].push_back({out, true});
      }
    for (auto& [node, rays] : nodes) {
      sort_rays(soup, rays);
      for (std::size_t i = 0; i < rays.size(); ++i)
        if (!rays[i].out) next_[rays[i].step.sub] = rays[(i + rays.size() - 1) % rays.size()].step;
    }
  }

  /// Cut where they come back to a node.
  Array<BoundaryLoop> rings() {
    Array<BoundaryLoop> rings(soup_.memory);
    for (const Step& start : order_)
      if (!seen_[start.sub]) follow(start, rings);
    return rings;
  }

 private:
  void follow(Step start, Array<BoundaryLoop>& rings) {
    std::vector<Step> path;
    std::unordered_map<std::uint32_t, std::size_t> at_node;  // node -> length of the path that ends there
    const auto emit = [&](std::size_t from) {
      BoundaryLoop ring;
      ring.steps.assign(path.begin() + static_cast<std::ptrdiff_t>(from), path.end());
      ring.turning = turning_number(soup_, ring.steps);
      for (std::size_t i = from; i + 1 < path.size(); ++i)
        if (const std::uint32_t n = arrangement_.end_node(path[i]); n != kNone) at_node.erase(n);
      path.resize(from);
      rings.push_back(std::move(ring));
    };
    Step at = start;
    do {
      seen_[at.sub] = true;
      path.push_back(at);
      if (const std::uint32_t node = arrangement_.end_node(at); node != kNone) {
        if (const auto it = at_node.find(node); it != at_node.end()) emit(it->second);
        else at_node[node] = path.size();
      }
      at = next_[at.sub];
    } while (at.sub != start.sub);
    if (!path.empty()) emit(0);
  }

  const Soup& soup_;
  const Arrangement& arrangement_;
  std::unordered_map<std::uint32_t, Step> next_;  // by sub-edge
  std::unordered_map<std::uint32_t, bool> seen_;
  std::vector<Step> order_;
};

}  // namespace

// At a node that several kept passes share, every pass in is joined to the next way out clockwise from it: interior
// pairing. Rings then bound connected interiors; those that still meet themselves are cut at the repeated node.
Array<BoundaryLoop> simple_rings(const Soup& soup, const Arrangement& arrangement, Array<BoundaryLoop> loops) {
  if (arrangement.degenerate_nodes() == 0) return loops;
  Array<std::uint32_t> visits(arrangement.degenerate_nodes() + 1, 0, soup.memory);
  bool repeated = false;
  for (const BoundaryLoop& loop : loops)
    for (const Step& step : loop.steps)
      if (const std::uint32_t node = arrangement.end_node(step); node != kNone) repeated |= ++visits[node] > 1;
  return repeated ? Joined(soup, arrangement, loops, visits).rings() : std::move(loops);
}

// Cracks and punctures: candidates of the arrangement that are not inside the open sum.
// A sector that no segment covers may still lie inside: where a chain ends at a reflex vertex its contact covers more
// than the half discs of its segments. So every node off the boundary is tested, not only those whose sectors are all
// covered.
void find_tight_features(const Soup& soup, const Arrangement& arrangement, const Array<BoundaryLoop>& kept,
                         Collision& collision, RawBoundary& out, double& grid_error, const Poll* poll) {
  const std::size_t rounds = arrangement.covered_subs().size() + arrangement.nodes().size();
  std::size_t round = 0;
  if (arrangement.nodes().empty()) return;
  Array<std::uint8_t> on_boundary(arrangement.degenerate_nodes() + 1, 0, soup.memory);
  for (const BoundaryLoop& loop : kept)
    for (const Step& step : loop.steps)
      if (const std::uint32_t node = arrangement.end_node(step); node != kNone) on_boundary[node] = 1;
  for (const Step& step : arrangement.covered_subs()) {
    if (poll != nullptr) poll->at_test(round++, rounds);
    if (collision.overlaps(arrangement.sample(step))) continue;
    const SegmentPosition from = arrangement.start_position(step), to = arrangement.end_position(step);
    const SubEnd a = arrangement.start_of(step), b = arrangement.end_of(step);
    grid_error = std::max({grid_error, position_error(soup, from), position_error(soup, to)});
    const std::uint32_t s = step.segment;
    out.cracks.push_back(
        {vertex_of(soup, s, a.pair ? s : a.other, a, from), vertex_of(soup, s, b.pair ? s : b.other, b, to)});
  }
  for (const Arrangement::Node& node : arrangement.nodes()) {
    if (poll != nullptr) poll->at_test(round++, rounds);
    if (on_boundary[node.index] != 0) continue;
    const SegmentPosition position = arrangement.position_of(node);
    if (collision.overlaps(position)) continue;
    grid_error = std::max(grid_error, position_error(soup, position));
    out.punctures.push_back(
        vertex_of(soup, node.segment, node.end.pair ? node.segment : node.end.other, node.end, position));
  }
}

}  // namespace dymsum::planar
