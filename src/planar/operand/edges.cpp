#include "planar/operand/edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>

#include "base/scratch.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"

namespace dymsum::planar {
namespace {

constexpr std::uint32_t kLeaf = 4;

std::size_t nodes_over(std::uint32_t n) { return n > kLeaf ? 1 + nodes_over(n / 2) + nodes_over(n - n / 2) : 1; }

std::uint32_t build(EdgeTree& tree, const Operand& o, std::uint32_t first, std::uint32_t last) {
  const std::uint32_t id = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.push_back({});
  EdgeTree::Node node{INFINITY, INFINITY, -INFINITY, -INFINITY, first, last, 0, 0};
  if (last - first > kLeaf) {
    const std::uint32_t midpoint = first + (last - first) / 2;
    node.left = build(tree, o, first, midpoint);
    node.right = build(tree, o, midpoint, last);
    const EdgeTree::Node &a = tree.nodes[node.left], &b = tree.nodes[node.right];
    node.x0 = std::min(a.x0, b.x0);
    node.y0 = std::min(a.y0, b.y0);
    node.x1 = std::max(a.x1, b.x1);
    node.y1 = std::max(a.y1, b.y1);
  } else {
    for (std::uint32_t i = first; i < last; ++i)
      for (const std::uint32_t v : {i, o.next[i]}) {
        node.x0 = std::min(node.x0, o.x[v]);
        node.y0 = std::min(node.y0, o.y[v]);
        node.x1 = std::max(node.x1, o.x[v]);
        node.y1 = std::max(node.y1, o.y[v]);
      }
  }
  tree.nodes[id] = node;
  return id;
}

}  // namespace

EdgeTree make_edge_tree(const Operand& o, std::uint32_t first, std::uint32_t last) {
  EdgeTree tree;
  tree.nodes.reserve(nodes_over(last - first));
  build(tree, o, first, last);
  return tree;
}

const std::vector<EdgeTree>& EdgeTrees::of(const Operand& o) const {
  if (const auto* made = made_.load(std::memory_order_acquire); made != nullptr) return *made;
  auto trees = std::make_unique<std::vector<EdgeTree>>();
  for (const Component& c : o.components) trees->push_back(make_edge_tree(o, c.first, c.last));
  const std::vector<EdgeTree>* first = nullptr;  // another thread's, perhaps
  return made_.compare_exchange_strong(first, trees.get(), std::memory_order_acq_rel) ? *trees.release() : *first;
}

namespace {

int half(const Point& d) { return d.y > 0 || (d.y == 0 && d.x > 0) ? 0 : 1; }

struct Item {
  double key;
  std::uint32_t edge;
};

// The order by direction, then by position in the walk: no two are equal.
class Before {
 public:
  Before(const OwnEdges& edges, const Operand& o) : edges_(edges), o_(o) {}
  bool operator()(const Item& a, const Item& b) const {
    if (a.key < b.key - kAngleError) return true;
    if (a.key > b.key + kAngleError) return false;
    const Point d{o_.ex[a.edge], o_.ey[a.edge]}, e{o_.ex[b.edge], o_.ey[b.edge]};
    if (half(d) != half(e)) return half(d) < half(e);
    const int turn = edges_.cross(o_.edge(a.edge), o_.edge(b.edge));
    return turn != 0 ? turn > 0 : a.edge < b.edge;
  }

 private:
  const OwnEdges& edges_;
  const Operand& o_;
};

// The pseudo-angle, without a branch on the half plane, which is as good as random along a walk.
double key_of(double x, double y) {
  const double c = x / (std::abs(x) + std::abs(y));
  const double lower = 1 - 2 * static_cast<int>((y > 0) | ((y == 0) & (x > 0)));
  const double key = (2 + lower) + lower * c;
  return key >= 0 ? key : 0;  // NaN where coordinates overflow, which no sum takes
}

// So many are counted against each other sooner than put into buckets.
constexpr std::size_t kFew = 40;

// Nearly in order: by a quantum of the key, then by position in the walk. How many come before each is counted for four
// at a time.
void sort_few(Array<Item>& items, Scratch& memory) {
  using Four = std::int32_t __attribute__((vector_size(16)));
  const std::size_t n = items.size(), lanes = (n + 3) / 4 * 4;
  alignas(Four) std::array<std::int32_t, kFew> order, before;
  for (std::size_t i = 0; i < n; ++i)  // below 2^31, all different
    order[i] = static_cast<std::int32_t>(items[i].key * 0x1p22) << 6 | static_cast<std::int32_t>(i);
  for (std::size_t i = n; i < lanes; ++i) order[i] = 0;
  for (std::size_t i = 0; i < lanes; i += 4) {
    Four mine, count{};
    std::memcpy(&mine, &order[i], sizeof mine);
    for (std::size_t k = 0; k < n; ++k) count -= order[k] < mine;
    std::memcpy(&before[i], &count, sizeof count);
  }
  Array<Item> sorted(n, &memory);
  for (std::size_t i = 0; i < n; ++i) sorted[static_cast<std::size_t>(before[i])] = items[i];
  items.swap(sorted);
}

// Buckets are sorted among each other up to the keys' error, so few items have to move between them afterwards.
void sort_into_buckets(Array<Item>& items, const Before& before, Scratch& memory) {
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
    const auto first = items.begin() + static_cast<std::ptrdiff_t>(from), last = items.begin() + start[b];
    if (last - first > 16 && !std::is_sorted(first, last, before)) std::sort(first, last, before);
    from = start[b];
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
  const double left = u.x * v.y, right = u.y * v.x,
               bound = kScaledEdgeCross * (std::abs(left) + std::abs(right)) + exact::kUnderflow;
  if (const double cross = left - right; cross > bound || cross < -bound) return cross < 0 ? 1 : -1;
  return -lattice.cross(d, e);
}

void number(DirectionList& list, const Operand& o) {
  const std::size_t n = list.edges.size();
  for (std::size_t k = 0; k < n; ++k) list.rank[list.edges[k] - list.base] = static_cast<std::uint32_t>(k);
  list.next.resize(n);
  for (std::size_t k = 0; k < n; ++k) list.next[k] = list.rank[o.next[list.edges[k]] - list.base];
}

// Sorts by key, then repairs with exact comparisons; nearly linear unless directions cluster.
DirectionList sort_by_direction(const OwnEdges& edges, const Operand& o, const Component& c) {
  DirectionList list(o.memory);
  const std::size_t n = c.dimension == 0 ? 0 : c.last - c.first;
  if (n == 0) return list;
  Scratch memory;
  Array<Item> items(n, &memory);
  for (std::uint32_t i = c.first; i < c.last; ++i) {
    const Point d = edges.direction(o.source[i], o.source[o.next[i]]);
    items[i - c.first] = {key_of(d.x, d.y), i};
  }
  const Before before(edges, o);
  if (n > kFew) sort_into_buckets(items, before, memory);
  else sort_few(items, memory);
  for (std::size_t i = 1; i < n; ++i) {
    const Item item = items[i];
    std::size_t j = i;
    for (; j > 0 && before(item, items[j - 1]); --j) items[j] = items[j - 1];
    items[j] = item;
  }
  list.base = c.first;
  list.rank.resize(n);
  list.edges.resize(n);
  list.keys.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    list.edges[i] = items[i].edge;
    list.keys[i] = items[i].key;
  }
  number(list, o);
  return list;
}

DirectionList sublist(const DirectionList& all, const Operand& o, const Component& c,
                      const std::vector<std::uint8_t>& keep, DirectionList list) {
  list.base = all.base;
  list.rank.assign(all.rank.size(), kNoRank);
  std::vector<std::uint8_t> kept(all.rank.size(), 0);
  for (std::uint32_t l = c.first_loop; l < c.last_loop; ++l)
    if (keep[l])
      std::fill(kept.begin() + (o.loops[l].first - all.base), kept.begin() + (o.loops[l].last - all.base), 1);
  for (std::size_t i = 0; i < all.edges.size(); ++i) {
    if (!kept[all.edges[i] - all.base]) continue;
    list.edges.push_back(all.edges[i]);
    list.keys.push_back(all.keys[i]);
  }
  number(list, o);
  return list;
}

}  // namespace dymsum::planar
