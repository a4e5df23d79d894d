#include "nearest_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace dymsum::apps {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kShortest = 0x1p-40;  // radians: what is left open on shorter stretches is part of the error
constexpr double kAngleMargin = 0x1p-46;

struct Task {
  double square = 0;  // lower bound
  bool is_node = true;
  std::uint32_t index = 0;  // of a node or a patch
  double middle = 0, half = 0, shift = 0;
  friend bool operator<(const Task& a, const Task& b) { return a.square > b.square; }  // least first on a heap
};

class Search {
 public:
  Search(const PatchForms& forms, const PatchTree& tree, Point from, double theta, double weight)
      : forms_(forms), tree_(tree), from_(from), theta_(theta), weight_(weight), distance_(forms, from, theta, weight) {
    best_.distance = std::numeric_limits<double>::infinity();
    open_ = best_.distance;
  }

  NearestPatch run() {
    push_node(0);
    double least = std::numeric_limits<double>::infinity();
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Task task = heap_.back();
      heap_.pop_back();
      if (std::sqrt(task.square) >= good_enough()) {
        least = std::sqrt(task.square);
        break;
      }
      if (task.is_node)
        open(tree_.nodes()[task.index]);
      else
        halve(task);
    }
    // Nothing is nearer than the least bound that is left, however far the best point is behind it.
    const double bound = std::min({least, open_, best_.distance});
    best_.error = best_.distance - bound + best_.point.error + 0x1p-40 * forms_.size() + 0x1p-44 * weight_;
    return best_;
  }

 private:
  // It is no use to be more exact than the best point is known.
  double good_enough() const { return best_.distance * (1 - 1e-9) - 0x1p-37 * forms_.size() - best_.point.error; }

  void push(const Task& task) {
    if (std::sqrt(task.square) >= best_.distance) return;
    heap_.push_back(task);
    std::push_heap(heap_.begin(), heap_.end());
  }
  void push_node(std::uint32_t index) {
    push({square_distance(tree_.nodes()[index].box, from_, theta_, weight_), true, index, 0, 0, 0});
  }

  void open(const PatchTree::Node& node) {
    if (!node.leaf) {
      push_node(node.first);
      push_node(node.first + 1);
      return;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      if (std::sqrt(square_distance(tree_.box(k), from_, theta_, weight_)) >= best_.distance) continue;
      const PatchPiece& piece = tree_.piece(k);
      for (const double shift : {-kTurn, 0.0, kTurn}) {
        const double low = piece.low + shift - theta_, high = piece.high + shift - theta_;
        if (low <= kTurn / 2 + kAngleMargin && high >= -kTurn / 2 - kAngleMargin)
          add(piece.patch, (piece.low + piece.high) / 2, (piece.high - piece.low) / 2, shift);
      }
    }
  }

  void halve(const Task& t) {
    if (t.half < kShortest) {
      open_ = std::min(open_, std::sqrt(t.square));
      return;
    }
    add(t.index, t.middle - t.half / 2, t.half / 2, t.shift);
    add(t.index, t.middle + t.half / 2, t.half / 2, t.shift);
  }

  void add(std::uint32_t patch, double middle, double half, double shift) {
    ++best_.bounds;
    const PatchDistance::Bound bound = distance_.lower(patch, middle, half, shift);
    if (std::sqrt(bound.square) >= best_.distance) return;
    take(patch, distance_.nearest(patch, bound.at_end ? bound.end : middle, shift));
    if (bound.at_end)
      open_ = std::min(open_, std::sqrt(bound.square));
    else
      push({bound.square, false, patch, middle, half, shift});
  }

  void take(std::uint32_t patch, const PatchPoint& point) {
    if (!(point.distance + point.error < best_.distance + best_.point.error)) return;
    best_.distance = point.distance;
    best_.patch = patch;
    best_.point = point;
  }

  const PatchForms& forms_;
  const PatchTree& tree_;
  Point from_;
  double theta_, weight_;
  PatchDistance distance_;
  std::vector<Task> heap_;
  NearestPatch best_;
  double open_ = 0;  // the least bound among stretches that are not divided any more
};

}  // namespace

NearestPatch nearest_patch(const PatchForms& forms, const PatchTree& tree, Point from, double theta, double weight) {
  return Search(forms, tree, from, theta, weight).run();
}

NearestPatch nearest_patch_at(const PatchForms& forms, const PatchTree& tree, Point from, double theta) {
  NearestPatch best;
  best.distance = std::numeric_limits<double>::infinity();
  const PatchDistance distance(forms, from, theta, 0);
  std::vector<std::uint32_t> stack{0};
  const auto off = [&](const ConfigurationBox& box) {
    return theta < box.low[2] - kAngleMargin || theta > box.high[2] + kAngleMargin;
  };
  while (!stack.empty()) {
    const PatchTree::Node& node = tree.nodes()[stack.back()];
    stack.pop_back();
    const double bound = std::sqrt(square_distance(node.box, from, theta, 0));
    if (off(node.box) || bound >= best.distance + best.point.error) continue;
    if (!node.leaf) {
      stack.push_back(node.first);
      stack.push_back(node.first + 1);
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      if (off(tree.box(k))) continue;
      const PatchPiece& piece = tree.piece(k);
      ++best.bounds;
      const PatchPoint point = distance.nearest(piece.patch, theta, 0);
      if (!(point.distance + point.error < best.distance + best.point.error)) continue;
      best.distance = point.distance;
      best.patch = piece.patch;
      best.point = point;
    }
  }
  best.error = best.point.error + 0x1p-40 * forms.size();
  return best;
}

}  // namespace dymsum::apps
