#include "planar/directions.h"

#include <algorithm>
#include <cmath>

#include "base/scratch.h"
#include "planar/operand.h"

namespace dymsum::planar {
namespace {

int half(const Point& d) { return d.y > 0 || (d.y == 0 && d.x > 0) ? 0 : 1; }

Array<std::uint32_t> edges_of(const Operand& o, const Component& c, Scratch& memory) {
  Array<std::uint32_t> edges(&memory);
  edges.reserve(c.last - c.first);
  for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l)
    for (std::uint32_t i = o.loops[l].first; o.loops[l].kind != LoopKind::point && i < o.loops[l].last; ++i) edges.push_back(i);
  return edges;
}

struct Item {
  double key;
  std::uint32_t edge;
};

// Buckets are sorted among each other up to the keys' error, so few items have to move between them afterwards.
template <class Less>
void sort_into_buckets(Array<Item>& items, const Less& less, Scratch& memory) {
  const std::size_t n = items.size();
  const double per_key = static_cast<double>(n) / 4.0;
  const auto bucket = [&](double key) { return std::min<std::size_t>(n - 1, static_cast<std::size_t>(key * per_key)); };
  Array<std::uint32_t> start(n + 2, 0, &memory);
  for (const Item& item : items) ++start[bucket(item.key) + 1];
  for (std::size_t b = 1; b < start.size(); ++b) start[b] += start[b - 1];
  Array<Item> sorted(n, &memory);
  for (const Item& item : items) sorted[start[bucket(item.key)]++] = item;
  items.swap(sorted);
  for (std::size_t b = 0, from = 0; b < n; ++b) {
    const std::size_t to = start[b];
    if (to - from > 16) std::sort(items.begin() + from, items.begin() + to, less);
    from = to;
  }
}

}  // namespace

int compare_directions(const Lattice& lattice, const Edge& d, const Edge& e) {
  const Point u = lattice.vector(d), v = lattice.vector(e);
  const int hd = half(u), he = half(v);
  if (hd != he) return hd < he ? -1 : 1;
  if (lattice.exact_doubles) {
    const double cross = u.x * v.y - u.y * v.x;
    return (cross < 0) - (cross > 0);
  }
  if (const double scale = lattice.to_integers; scale != 0) {
    const auto integer = [&](double x) { return static_cast<std::int64_t>(x * scale); };
    const std::int64_t cross = integer(u.x) * integer(v.y) - integer(u.y) * integer(v.x);
    return (cross < 0) - (cross > 0);
  }
  // Three roundings of each component at most, one of each product and one of the difference.
  const double left = u.x * v.y, right = u.y * v.x, bound = 0x1p-49 * (std::abs(left) + std::abs(right)) + 0x1p-1000;
  if (const double cross = left - right; cross > bound || cross < -bound) return cross < 0 ? 1 : -1;
  return -lattice.cross(d, e);
}

void number(DirectionList& list, const Operand& o) {
  const std::size_t n = list.edges.size();
  for (std::size_t k = 0; k < n; ++k) list.rank[list.edges[k] - list.base] = static_cast<std::uint32_t>(k);
  list.next.resize(n);
  for (std::size_t k = 0; k < n; ++k) list.next[k] = list.rank[o.next[list.edges[k]] - list.base];
}

// Sorts by key into buckets, then repairs with exact comparisons; nearly linear unless directions cluster.
DirectionList sort_by_direction(const Lattice& lattice, const Operand& o, const Component& c) {
  Scratch memory;
  const Array<std::uint32_t> edges = edges_of(o, c, memory);
  constexpr std::size_t kFew = 32;  // so many are in place sooner without buckets
  DirectionList list(o.memory.resource());
  const std::size_t n = edges.size();
  if (n == 0) return list;
  Array<Item> items(n, &memory);
  for (std::size_t i = 0; i < n; ++i) items[i] = {pseudo_angle(o.ex[edges[i]], o.ey[edges[i]]), edges[i]};
  const auto less = [&](const Item& a, const Item& b) {
    return compare_directions(lattice, a.key, o.edge(a.edge), b.key, o.edge(b.edge)) < 0;
  };
  if (n > kFew) sort_into_buckets(items, less, memory);
  for (std::size_t i = 1; i < n; ++i) {
    const Item item = items[i];
    std::size_t j = i;
    for (; j > 0 && less(item, items[j - 1]); --j) items[j] = items[j - 1];
    items[j] = item;
  }
  list.base = edges.front();
  list.rank.assign(edges.back() - edges.front() + 1, kNoRank);
  list.edges.resize(n);
  list.keys.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    list.edges[i] = items[i].edge;
    list.keys[i] = items[i].key;
  }
  number(list, o);
  return list;
}

DirectionList sublist(const DirectionList& all, const Operand& o, const Component& c, const std::vector<std::uint8_t>& keep) {
  DirectionList list(o.memory.resource());
  list.base = all.base;
  list.rank.assign(all.rank.size(), kNoRank);
  std::vector<std::uint8_t> kept(all.rank.size(), 0);
  for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l)
    if (keep[l]) std::fill(kept.begin() + (o.loops[l].first - all.base), kept.begin() + (o.loops[l].last - all.base), 1);
  for (std::size_t i = 0; i < all.edges.size(); ++i) {
    if (!kept[all.edges[i] - all.base]) continue;
    list.edges.push_back(all.edges[i]);
    list.keys.push_back(all.keys[i]);
  }
  number(list, o);
  return list;
}

}  // namespace dymsum::planar
