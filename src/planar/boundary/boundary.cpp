#include "planar/boundary/boundary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planar/boundary/leftmost_loop.h"

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

}  // namespace dymsum::planar
