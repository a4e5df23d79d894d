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
  NearPairs near;
  near.begin.assign(boxes.size() + 1, 0);
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
  give_back(boxes.size() * kBytesPerBox, watch);
  watch.run_intervals(boxes.size(), 1024, [&](std::size_t, std::size_t first, std::size_t last) {
    const auto at = [&](std::size_t f) { return near.others.begin() + static_cast<std::ptrdiff_t>(near.begin[f]); };
    for (std::size_t f = first; f < last; ++f) std::sort(at(f), at(f + 1));
  });
  return near;
}

}  // namespace dymsum::spatial
