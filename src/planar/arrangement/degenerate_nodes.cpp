// The vertex routine: nodes of the arrangement where crossings coincide or segments end on others, and how the boundary
// goes on there.
#include <algorithm>
#include <tuple>

#include "base/scratch.h"
#include "planar/arrangement/arrangement.h"
#include "planar/operand/edges.h"

namespace dymsum::planar {

// A ray at a node: the sub-edge that leaves or arrives there, by its direction away from the node.
struct Arrangement::Ray {
  double angle;  // a pseudo-angle, rounded
  std::uint32_t segment, sub;
  bool out, upper;  // upper: in [0, pi), exactly
};

// Rays of one direction: [begin, end) of the sorted rays.
struct Arrangement::Group {
  std::uint32_t begin, end;
  bool left, right;  // covered on the ray's left (something leaves), right (something arrives)
};

// What one node after another needs.
struct Arrangement::NodeBuffers {
  explicit NodeBuffers(Scratch* memory) : rays(memory), order(memory), incident(memory), groups(memory) {
    rays.reserve(16);
    order.reserve(16);
    incident.reserve(8);
    groups.reserve(16);
  }
  Array<Ray> rays;
  Array<std::uint32_t> order;  // of the rays, counter-clockwise
  Array<Incidence> incident;
  Array<Group> groups;
};

// The events [begin, end) of a segment, all at one parameter.
struct Arrangement::Spot {
  std::uint32_t segment, begin, end;
  friend bool operator==(const Spot&, const Spot&) = default;
};

// The position of an event on s.
std::uint32_t Arrangement::position(std::uint32_t s, std::uint32_t event) const {
  const auto first = events_.begin() + first_event_[s];
  return static_cast<std::uint32_t>(std::find(first, first + event_count(s), event) - first);
}

std::pair<std::uint32_t, std::uint32_t> Arrangement::equal_run(std::uint32_t s, std::uint32_t k) const {
  const std::uint32_t* first = events_.data() + first_event_[s];
  std::uint32_t begin = k, end = k + 1;
  while (begin > 0 && compare_events(s, first[begin - 1], first[k]) == 0) --begin;
  while (end < event_count(s) && compare_events(s, first[end], first[k]) == 0) ++end;
  return {begin, end};
}

// Positions where crossings coincide, or segments end on others: classes of crossings and pairs of vertices. Their
// elements are made one by one.
struct Arrangement::NodeClasses {
  explicit NodeClasses(Scratch* memory) : index(memory), classes(0, memory), spots(memory) {}

  static constexpr std::uint64_t kPair = std::uint64_t{1} << 63;
  static std::uint64_t key(WalkPair v) { return kPair | (std::uint64_t{v.p} << 31) | v.q; }
  static WalkPair pair(std::uint64_t key) {
    return {static_cast<std::uint32_t>((key & ~kPair) >> 31), static_cast<std::uint32_t>(key & 0x7fffffff)};
  }
  std::uint32_t element(std::uint64_t key) {
    const auto [element, fresh] = index.add(key);
    if (fresh) classes.add();
    return element;
  }

  struct Touched {
    std::uint32_t element;
    Spot spot;
  };
  KeyIndices index;
  UnionFind classes;
  Array<Touched> spots;  // where segments pass
};

void Arrangement::find_degenerate_nodes(const Poll* poll) {
  NodeClasses nodes(soup_.memory);
  for (const auto& [a, b] : meetings_.same) {
    // One after the other: compilers differ in which argument of a call comes first.
    const std::uint32_t of_b = nodes.element(NodeClasses::key(b)), of_a = nodes.element(NodeClasses::key(a));
    nodes.classes.unite(of_a, of_b);
  }
  join_suspects(nodes, poll);
  const Array<std::uint64_t>& elements = nodes.index.keys();
  if (elements.empty()) return;
  // A crossing of a class has two segments; one of them may meet nothing else there.
  for (std::uint32_t e = 0; e < elements.size(); ++e) {
    if (elements[e] & NodeClasses::kPair) continue;
    const std::uint32_t c = static_cast<std::uint32_t>(elements[e]);
    const Crossing& x = meetings_.crossings[c];
    for (const std::uint32_t s : {x.a, x.b}) {
      const auto [begin, end] = equal_run(s, position(s, c));
      nodes.spots.push_back({e, {s, begin, end}});
    }
  }
  process_nodes(nodes, poll);
}

// Events at one position of a suspect are one class, and so is a touch alone.
void Arrangement::join_suspects(NodeClasses& nodes, const Poll* poll) const {
  const auto element = [&](std::uint32_t e) {
    return nodes.element(e & kTouchBit ? NodeClasses::key(meetings_.touches[e & ~kTouchBit].pair) : std::uint64_t{e});
  };
  for (const std::uint32_t s : suspects_) {
    if (poll != nullptr) poll->at(s, soup_.size());
    const std::uint32_t* first = events_.data() + first_event_[s];
    const std::uint32_t n = event_count(s);
    for (std::uint32_t k = 0; k < n;) {
      std::uint32_t end = k + 1;
      while (end < n && compare_events(s, first[k], first[end]) == 0) ++end;
      bool degenerate = end - k > 1;
      for (std::uint32_t i = k; i < end; ++i) degenerate |= (first[i] & kTouchBit) != 0;
      if (degenerate) {
        const std::uint32_t e = element(first[k]);
        for (std::uint32_t i = k + 1; i < end; ++i) nodes.classes.unite(e, element(first[i]));
        nodes.spots.push_back({e, {s, k, end}});
      }
      k = end;
    }
  }
}

// Class by class: its spots, each once, and its pairs of vertices, both by index: the first one names the node.
void Arrangement::process_nodes(NodeClasses& nodes, const Poll* poll) {
  using Touched = NodeClasses::Touched;
  Array<Touched>& spots = nodes.spots;
  const Array<std::uint64_t>& elements = nodes.index.keys();
  Array<std::pair<std::uint32_t, std::uint64_t>> pair_keys(soup_.memory);  // class, pair
  for (std::uint32_t e = 0; e < elements.size(); ++e)
    if (elements[e] & NodeClasses::kPair) pair_keys.emplace_back(nodes.classes.root(e), elements[e]);
  for (Touched& t : spots) t.element = nodes.classes.root(t.element);
  std::sort(pair_keys.begin(), pair_keys.end());
  std::sort(spots.begin(), spots.end(), [](const Touched& a, const Touched& b) {
    return std::tie(a.element, a.spot.segment, a.spot.begin) < std::tie(b.element, b.spot.segment, b.spot.begin);
  });
  Array<Spot> node(soup_.memory);
  Array<WalkPair> pairs(soup_.memory);
  NodeBuffers buffers(soup_.memory);
  std::size_t i = 0, j = 0;
  while (i < spots.size() || j < pair_keys.size()) {
    if (poll != nullptr) poll->at(i + j, spots.size() + pair_keys.size());
    const std::uint32_t root =
        std::min(i < spots.size() ? spots[i].element : kNone, j < pair_keys.size() ? pair_keys[j].first : kNone);
    node.clear();
    pairs.clear();
    for (; i < spots.size() && spots[i].element == root; ++i)
      if (node.empty() || !(node.back() == spots[i].spot)) node.push_back(spots[i].spot);
    for (; j < pair_keys.size() && pair_keys[j].first == root; ++j)
      pairs.push_back(NodeClasses::pair(pair_keys[j].second));
    process_node(node, pairs, buffers);
  }
}

void Arrangement::process_node(const Array<Spot>& spots, const Array<WalkPair>& pairs, NodeBuffers& buffers) {
  ++degenerate_nodes_;
  Array<Ray>& rays = buffers.rays;
  rays.clear();
  const auto add = [&](std::uint32_t s, std::uint32_t k, bool out) {
    const Point d = soup_.lattice.wide ? soup_.lattice.direction(soup_.exact(s).edge) : Point{soup_.dx(s), soup_.dy(s)};
    const double sign = out ? 1 : -1, dx = sign * d.x, dy = sign * d.y;
    const std::uint32_t sub = first_sub(s) + k;
    rays.push_back({pseudo_angle(dx, dy), s, sub, out, dy > 0 || (dy == 0 && dx > 0)});
    flags_[sub] |= out ? kDegenerateStart : kDegenerateEnd;
  };
  Node where;
  where.index = static_cast<std::uint32_t>(degenerate_nodes_);
  bool placed = false;
  for (const Spot& spot : spots) {
    if (!placed) {
      where.segment = spot.segment;
      where.end = event_end(spot.segment, event(spot.segment, spot.begin));
      where.sub_after = first_sub(spot.segment) + spot.begin + 1;
    }
    placed = true;
    // Between events at one position there is nothing.
    for (std::uint32_t k = spot.begin + 1; k < spot.end; ++k) flags_[first_sub(spot.segment) + k] |= kNoBoundary;
    add(spot.segment, spot.begin, false);
    add(spot.segment, spot.end, true);
  }
  Array<Incidence>& incident = buffers.incident;
  for (const WalkPair& v : pairs) {
    incident.clear();
    chain_.incident(v, incident);
    for (const Incidence& at : incident) {
      if (!placed) {
        where.segment = at.segment;
        where.end = {true, v, 0};
        where.sub_after = at.starts ? first_sub(at.segment) : first_sub(at.segment + 1);
      }
      placed = true;
      add(at.segment, at.starts ? 0 : event_count(at.segment), at.starts);
    }
  }
  if (placed) link_rays(buffers, where);
}

// The rays counter-clockwise, those of one direction in a group. Indices are sorted, not rays, which have just been
// written in parts.
void Arrangement::group_rays(NodeBuffers& buffers) const {
  const Ray* const rays = buffers.rays.data();
  const auto n = static_cast<std::uint32_t>(buffers.rays.size());
  const auto compare = [&](const Ray& a, const Ray& b) {
    if (a.upper != b.upper) return a.upper ? -1 : 1;
    if (const double gap = a.angle - b.angle; gap > kAngleError || gap < -kAngleError) return gap > 0 ? 1 : -1;
    const int c = soup_.cross(a.segment, b.segment);
    return a.out == b.out ? -c : c;
  };
  const auto before = [&](std::uint32_t i, std::uint32_t j) {
    const Ray &a = rays[i], &b = rays[j];
    const int c = compare(a, b);
    if (c != 0) return c < 0;
    return a.segment != b.segment ? a.segment < b.segment : a.sub < b.sub;
  };
  Array<std::uint32_t>& order = buffers.order;
  order.resize(n);
  std::uint32_t* const sorted = order.data();
  for (std::uint32_t i = 0; i < n; ++i) sorted[i] = i;
  constexpr std::uint32_t kInsertion = 24;
  if (n > kInsertion) {
    std::sort(sorted, sorted + n, before);
  } else {
    for (std::uint32_t i = 1; i < n; ++i) {
      std::uint32_t j = i;
      for (; j > 0 && before(i, sorted[j - 1]); --j) sorted[j] = sorted[j - 1];
      sorted[j] = i;
    }
  }
  Array<Group>& groups = buffers.groups;
  groups.clear();
  for (std::uint32_t i = 0; i < n;) {
    const Ray& first = rays[sorted[i]];
    std::uint32_t end = i;
    bool left = false, right = false;
    do {
      (rays[sorted[end]].out ? left : right) = true;
      ++end;
    } while (end < n && compare(first, rays[sorted[end]]) == 0);
    groups.push_back({i, end, left, right});
    i = end;
  }
}

// A sector between two neighbouring rays is free unless the ray before it leaves with it on its left, or the ray after
// it arrives with it on its left. The boundary of a free sector comes in on the first and goes out on the second.
void Arrangement::link_rays(NodeBuffers& buffers, const Node& where) {
  group_rays(buffers);
  const Ray* const rays = buffers.rays.data();
  const std::uint32_t* const sorted = buffers.order.data();
  const Array<Group>& groups = buffers.groups;
  nodes_.push_back(where);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Group &from = groups[g], &to = groups[g + 1 == groups.size() ? 0 : g + 1];
    if (from.left && from.right) {
      // Covered from both sides: a crack, unless inside M. Each is seen from both ends; keep the one that leaves
      // upwards.
      for (std::uint32_t k = from.begin; k < from.end; ++k)
        if (const Ray& ray = rays[sorted[k]]; ray.out) {
          if (ray.upper) covered_subs_.push_back({ray.sub, ray.segment});
          break;
        }
    }
    if (from.left || to.right) continue;
    const Ray& onward = rays[sorted[to.begin]];
    const Step step{onward.sub, onward.segment};
    flags_[step.sub] |= kEntered;
    const Link link{step, where.index};
    for (std::uint32_t k = from.begin; k < from.end; ++k) {
      const auto [index, fresh] = linked_subs_.add(rays[sorted[k]].sub);
      if (fresh) links_.push_back(link);
      else links_[index] = link;
    }
  }
}

// The successor at a degenerate end.
Arrangement::Step Arrangement::linked(Step from) const {
  if (flags_[from.sub] & kNoBoundary) return {};
  const std::uint32_t link = linked_subs_.find(from.sub);
  return link == KeyIndices::kMissing ? Step{} : links_[link].to;
}

std::uint32_t Arrangement::linked_node(Step at) const {
  const std::uint32_t link = linked_subs_.find(at.sub);
  return link == KeyIndices::kMissing ? kNone : links_[link].node;
}

}  // namespace dymsum::planar
