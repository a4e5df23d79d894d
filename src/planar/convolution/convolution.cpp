#include "planar/convolution/convolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "dymsum/planar_sum.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {
namespace {

// Finds for every position of `own` the number of directions in `other` that are less, or (upper) not greater: one
// merge. Counts the positions that have an equal direction, unless upper.
template <bool upper>
std::size_t merge_positions(const Lattice& lattice, const Operand& own_op, const DirectionList& own,
                            const Operand& other_op, const DirectionList& other, Array<std::uint32_t>& bound) {
  const std::size_t n = own.edges.size(), m = other.edges.size();
  bound.resize(n);
  std::size_t at = 0, equal = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double key = own.keys[i];
    for (; at < m; ++at) {
      const double gap = other.keys[at] - key;
      if (gap < -kAngleError) continue;
      if (gap > kAngleError) break;
      const int c = compare_directions(lattice, other_op.edge(other.edges[at]), own_op.edge(own.edges[i]));
      if (!upper) equal += c == 0;
      if (c > 0 || (c == 0 && !upper)) break;
    }
    bound[i] = static_cast<std::uint32_t>(at);
  }
  return equal;
}

// Both at once for a list of P and a list of Q: for every position of Q's the directions of P that are not greater, for
// every position of P's the directions of Q that are less. Returns how many positions of P have an equal direction.
std::size_t merge_both(const Lattice& lattice, const Operand& p, const DirectionList& of_p, const Operand& q,
                       const DirectionList& of_q, Array<std::uint32_t>& bound_q, Array<std::uint32_t>& bound_p) {
  const auto n = static_cast<std::uint32_t>(of_p.edges.size()), m = static_cast<std::uint32_t>(of_q.edges.size());
  bound_p.resize(n);
  bound_q.resize(m);
  std::uint32_t i = 0, j = 0;
  std::size_t equal = 0;
  for (; i < n && j < m;) {
    const double gap = of_q.keys[j] - of_p.keys[i];
    bool p_first = gap > 0;
    if (gap <= kAngleError && gap >= -kAngleError) {
      const int c = compare_directions(lattice, q.edge(of_q.edges[j]), p.edge(of_p.edges[i]));
      equal += c == 0;
      p_first = c >= 0;
    }
    if (p_first) bound_p[i++] = j;
    else bound_q[j++] = i;
  }
  for (; i < n; ++i) bound_p[i] = m;
  for (; j < m; ++j) bound_q[j] = n;
  return equal;
}

}  // namespace

// Widths are differences of input coordinates, compared exactly: as edges of the two operands along an axis they need
// no new sign.
bool hole_is_filled(const Lattice& lattice, const Operand& holed, const Loop& hole, const Operand& other,
                    const Component& component) {
  if (component.dimension != 2) return false;
  const Loop& outer = other.loops[component.first_loop];
  return lattice.compare_extent({holed.op, hole.min_x, hole.max_x}, {other.op, outer.min_x, outer.max_x}, 0) < 0 ||
         lattice.compare_extent({holed.op, hole.min_y, hole.max_y}, {other.op, outer.min_y, outer.max_y}, 1) < 0;
}

ReducedConvolution::ReducedConvolution(const Lattice& lattice, const Operand& p, const Operand& q, Scratch* memory)
    : ReducedConvolution(
          lattice, p, q,
          [&lattice](const Operand& holed, const Loop& hole, const Operand& other, const Component& component) {
            return hole_is_filled(lattice, holed, hole, other, component);
          },
          memory) {}

ReducedConvolution::ReducedConvolution(const Lattice& lattice, const Operand& p, const Operand& q, HoleFilled filled,
                                       Scratch* memory)
    : lattice_(lattice),
      filled_(std::move(filled)),
      operands_{&p, &q},
      turns_{Array<Turn>(memory), Array<Turn>(memory)},
      used_{Array<std::uint32_t>(memory), Array<std::uint32_t>(memory)},
      lists_(memory) {
  for (const Operand* o : operands_)
    for (const DirectionList& list : o->directions) lists_.push_back(&list);
  for (std::uint32_t side = 0; side < 2; ++side) {
    columns_[side] = static_cast<std::uint32_t>(operands_[side]->components.size());
    turns_[side].resize(operands_[1 - side]->size() * std::size_t{columns_[side]});
  }
  for (std::uint32_t cp = 0; cp < p.components.size(); ++cp)
    for (std::uint32_t cq = 0; cq < q.components.size(); ++cq)
      if (p.components[cp].dimension == 2 || q.components[cq].dimension == 2) add_pair(cp, cq, memory);
  for (std::uint32_t side = 0; side < 2; ++side) {
    const auto n = static_cast<std::uint32_t>(turns_[side].size());
    Turn* const all = turns_[side].data();
    used_[side].resize(n);
    std::uint64_t size = size_;
    std::uint32_t* used = used_[side].data();
    for (std::uint32_t k = 0; k < n; ++k) {
      all[k].base = static_cast<std::uint32_t>(size);
      size += all[k].count;
      *used = k;
      used += all[k].count != 0;
    }
    used_[side].resize(static_cast<std::size_t>(used - used_[side].data()));
    if (size >= kNoRank) throw std::length_error("more than 2^32 segments");
    size_ = static_cast<std::uint32_t>(size);
  }
  filled_ = nullptr;  // what it looks at may be gone from now on
}

// The holes of one operand's component that the other one's fills, and the lists of its edges without them.
struct ReducedConvolution::Edges {
  std::uint32_t component = 0;
  std::vector<std::uint8_t> filled;      // per loop; empty where the component has no holes
  std::uint32_t whole = 0;               // the list of all its edges
  std::array<std::uint32_t, 2> lists{};  // of those that outer loops meet, and holes
  bool is_filled(std::uint32_t loop) const { return !filled.empty() && filled[loop] != 0; }
};

ReducedConvolution::Edges ReducedConvolution::edges_of(std::uint32_t op, std::uint32_t component,
                                                       std::uint32_t other_component) {
  const Operand &o = *operands_[op], &other = *operands_[1 - op];
  const Component &c = o.components[component], &d = other.components[other_component];
  Edges edges;
  edges.component = component;
  edges.lists = o.component_directions[component];
  if (op == 1)
    for (std::uint32_t& list : edges.lists) list += static_cast<std::uint32_t>(other.directions.size());
  edges.whole = edges.lists[0];
  const std::uint32_t holes = c.last_loop - c.first_loop - 1;
  if (holes == 0) return edges;
  edges.filled.assign(o.loops.size(), 0);
  std::size_t count = 0;
  for (std::uint32_t l = c.first_loop + 1; l < c.last_loop; ++l)
    if (filled_(o, o.loops[l], other, d)) {
      edges.filled[l] = 1;
      ++count;
    }
  filled_holes_ += count;
  if (count == holes) {
    edges.lists[0] = edges.lists[1];
  } else if (count > 0) {
    std::vector<std::uint8_t> keep(edges.filled);
    for (std::uint8_t& k : keep) k = !k;
    own_lists_.push_front(sublist(*lists_[edges.whole], o, c, keep));
    edges.lists[0] = static_cast<std::uint32_t>(lists_.size());
    lists_.push_back(&own_lists_.front());
  }
  return edges;
}

void ReducedConvolution::add_pair(std::uint32_t cp, std::uint32_t cq, Scratch* memory) {
  const std::array<Edges, 2> edges{edges_of(0, cp, cq), edges_of(1, cq, cp)};
  std::array<Bounds, 2> bounds{Bounds(memory), Bounds(memory)};
  const auto single_loop = [&](std::uint32_t op) {
    const Component& c = operands_[op]->components[edges[op].component];
    return c.last_loop - c.first_loop == 1 && c.dimension > 0;
  };
  if (single_loop(0) && single_loop(1))
    parallel_edges_ += merge_both(lattice_, *operands_[0], *lists_[edges[0].whole], *operands_[1],
                                  *lists_[edges[1].whole], bounds[0].of_outer, bounds[1].of_outer);
  for (std::uint32_t side = 0; side < 2; ++side) add_turns(side, edges[side], edges[1 - side], bounds[side]);
}

// The turns of the vertices of one component among the edges of the other.
void ReducedConvolution::add_turns(std::uint32_t side, const Edges& edges, const Edges& vertices, Bounds& bounds) {
  const Operand &edge_operand = *operands_[side], &o = *operands_[1 - side];
  const Component& c = o.components[vertices.component];
  const DirectionList& own = *lists_[vertices.whole];
  for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l) {
    if (vertices.is_filled(l)) continue;
    const Loop& loop = o.loops[l];
    // Hole against hole cannot touch without overlap elsewhere.
    const bool hole = loop.kind == LoopKind::hole;
    const std::uint32_t list = edges.lists[hole ? 1 : 0];
    const std::uint32_t n = static_cast<std::uint32_t>(lists_[list]->edges.size());
    if (loop.kind == LoopKind::point) {
      turns_[side][std::size_t{loop.first} * columns_[side] + edges.component] = {list, 0, n, 0};
      continue;
    }
    if (n == 0) continue;
    // Half-open turns with opposite ends: (in, out] against edges of P, [in, out) against edges of Q.
    Array<std::uint32_t>& bound = hole ? bounds.of_hole : bounds.of_outer;
    if (bound.empty()) {
      if (side == 0) merge_positions<true>(lattice_, o, own, edge_operand, *lists_[list], bound);
      else parallel_edges_ += merge_positions<false>(lattice_, o, own, edge_operand, *lists_[list], bound);
    }
    Turn* const turns_at = turns_[side].data() + edges.component;
    const std::uint32_t columns = columns_[side];
    const std::uint32_t *const rank = own.rank.data(), *const positions = bound.data(), *const prev = o.prev.data();
    const std::uint8_t* const convex = o.convex.data();
    for (std::uint32_t v = loop.first; v < loop.last; ++v) {
      if (!convex[v]) continue;
      const std::uint32_t in = rank[prev[v] - own.base], out = rank[v - own.base];
      const std::uint32_t lo = positions[in], hi = positions[out];
      const bool wraps = out < in;
      Turn& t = turns_at[std::size_t{v} * columns];
      t.list = list;
      t.lo = lo == n ? 0 : lo;
      t.count = hi - lo + (wraps ? n : 0);
    }
  }
}

std::uint32_t ReducedConvolution::find(std::uint32_t side, std::uint32_t edge, std::uint32_t vertex) const {
  const std::uint32_t component = columns_[side] == 1 ? 0 : operands_[side]->component_of[edge];
  return id(turns_[side][std::size_t{vertex} * columns_[side] + component], edge);
}

std::uint32_t ReducedConvolution::next(const WalkSegment& s) const {
  const std::uint32_t turned = operands_[s.side]->next[s.edge];
  const std::uint32_t same_side = find(s.side, turned, s.vertex);
  if (same_side != kNoRank) return same_side;
  return find(1 - s.side, s.vertex, turned);
}

// A segment (e, v) is continued by (next e, v) where v still meets that edge, else by v's edge at the vertex after e.
void ReducedConvolution::fill_next(std::span<std::uint32_t> next) const {
  std::uint32_t* to = next.data();
  for (std::uint32_t side = 0; side < 2; ++side) {
    const Operand& other = *operands_[1 - side];
    const std::uint32_t* const o_next = operands_[side]->next.data();
    const std::uint32_t other_columns = columns_[1 - side];
    const Turn* const own_turns = turns_[side].data();
    const DirectionList* const* const lists = lists_.data();
    for (const std::uint32_t turn : used_[side]) {
      const Turn t = own_turns[turn];
      const std::uint32_t v = vertex_of(side, turn);
      const Turn* const turns_at = turns_[1 - side].data() + (other_columns == 1 ? 0 : other.component_of[v]);
      const DirectionList& list = *lists[t.list];
      const std::uint32_t n = static_cast<std::uint32_t>(list.edges.size());
      const std::uint32_t *const edges = list.edges.data(), *const follow = list.next.data();
      std::uint32_t at = t.lo;
      for (std::uint32_t* const end = to + t.count; to != end; ++to) {
        const std::uint32_t rank = follow[at], ahead = rank >= t.lo ? rank - t.lo : rank + n - t.lo;
        *to = ahead < t.count ? t.base + ahead : id(turns_at[std::size_t{o_next[edges[at]]} * other_columns], v);
        if (++at == n) at = 0;
      }
    }
  }
}

std::uint32_t ReducedConvolution::prev(const WalkSegment& s) const {
  const std::uint32_t same_side = find(s.side, operands_[s.side]->prev[s.edge], s.vertex);
  if (same_side != kNoRank) return same_side;
  return find(1 - s.side, operands_[1 - s.side]->prev[s.vertex], s.edge);
}

namespace {

std::vector<std::uint32_t> edges_by_direction(const Lattice& lattice, const Operand& o, const Component& c,
                                              const std::vector<std::uint8_t>& filled) {
  std::vector<std::uint32_t> edges;
  for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l) {
    const Loop& loop = o.loops[l];
    if (loop.kind == LoopKind::point || filled[l - c.first_loop]) continue;
    for (std::uint32_t i = loop.first; i < loop.last; ++i) edges.push_back(i);
  }
  std::sort(edges.begin(), edges.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int order = compare_directions(lattice, o.edge(a), o.edge(b));
    return order != 0 ? order < 0 : a < b;
  });
  return edges;
}

// The number of edges whose direction is less than that of d, or not greater (`equal_too`).
std::uint32_t count_below(const Lattice& lattice, const Operand& o, const std::vector<std::uint32_t>& edges,
                          const Edge& d, bool equal_too) {
  const auto at = std::partition_point(edges.begin(), edges.end(), [&](std::uint32_t e) {
    const int order = compare_directions(lattice, o.edge(e), d);
    return order < 0 || (equal_too && order == 0);
  });
  return static_cast<std::uint32_t>(at - edges.begin());
}

// The turns of the vertices of component c of operand o against the edges of a component of the other operand.
void component_turns(const Lattice& lattice, const Operand& o, const Component& c,
                     const std::vector<std::uint8_t>& filled, const Operand& other,
                     const std::vector<std::uint32_t>& edges, const std::function<void(const KineticTurn&)>& f) {
  const std::uint32_t n = static_cast<std::uint32_t>(edges.size());
  for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l) {
    const Loop& loop = o.loops[l];
    if (n == 0 || filled[l - c.first_loop]) continue;
    for (std::uint32_t v = loop.first; v < loop.last; ++v) {
      KineticTurn t{other.op, v, &edges, 0, n, 1};
      if (loop.kind != LoopKind::point) {
        Edge from = o.edge(o.prev[v]), to = o.edge(v);
        t.sign = o.convex[v] ? 1 : -1;
        const int order = compare_directions(lattice, from, to);
        if (order == 0) continue;  // straight on, where rings touch: no turn
        if (t.sign < 0) std::swap(from, to);
        // Operand 1 is the one that is turned: an edge of P parallel to the edge in of Q is not met, one parallel to
        // out is.
        t.lo = count_below(lattice, other, edges, from, o.op == 1);
        const std::uint32_t hi = count_below(lattice, other, edges, to, o.op == 1);
        t.count = order * t.sign < 0 ? hi - t.lo : hi + n - t.lo;
        if (t.lo == n) t.lo = 0;
      }
      f(t);
    }
  }
}

}  // namespace

void for_each_kinetic_turn(const Lattice& lattice, const Operand& p, const Operand& q,
                           const std::function<void(const KineticTurn&)>& f) {
  const std::array<const Operand*, 2> operands{&p, &q};
  for (const Component& cp : p.components)
    for (const Component& cq : q.components) {
      if (cp.dimension < 2 && cq.dimension < 2) continue;
      const std::array<const Component*, 2> c{&cp, &cq};
      std::array<std::vector<std::uint8_t>, 2> filled;
      std::array<std::vector<std::uint32_t>, 2> edges;
      for (std::uint32_t op = 0; op < 2; ++op) {
        const Operand& o = *operands[op];
        filled[op].assign(c[op]->last_loop - c[op]->first_loop, 0);
        for (std::uint32_t l = c[op]->first_loop + 1; l < c[op]->last_loop; ++l)
          filled[op][l - c[op]->first_loop] = hole_is_filled(lattice, o, o.loops[l], *operands[1 - op], *c[1 - op]);
        edges[op] = edges_by_direction(lattice, o, *c[op], filled[op]);
      }
      for (std::uint32_t op = 0; op < 2; ++op)
        component_turns(lattice, *operands[op], *c[op], filled[op], *operands[1 - op], edges[1 - op], f);
    }
}

std::vector<KineticSegment> kinetic_convolution(const Lattice& lattice, const Operand& p, const Operand& q) {
  std::vector<KineticSegment> segments;
  for_each_kinetic_turn(lattice, p, q, [&](const KineticTurn& t) {
    const std::uint32_t n = static_cast<std::uint32_t>(t.edges->size());
    for (std::uint32_t k = 0, at = t.lo; k < t.count; ++k, at = at + 1 == n ? 0 : at + 1)
      segments.push_back({{t.side, (*t.edges)[at], t.vertex}, t.sign});
  });
  return segments;
}

bool makes_parallelograms(Semantics semantics, const Operand& p, const Operand& q) {
  return semantics != Semantics::open && has_component_without_area(p) && has_component_without_area(q);
}

SumsWithoutArea sums_without_area(const Operand& p, const Operand& q) {
  SumsWithoutArea sums;
  const std::array<const Operand*, 2> operands{&p, &q};
  const auto add_edges = [&](std::uint32_t side, const std::vector<std::uint32_t>& edges,
                             const std::vector<std::uint32_t>& vertices) {
    for (const std::uint32_t e : edges)
      for (const std::uint32_t v : vertices) sums.segments.push_back({side, e, v});
  };
  // The first walk vertex of each position, and the first walk edge of each edge.
  const auto once = [](const Component& c, const auto& index_of) {
    std::vector<std::uint32_t> found;
    std::set<std::uint32_t> seen;
    for (std::uint32_t k = c.first; k < c.last; ++k)
      if (seen.insert(index_of(k)).second) found.push_back(k);
    return found;
  };
  std::array<std::vector<std::array<std::vector<std::uint32_t>, 2>>, 2> of;  // operand -> component: edges, vertices
  for (std::uint32_t op = 0; op < 2; ++op)
    for (const Component& c : operands[op]->components) {
      if (c.dimension == 2) continue;
      auto& [edges, vertices] = of[op].emplace_back();
      vertices = once(c, [&](std::uint32_t k) { return operands[op]->source[k]; });
      if (c.dimension == 1) edges = once(c, [&](std::uint32_t k) { return operands[op]->edge_index[k]; });
    }
  for (const auto& [edges_p, vertices_p] : of[0])
    for (const auto& [edges_q, vertices_q] : of[1]) {
      add_edges(0, edges_p, vertices_q);
      add_edges(1, edges_q, vertices_p);
      if (edges_p.empty() && edges_q.empty()) sums.points.push_back({vertices_p[0], vertices_q[0]});
    }
  return sums;
}

std::vector<WalkSegment> parallelogram_sides(const Lattice& lattice, const Operand& p, const Operand& q) {
  std::vector<WalkSegment> sides;
  for (const Component& cp : p.components)
    for (const Component& cq : q.components) {
      if (cp.dimension != 1 || cq.dimension != 1) continue;
      for (std::uint32_t e = cp.first; e < cp.last; ++e)
        for (std::uint32_t f = cq.first; f < cq.last; ++f) {
          if (lattice.cross(p.edge(e), q.edge(f)) <= 0) continue;
          sides.push_back({0, e, f});
          sides.push_back({1, f, p.next[e]});
        }
    }
  return sides;
}

}  // namespace dymsum::planar

namespace dymsum {

using namespace planar;

// A reflex vertex turns the short way in the kinetic convolution and the long way, counter-clockwise, in the full one:
// the two half-open arcs are complements.
ConvolutionSizes convolution_sizes(const Region& p, const Region& q) {
  ConvolutionSizes sizes;
  if (p.empty() || q.empty()) return sizes;
  std::shared_ptr<const Operand> kept_p = prepared_operand(p, 0), kept_q = prepared_operand(q, 1);
  const std::shared_ptr<const Lattice> lattice = make_lattice(kept_p->points, kept_q->points, 0);
  kept_p = placed_on(*lattice, std::move(kept_p));
  kept_q = placed_on(*lattice, std::move(kept_q));
  const Operand &op = *kept_p, &oq = *kept_q;
  for_each_kinetic_turn(*lattice, op, oq, [&](const KineticTurn& t) {
    sizes.kinetic += t.count;
    sizes.full += t.sign > 0 ? t.count : t.edges->size() - t.count;
  });
  sizes.reduced = ReducedConvolution(*lattice, op, oq).size();
  return sizes;
}

}  // namespace dymsum
