#include "planar/edit/followed_convolution.h"

#include <algorithm>
#include <utility>

namespace dymsum::planar {
namespace {

struct Item {
  double key;
  std::uint32_t edge;
};

// sort_by_direction's order.
bool comes_before(const OwnEdges& own, const Operand& o, const Item& a, const Item& b) {
  if (a.key < b.key - kAngleError) return true;
  if (a.key > b.key + kAngleError) return false;
  const int half_a = half_plane(o.ex[a.edge], o.ey[a.edge]), half_b = half_plane(o.ex[b.edge], o.ey[b.edge]);
  if (half_a != half_b) return half_a < half_b;
  const int sense = own.cross(o.edge(a.edge), o.edge(b.edge));
  return sense != 0 ? sense > 0 : a.edge < b.edge;
}

// Moves the entry at a position to another one; those between close up.
void move_entry(DirectionList& list, const Operand& o, std::size_t from, std::size_t to) {
  const auto rotate = [&](auto& values) {
    const auto f = values.begin() + static_cast<std::ptrdiff_t>(from),
               t = values.begin() + static_cast<std::ptrdiff_t>(to);
    if (from < to) std::rotate(f, f + 1, t + 1);
    else std::rotate(t, f, f + 1);
  };
  rotate(list.edges);
  rotate(list.keys);
  const std::size_t first = std::min(from, to), last = std::max(from, to);
  for (std::size_t k = first; k <= last; ++k) list.rank[list.edges[k] - list.base] = static_cast<std::uint32_t>(k);
  for (std::size_t k = first; k <= last; ++k) {
    const std::uint32_t e = list.edges[k];
    list.next[k] = list.rank[o.next[e] - list.base];
    list.next[list.rank[o.prev[e] - list.base]] = static_cast<std::uint32_t>(k);
  }
}

bool holds(const DirectionList& list, std::uint32_t edge) {
  return edge >= list.base && edge - list.base < list.rank.size() && list.rank[edge - list.base] != kNoRank;
}

}  // namespace

// One by one; those that are still to be moved have no order, and are passed over.
void sort_again(DirectionList& list, const OwnEdges& own, const Operand& o, std::span<const std::uint32_t> changed) {
  std::vector<std::uint8_t> waits(list.rank.size(), 0);
  for (const std::uint32_t e : changed)
    if (holds(list, e)) waits[e - list.base] = 1;
  for (const std::uint32_t e : changed) {
    if (!holds(list, e)) continue;
    const Point d = own.direction(o.source[e], o.source[o.next[e]]);
    const Item item{pseudo_angle(d.x, d.y), e};
    const std::size_t from = list.rank[e - list.base];
    list.keys[from] = item.key;
    std::size_t low = 0, high = list.edges.size();
    while (low < high) {
      const std::size_t halfway = low + (high - low) / 2;
      std::size_t at = halfway;
      while (at < high && waits[list.edges[at] - list.base]) ++at;
      if (at < high && comes_before(own, o, {list.keys[at], list.edges[at]}, item)) low = at + 1;
      else high = halfway;
    }
    waits[e - list.base] = 0;
    const std::size_t to = low > from ? low - 1 : low;
    if (to != from) move_entry(list, o, from, to);
  }
}

FollowedConvolution::FollowedConvolution(const Lattice& lattice, const Operand& p, const Operand& q)
    : ReducedConvolution(lattice, p, q), lattice_now_(&lattice) {
  if (can_follow()) find_lists();
}

bool FollowedConvolution::can_follow() const {
  return std::all_of(operands_.begin(), operands_.end(),
                     [](const Operand* o) { return o->components.size() == 1 && o->components[0].dimension == 2; });
}

// As ReducedConvolution has made them: where some holes are filled, but not all, a list of its own.
void FollowedConvolution::find_lists() {
  auto of_part = static_cast<std::uint32_t>(operands_[0]->directions.size() + operands_[1]->directions.size());
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand &o = *operands_[op], &other = *operands_[1 - op];
    const auto first = op == 0 ? 0 : static_cast<std::uint32_t>(other.directions.size());
    const auto [all, outer] = o.component_directions[0];
    of_[op] = {all + first, all + first, outer + first};
    std::size_t count = 0;
    for (const Loop& loop : o.loops) {
      filled_loops_[op].push_back(loop.kind == LoopKind::hole &&
                                  hole_is_filled(*lattice_now_, o, loop, other, other.components[0]));
      count += filled_loops_[op].back();
    }
    if (count + 1 == o.loops.size()) of_[op].outer = of_[op].hole;
    else if (count > 0) of_[op].outer = of_part++;
  }
}

void FollowedConvolution::list_used(std::uint32_t side) {
  used_[side].clear();
  for (std::uint32_t k = 0; k < ranges(side).size(); ++k)
    if (ranges(side)[k].count != 0) used_[side].push_back(k);
}

// Where the direction of an edge of the other operand stands in a list of `side`: side 0 counts the directions of P
// that are not greater than that of Q, side 1 those of Q that are less than that of P.
std::uint32_t FollowedConvolution::bound(std::uint32_t side, std::uint32_t list, std::uint32_t edge) const {
  const Operand &o = *operands_[side], &other = *operands_[1 - side];
  const DirectionList& of = *lists_[list];
  const Edge d = other.edge(edge);
  const double key = pseudo_angle(other.ex[edge], other.ey[edge]);
  std::uint32_t low = 0, high = static_cast<std::uint32_t>(of.edges.size());
  while (low < high) {
    const std::uint32_t at = low + (high - low) / 2;
    const int order = compare_directions(*lattice_now_, of.keys[at], o.edge(of.edges[at]), key, d);
    if (order < 0 || (order == 0 && side == 0)) low = at + 1;
    else high = at;
  }
  return low;
}

// The turn of a vertex anew. Reports whether it has segments now and had none, or the reverse.
bool FollowedConvolution::meet_again(std::uint32_t side, std::uint32_t v) {
  const Operand& o = *operands_[1 - side];
  const auto loop = std::partition_point(o.loops.begin(), o.loops.end(), [&](const Loop& l) { return l.last <= v; });
  auto& t = turns_[side][v];
  const auto was = std::exchange(t, {});
  const std::uint32_t list = loop->kind == LoopKind::hole ? of_[side].hole : of_[side].outer;
  const auto n = static_cast<std::uint32_t>(lists_[list]->edges.size());
  if (!filled_loops_[1 - side][static_cast<std::size_t>(loop - o.loops.begin())] && o.convex[v] && n != 0) {
    const DirectionList& own = *lists_[of_[1 - side].whole];
    const std::uint32_t in = o.prev[v], lo = bound(side, list, in), hi = bound(side, list, v);
    const bool wraps = own.rank[v - own.base] < own.rank[in - own.base];
    t = {list, lo == n ? 0 : lo, hi - lo + (wraps ? n : 0), 0};
  }
  size_ = size_ + t.count - was.count;
  return (t.count == 0) != (was.count == 0);
}

// An edge that changes its direction is counted otherwise by the directions that it passes; the turns of vertices
// between these are other ones, and those of the vertices at the edge.
void FollowedConvolution::follow(const Lattice& lattice, const Operand& p, const Operand& q, std::uint32_t op,
                                 const OperandMoves& moves) {
  const std::uint32_t other = 1 - op, whole = of_[other].whole;
  std::vector<std::uint32_t> was;
  for (const std::uint32_t e : moves.edges) was.push_back(bound(other, whole, e));
  lattice_now_ = &lattice;
  operands_ = {&p, &q};
  std::uint32_t k = 0;
  for (const Operand* o : operands_)
    for (const DirectionList& list : o->directions) lists_[k++] = &list;
  if (of_[op].outer >= k)
    for (DirectionList& list : own_lists_)
      if (&list == lists_[of_[op].outer])
        sort_again(list, OwnEdges(*operands_[op]->points), *operands_[op], moves.edges);
  std::vector<std::uint32_t> passed;
  const DirectionList& list = *lists_[whole];
  for (std::size_t i = 0; i < moves.edges.size(); ++i) {
    const std::uint32_t is = bound(other, whole, moves.edges[i]);
    for (std::uint32_t at = std::min(was[i], is); at < std::max(was[i], is); ++at)
      passed.insert(passed.end(), {list.edges[at], operands_[other]->next[list.edges[at]]});
  }
  std::sort(passed.begin(), passed.end());
  passed.erase(std::unique(passed.begin(), passed.end()), passed.end());
  std::array<bool, 2> others{};
  for (const std::uint32_t v : passed) others[op] |= meet_again(op, v);
  for (const std::uint32_t v : moves.corners) others[other] |= meet_again(other, v);
  for (std::uint32_t side = 0; side < 2; ++side)
    if (others[side]) list_used(side);
}

std::vector<std::uint32_t> FollowedConvolution::ranks_in(std::uint32_t list,
                                                         std::span<const std::uint32_t> edges) const {
  std::vector<std::uint32_t> ranks;
  for (const std::uint32_t e : edges)
    if (holds(*lists_[list], e)) ranks.push_back(lists_[list]->rank[e - lists_[list]->base]);
  std::sort(ranks.begin(), ranks.end());
  return ranks;
}

std::uint64_t FollowedConvolution::order(std::uint32_t side, std::uint32_t edge, std::uint32_t vertex) const {
  const std::uint32_t component = columns_[side] == 1 ? 0 : operands_[side]->component_of[edge];
  const std::size_t row = std::size_t{vertex} * columns_[side] + component;
  const auto& t = ranges(side)[row];
  return std::uint64_t{side} << 63 | std::uint64_t{row} << 32 | (id(t, edge) - t.base);
}

}  // namespace dymsum::planar
