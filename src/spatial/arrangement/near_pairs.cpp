#include "spatial/arrangement/near_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace dymsum::spatial {
namespace {

constexpr std::size_t kLeaf = 16;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Holds a box of doubles whose coordinates are at most 2.
struct FloatBox {
  std::array<float, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};

  void add(const FloatBox& b) {
    for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], b.low[i]), high[i] = std::max(high[i], b.high[i]);
  }
  bool meets(const FloatBox& b) const {
    bool all = true;
    for (std::size_t i = 0; i < 3; ++i) all = all && low[i] <= b.high[i] && b.low[i] <= high[i];
    return all;
  }
};

/// Rounded to floats by at most 2^-24, and so is what is taken off.
FloatBox rounded_outward(const Box& box, double scale) {
  constexpr float kMore = 0x1p-22F;
  const auto low = [&](double v) { return static_cast<float>(v * scale) - kMore; };
  const auto high = [&](double v) { return static_cast<float>(v * scale) + kMore; };
  return {{low(box.low.x), low(box.low.y), low(box.low.z)}, {high(box.high.x), high(box.high.y), high(box.high.z)}};
}

/// Sixteen boxes, coordinate by coordinate; those after the last one are empty.
struct Leaf {
  std::array<std::array<float, kLeaf>, 3> low, high;
  std::array<std::uint32_t, kLeaf> index;
  std::size_t size = 0;

  FloatBox box(std::size_t k) const {
    FloatBox b;
    for (std::size_t i = 0; i < 3; ++i) b.low[i] = low[i][k], b.high[i] = high[i][k];
    return b;
  }
  /// Calls f(k) for those that meet a box.
  template <class F>
  void for_each(const FloatBox& b, F f) const {
    std::array<std::int32_t, kLeaf> meets;
    for (std::size_t k = 0; k < kLeaf; ++k)
      meets[k] =
          static_cast<std::int32_t>((low[0][k] <= b.high[0]) & (high[0][k] >= b.low[0]) & (low[1][k] <= b.high[1]) &
                                    (high[1][k] >= b.low[1]) & (low[2][k] <= b.high[2]) & (high[2][k] >= b.low[2]));
    for (std::size_t k = 0; k < size; ++k)
      if (meets[k] != 0) f(k);
  }
};

class LeafTree {
 public:
  explicit LeafTree(std::span<const Box> boxes) {
    double most = 0;
    for (const Box& b : boxes)
      for (const double v : {b.low.x, b.low.y, b.low.z, b.high.x, b.high.y, b.high.z})
        most = std::max(most, std::abs(v));
    const double scale = most > 0 ? std::ldexp(1.0, std::min(1000, -std::ilogb(most))) : 1;
    entries_.reserve(boxes.size());
    for (std::uint32_t k = 0; k < boxes.size(); ++k) entries_.push_back({rounded_outward(boxes[k], scale), k});
    if (!boxes.empty()) build(0, entries_.size());
  }

  const std::vector<Leaf>& leaves() const { return leaves_; }

  /// Calls f(l, box of the leaf) for all leaves from `first` on that meet a box.
  template <class F>
  void for_each_leaf(const FloatBox& box, std::uint32_t first, F f) const {
    std::array<std::uint32_t, 64> stack;
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const std::uint32_t at = stack[--top];
      const Node& node = nodes_[at];
      if (node.last_leaf <= first || !node.box.meets(box)) continue;
      if (node.right == 0) {
        f(node.last_leaf - 1);
      } else {
        stack[top++] = node.right;
        stack[top++] = at + 1;
      }
    }
  }

 private:
  struct Entry {
    FloatBox box;
    std::uint32_t index;
  };
  /// Its first half is the next node; a leaf has none.
  struct Node {
    FloatBox box;
    std::uint32_t right = 0, last_leaf = 0;
  };

  void build(std::size_t first, std::size_t last) {
    const auto node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    FloatBox box, centres;
    for (std::size_t k = first; k < last; ++k) {
      box.add(entries_[k].box);
      for (std::size_t i = 0; i < 3; ++i) {
        centres.low[i] = std::min(centres.low[i], centre(entries_[k], i));
        centres.high[i] = std::max(centres.high[i], centre(entries_[k], i));
      }
    }
    nodes_[node].box = box;
    if (last - first <= kLeaf) {
      add_leaf(first, last);
    } else {
      std::size_t axis = 0;
      for (std::size_t i = 1; i < 3; ++i)
        if (centres.high[i] - centres.low[i] > centres.high[axis] - centres.low[axis]) axis = i;
      // Full leaves, but for the last one.
      const std::size_t half = first + ((last - first) / kLeaf + 1) / 2 * kLeaf;
      const auto at = [&](std::size_t k) { return entries_.begin() + static_cast<std::ptrdiff_t>(k); };
      std::nth_element(at(first), at(half), at(last), [&](const Entry& a, const Entry& b) {
        const float x = centre(a, axis), y = centre(b, axis);
        return x != y ? x < y : a.index < b.index;
      });
      build(first, half);
      nodes_[node].right = static_cast<std::uint32_t>(nodes_.size());
      build(half, last);
    }
    nodes_[node].last_leaf = static_cast<std::uint32_t>(leaves_.size());
  }
  static float centre(const Entry& e, std::size_t axis) { return e.box.low[axis] + e.box.high[axis]; }
  void add_leaf(std::size_t first, std::size_t last) {
    Leaf& leaf = leaves_.emplace_back();
    leaf.size = last - first;
    const FloatBox empty;
    for (std::size_t k = 0; k < kLeaf; ++k) {
      const FloatBox& box = k < leaf.size ? entries_[first + k].box : empty;
      for (std::size_t i = 0; i < 3; ++i) leaf.low[i][k] = box.low[i], leaf.high[i][k] = box.high[i];
      leaf.index[k] = k < leaf.size ? entries_[first + k].index : 0;
    }
  }

  std::vector<Entry> entries_;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

/// What a box takes in a tree of boxes, with leaves, nodes and entries.
constexpr std::size_t kBytesPerBox = 128;

/// The pairs of a leaf's boxes among themselves and with those of later leaves.
void add_pairs(const LeafTree& tree, std::uint32_t l, std::span<const Box> boxes, Pairs& pairs, StageWatch& watch) {
  const Leaf& leaf = tree.leaves()[l];
  FloatBox all;
  for (std::size_t k = 0; k < leaf.size; ++k) all.add(leaf.box(k));
  tree.for_each_leaf(all, l, [&](std::uint32_t m) {
    const Leaf& other = tree.leaves()[m];
    for (std::size_t k = 0; k < leaf.size; ++k) {
      const std::uint32_t f = leaf.index[k];
      other.for_each(leaf.box(k), [&](std::size_t i) {
        const std::uint32_t g = other.index[i];
        if ((m != l || k < i) && overlap(boxes[f], boxes[g]))
          add_counted(pairs, {std::min(f, g), std::max(f, g)}, watch);
      });
    }
  });
}

/// Pairs f < g by f, each list sorted; frees the parts.
NearPairs listed(std::size_t boxes, std::span<Pairs> parts, StageWatch& watch) {
  NearPairs near;
  near.begin.assign(boxes + 1, 0);
  for (const Pairs& pairs : parts)
    for (const auto& [f, g] : pairs) ++near.begin[f + 1];
  std::partial_sum(near.begin.begin(), near.begin.end(), near.begin.begin());
  watch.hold(2 * near.begin.size() * sizeof(near.begin[0]) + near.begin.back() * sizeof(near.others[0]));
  near.others.resize(near.begin.back());
  std::vector<std::size_t> position(near.begin.begin(), near.begin.end() - 1);
  for (Pairs& pairs : parts) {
    for (const auto& [f, g] : pairs) near.others[position[f]++] = g;
    free_counted(pairs, watch);
  }
  watch.run_intervals(boxes, 1024, [&](std::size_t, std::size_t first, std::size_t last) {
    const auto at = [&](std::size_t f) { return near.others.begin() + static_cast<std::ptrdiff_t>(near.begin[f]); };
    for (std::size_t f = first; f < last; ++f) std::sort(at(f), at(f + 1));
  });
  return near;
}

/// Two sets of boxes with indices, halved alternately: of either what lies outside of the other one's box is left out.
class PairsBetween {
 public:
  PairsBetween(std::span<const Box> boxes, StageWatch& watch) : boxes_(boxes), watch_(watch) {}

  /// Sets that have no box in common.
  void add(std::vector<std::uint32_t> a, std::vector<std::uint32_t> b) {
    split(std::move(a), std::move(b), kMostDepth);
  }
  Pairs take() { return std::move(pairs_); }

 private:
  using Set = std::vector<std::uint32_t>;
  static constexpr std::size_t kFew = 256;  // pairs that are compared faster than sets are halved
  static constexpr int kMostDepth = 64;

  Box around(const Set& set) const {
    Box box;
    for (const std::uint32_t k : set) box.add(boxes_[k]);
    return box;
  }
  void keep_within(Set& set, const Box& box) const {
    std::erase_if(set, [&](std::uint32_t k) { return !overlap(boxes_[k], box); });
  }
  void compare(const Set& a, const Set& b) {
    for (const std::uint32_t f : a)
      for (const std::uint32_t g : b)
        if (overlap(boxes_[f], boxes_[g])) add_counted(pairs_, {std::min(f, g), std::max(f, g)}, watch_);
  }
  void split(Set a, Set b, int depth) {
    keep_within(a, around(b));
    keep_within(b, around(a));
    if (a.empty() || b.empty()) return;
    if (a.size() < b.size()) a.swap(b);
    if (a.size() * b.size() <= kFew || a.size() < 8 || depth == 0) return compare(a, b);
    if (++steps_ % 256 == 0) watch_.query_within_part(0.5);
    Box centres;
    for (const std::uint32_t k : a) centres.add(boxes_[k].centre());
    const Vec3 extent = centres.high - centres.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto key = [&](std::uint32_t k) {
      const Vec3 c = boxes_[k].centre();
      return axis == 0 ? c.x : axis == 1 ? c.y : c.z;
    };
    const auto half = a.begin() + static_cast<std::ptrdiff_t>(a.size() / 2);
    std::nth_element(a.begin(), half, a.end(), [&](std::uint32_t f, std::uint32_t g) {
      const double x = key(f), y = key(g);
      return x != y ? x < y : f < g;
    });
    Set rest(half, a.end());
    a.erase(half, a.end());
    split(std::move(a), b, depth - 1);
    split(std::move(rest), std::move(b), depth - 1);
  }

  std::span<const Box> boxes_;
  StageWatch& watch_;
  Pairs pairs_;
  std::size_t steps_ = 0;
};

}  // namespace

NearPairs near_pairs(std::span<const Box> boxes, StageWatch& watch) {
  watch.hold(boxes.size() * kBytesPerBox);
  const LeafTree tree(boxes);
  constexpr std::size_t kPart = 32;
  std::vector<Pairs> parts((tree.leaves().size() + kPart - 1) / kPart);
  watch.run_intervals(tree.leaves().size(), kPart, [&](std::size_t part, std::size_t first, std::size_t last) {
    for (std::size_t l = first; l < last; ++l) {
      // A leaf may meet very many others.
      if (l % 4 == 3) watch.query_within_part(static_cast<double>(l) / static_cast<double>(tree.leaves().size()));
      add_pairs(tree, static_cast<std::uint32_t>(l), boxes, parts[part], watch);
    }
  });
  NearPairs near = listed(boxes.size(), parts, watch);
  give_back(boxes.size() * kBytesPerBox, watch);
  return near;
}

NearPairs near_pairs_between(std::span<const Box> boxes, std::span<const std::uint32_t> first, StageWatch& watch) {
  watch.hold(boxes.size() * kBytesPerBox);
  std::vector<Box> groups(first.size() - 1, Box{{0, 0, 0}, {0, 0, 0}});
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (first[k] < first[k + 1]) groups[k] = boxes[first[k]];
    for (std::uint32_t i = first[k]; i < first[k + 1]; ++i) groups[k].add(boxes[i]);
  }
  const NearPairs near_groups = near_pairs(groups, watch);
  const auto members = [&](std::size_t k) {
    std::vector<std::uint32_t> list(first[k + 1] - first[k]);
    std::iota(list.begin(), list.end(), first[k]);
    return list;
  };
  std::vector<Pairs> parts(groups.size());
  watch.run(groups.size(), [&](std::size_t k) {
    PairsBetween between(boxes, watch);
    for (const std::uint32_t other : near_groups.of(k)) between.add(members(k), members(other));
    parts[k] = between.take();
  });
  NearPairs near = listed(boxes.size(), parts, watch);
  give_back(boxes.size() * kBytesPerBox, watch);
  return near;
}

}  // namespace dymsum::spatial
