#include "planar/convolution.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dymsum::planar {
namespace {

// Monotone in the angle, in [0, 4]. Its error: the vector's components carry one rounding each, sum, quotient and difference
// one more each, all of quantities at most 4.
double pseudo_angle(double x, double y) {
  const double c = x / (std::abs(x) + std::abs(y));
  return y > 0 || (y == 0 && x > 0) ? 1 - c : 3 + c;
}
constexpr double kAngleError = 0x1p-48;

int half(const Point& d) { return d.y > 0 || (d.y == 0 && d.x > 0) ? 0 : 1; }

// Strict order of directions with the filter in front.
struct DirectionOrder {
  const Lattice& lattice;

  int operator()(double key_d, const Edge& d, double key_e, const Edge& e) const {
    if (key_d < key_e - kAngleError) return -1;
    if (key_d > key_e + kAngleError) return 1;
    return compare_directions(lattice, d, e);
  }
};

// Sorts by key into buckets, then repairs with exact comparisons; nearly linear unless directions cluster.
DirectionList sort_by_direction(const Lattice& lattice, const Operand& o, std::vector<std::uint32_t> edges) {
  DirectionList list;
  const std::size_t n = edges.size();
  std::uint32_t low = std::numeric_limits<std::uint32_t>::max(), high = 0;
  struct Item {
    double key;
    std::uint32_t edge;
  };
  std::vector<Item> items(n);
  std::vector<std::uint32_t> start(n + 2, 0);
  const double per_key = static_cast<double>(n) / 4.0;
  const auto bucket = [&](double key) { return std::min<std::size_t>(n - 1, static_cast<std::size_t>(key * per_key)); };
  std::vector<double> keys(n);
  for (std::size_t i = 0; i < n; ++i) {
    keys[i] = pseudo_angle(o.ex[edges[i]], o.ey[edges[i]]);
    ++start[bucket(keys[i]) + 1];
    low = std::min(low, edges[i]);
    high = std::max(high, edges[i]);
  }
  for (std::size_t b = 1; b < start.size(); ++b) start[b] += start[b - 1];
  for (std::size_t i = 0; i < n; ++i) items[start[bucket(keys[i])]++] = {keys[i], edges[i]};
  const DirectionOrder order{lattice};
  const auto less = [&](const Item& a, const Item& b) {
    return order(a.key, o.edge(a.edge), b.key, o.edge(b.edge)) < 0;
  };
  // Buckets are sorted among each other up to the keys' error, so few elements move between them.
  for (std::size_t b = 0, from = 0; b < n; ++b) {
    const std::size_t to = start[b];
    if (to - from > 16) std::sort(items.begin() + from, items.begin() + to, less);
    from = to;
  }
  for (std::size_t i = 1; i < n; ++i) {
    const Item item = items[i];
    std::size_t j = i;
    for (; j > 0 && less(item, items[j - 1]); --j) items[j] = items[j - 1];
    items[j] = item;
  }
  list.base = n == 0 ? 0 : low;
  list.rank.assign(n == 0 ? 0 : high - low + 1, kNoRank);
  list.edges.resize(n);
  list.keys.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    list.edges[i] = items[i].edge;
    list.keys[i] = items[i].key;
    list.rank[items[i].edge - low] = static_cast<std::uint32_t>(i);
  }
  return list;
}

std::vector<std::uint32_t> edges_of(const Operand& o, const Component& c) {
  std::vector<std::uint32_t> edges;
  for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l)
    for (std::uint32_t i = o.loops[l].first; o.loops[l].kind != LoopKind::point && i < o.loops[l].last; ++i) edges.push_back(i);
  return edges;
}

// The sublist of the loops that `keep` accepts.
template <class Keep>
DirectionList sublist(const DirectionList& all, const Operand& o, const Component& c, Keep keep) {
  DirectionList list;
  list.base = all.base;
  list.rank.assign(all.rank.size(), kNoRank);
  std::vector<std::uint8_t> kept(all.rank.size(), 0);
  for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l)
    if (keep(l)) std::fill(kept.begin() + (o.loops[l].first - all.base), kept.begin() + (o.loops[l].last - all.base), 1);
  for (std::size_t i = 0; i < all.edges.size(); ++i) {
    if (!kept[all.edges[i] - all.base]) continue;
    list.rank[all.edges[i] - all.base] = static_cast<std::uint32_t>(list.edges.size());
    list.edges.push_back(all.edges[i]);
    list.keys.push_back(all.keys[i]);
  }
  return list;
}

// For every position of `own` the number of directions in `other` that are less (lower) or not greater (upper): two merges.
struct Positions {
  std::vector<std::uint32_t> lower, upper;
};
Positions merge_positions(const Lattice& lattice, const Operand& own_op, const DirectionList& own, const Operand& other_op,
                          const DirectionList& other) {
  const DirectionOrder order{lattice};
  Positions p;
  const std::size_t n = own.edges.size(), m = other.edges.size();
  p.lower.resize(n);
  p.upper.resize(n);
  std::size_t lo = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Edge d = own_op.edge(own.edges[i]);
    const double key = own.keys[i];
    while (lo < m && order(other.keys[lo], other_op.edge(other.edges[lo]), key, d) < 0) ++lo;
    std::size_t up = lo;
    while (up < m && order(other.keys[up], other_op.edge(other.edges[up]), key, d) == 0) ++up;
    p.lower[i] = static_cast<std::uint32_t>(lo);
    p.upper[i] = static_cast<std::uint32_t>(up);
  }
  return p;
}

struct Box {
  std::uint32_t min_x, max_x, min_y, max_y;  // source vertices
};

}  // namespace

int compare_directions(const Lattice& lattice, const Edge& d, const Edge& e) {
  const int hd = half(lattice.vector(d)), he = half(lattice.vector(e));
  if (hd != he) return hd < he ? -1 : 1;
  return -lattice.cross(d, e);
}

// Widths are differences of input coordinates, compared exactly: as edges of the two operands along an axis they need no new sign.
bool hole_is_filled(const Lattice& lattice, const Operand& holed, const Loop& hole, const Operand& other,
                    const Component& component) {
  if (component.dimension != 2) return false;
  const auto extremes = [&](const Operand& o, std::uint32_t first, std::uint32_t last) {
    Box b{o.source[first], o.source[first], o.source[first], o.source[first]};
    const auto &x = lattice.input[o.op];
    for (std::uint32_t i = first; i < last; ++i) {
      const std::uint32_t s = o.source[i];
      if (x[s].x < x[b.min_x].x) b.min_x = s;
      if (x[s].x > x[b.max_x].x) b.max_x = s;
      if (x[s].y < x[b.min_y].y) b.min_y = s;
      if (x[s].y > x[b.max_y].y) b.max_y = s;
    }
    return b;
  };
  const Box h = extremes(holed, hole.first, hole.last);
  const Loop& outer = other.loops[component.first_loop];
  const Box c = extremes(other, outer.first, outer.last);
  return lattice.compare_extent({holed.op, h.min_x, h.max_x}, {other.op, c.min_x, c.max_x}, 0) < 0 ||
         lattice.compare_extent({holed.op, h.min_y, h.max_y}, {other.op, c.min_y, c.max_y}, 1) < 0;
}

ReducedConvolution::ReducedConvolution(const Lattice& lattice, const Operand& p, const Operand& q)
    : lattice_(lattice), operands_{&p, &q} {
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand& o = *operands_[op];
    component_of_[op].resize(o.size());
    for (std::uint32_t c = 0; c < o.components.size(); ++c) {
      const Component& component = o.components[c];
      for (std::uint32_t v = component.first; v < component.last; ++v) component_of_[op][v] = c;
      std::array<std::uint32_t, 2> ids;
      ids[0] = static_cast<std::uint32_t>(lists_.size());
      lists_.push_back(sort_by_direction(lattice, o, edges_of(o, component)));
      ids[1] = ids[0];
      if (component.last_loop - component.first_loop > 1) {
        ids[1] = static_cast<std::uint32_t>(lists_.size());
        lists_.push_back(sublist(lists_[ids[0]], o, component, [&](std::uint32_t l) { return l == component.first_loop; }));
      }
      plain_lists_[op].push_back(ids);
    }
  }
  for (std::uint32_t side = 0; side < 2; ++side) {
    columns_[side] = static_cast<std::uint32_t>(operands_[side]->components.size());
    turns_[side].resize(operands_[1 - side]->size() * std::size_t{columns_[side]});
  }
  for (std::uint32_t cp = 0; cp < p.components.size(); ++cp)
    for (std::uint32_t cq = 0; cq < q.components.size(); ++cq)
      if (p.components[cp].dimension == 2 || q.components[cq].dimension == 2) add_pair(cp, cq);
  for (auto& side : turns_)
    for (Turn& t : side) {
      t.base = size_;
      size_ += t.count;
    }
}

void ReducedConvolution::add_pair(std::uint32_t cp, std::uint32_t cq) {
  const std::array<std::uint32_t, 2> index{cp, cq};
  std::array<std::array<std::uint32_t, 2>, 2> lists{plain_lists_[0][cp], plain_lists_[1][cq]};
  std::array<std::vector<std::uint8_t>, 2> filled;
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand &o = *operands_[op], &other = *operands_[1 - op];
    const Component &c = o.components[index[op]], &d = other.components[index[1 - op]];
    filled[op].assign(o.loops.size(), 0);
    std::size_t count = 0;
    for (std::uint32_t l = c.first_loop + 1; l < c.last_loop; ++l)
      if (hole_is_filled(lattice_, o, o.loops[l], other, d)) {
        filled[op][l] = 1;
        ++count;
      }
    filled_holes_ += count;
    if (count == c.last_loop - c.first_loop - 1) {
      lists[op][0] = lists[op][1];
    } else if (count > 0) {
      lists[op][0] = static_cast<std::uint32_t>(lists_.size());
      lists_.push_back(sublist(lists_[plain_lists_[op][index[op]][0]], o, c, [&](std::uint32_t l) { return !filled[op][l]; }));
    }
  }
  for (std::uint32_t side = 0; side < 2; ++side) {
    const std::uint32_t vertex_op = 1 - side;
    const Operand &edge_operand = *operands_[side], &o = *operands_[vertex_op];
    const Component& c = o.components[index[vertex_op]];
    const DirectionList& own = lists_[plain_lists_[vertex_op][index[vertex_op]][0]];
    std::array<Positions, 2> positions;  // against the list with holes, without
    for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l) {
      const Loop& loop = o.loops[l];
      if (filled[vertex_op][l]) continue;
      // Hole against hole cannot touch without overlap elsewhere.
      const std::size_t variant = loop.kind == LoopKind::hole ? 1 : 0;
      const std::uint32_t list = lists[side][variant];
      const std::uint32_t n = static_cast<std::uint32_t>(lists_[list].edges.size());
      if (loop.kind == LoopKind::point) {
        turns_[side][std::size_t{loop.first} * columns_[side] + index[side]] = {list, 0, n, 0};
        continue;
      }
      if (n == 0) continue;
      Positions& at = positions[variant];
      if (at.lower.empty()) {
        at = merge_positions(lattice_, o, own, edge_operand, lists_[list]);
        for (std::size_t i = 0; i < at.lower.size(); ++i) parallel_pairs_ += at.upper[i] != at.lower[i];
      }
      for (std::uint32_t v = loop.first; v < loop.last; ++v) {
        if (!o.convex[v]) continue;
        const std::uint32_t in = own.rank[o.prev[v] - own.base], out = own.rank[v - own.base];
        // Half-open turns with opposite ends: (in, out] against edges of P, [in, out) against edges of Q.
        const std::vector<std::uint32_t>& bound = side == 0 ? at.upper : at.lower;
        const std::uint32_t lo = bound[in], hi = bound[out];
        const bool wraps = out < in;
        Turn t;
        t.list = list;
        t.lo = lo == n ? 0 : lo;
        t.count = hi - lo + (wraps ? n : 0);
        turns_[side][std::size_t{v} * columns_[side] + index[side]] = t;
      }
    }
  }
}

std::uint32_t ReducedConvolution::find(std::uint32_t side, std::uint32_t edge, std::uint32_t vertex) const {
  const std::uint32_t component = component_of_[side][edge];
  const Turn& t = turns_[side][std::size_t{vertex} * columns_[side] + component];
  if (t.count == 0) return kNoRank;
  const DirectionList& list = lists_[t.list];
  if (edge < list.base || edge - list.base >= list.rank.size()) return kNoRank;
  const std::uint32_t rank = list.rank[edge - list.base];
  if (rank == kNoRank) return kNoRank;
  const std::uint32_t n = static_cast<std::uint32_t>(list.edges.size());
  const std::uint32_t k = rank >= t.lo ? rank - t.lo : rank + n - t.lo;
  return k < t.count ? t.base + k : kNoRank;
}

std::uint32_t ReducedConvolution::next(const WalkSegment& s) const {
  const std::uint32_t turned = operands_[s.side]->next[s.edge];
  const std::uint32_t same_side = find(s.side, turned, s.vertex);
  if (same_side != kNoRank) return same_side;
  return find(1 - s.side, s.vertex, turned);
}

std::uint32_t ReducedConvolution::prev(const WalkSegment& s) const {
  const std::uint32_t same_side = find(s.side, operands_[s.side]->prev[s.edge], s.vertex);
  if (same_side != kNoRank) return same_side;
  return find(1 - s.side, operands_[1 - s.side]->prev[s.vertex], s.edge);
}

}  // namespace dymsum::planar
