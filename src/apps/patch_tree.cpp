#include "patch_tree.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace dymsum::apps {
namespace {

constexpr std::uint32_t kLeaf = 4;
constexpr double kLongest = 0.1;  // radians: boxes of longer stretches are mostly empty

ConfigurationBox join(const ConfigurationBox& a, const ConfigurationBox& b) {
  ConfigurationBox c;
  for (std::size_t i = 0; i < 3; ++i) {
    c.low[i] = std::min(a.low[i], b.low[i]);
    c.high[i] = std::max(a.high[i], b.high[i]);
  }
  return c;
}

double outside(double low, double high, double v) { return v < low ? low - v : v > high ? v - high : 0; }

}  // namespace

PatchTree::PatchTree(const CspaceObstacle& obstacle, const PatchForms& forms, double weight) {
  for (std::uint32_t p = 0; p < forms.forms().size(); ++p) PatchForms::split(obstacle, p, kLongest, pieces_);
  for (const PatchPiece& piece : pieces_) {
    const PointRange box = forms.box(forms[piece.patch], (piece.low + piece.high) / 2, (piece.high - piece.low) / 2);
    boxes_.push_back({{box.x.low, box.y.low, piece.low}, {box.x.high, box.y.high, piece.high}});
  }
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(pieces_.size()), weight);
}

void PatchTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t last, double weight) {
  ConfigurationBox box = boxes_[first];
  for (std::uint32_t k = first; k < last; ++k) box = join(box, boxes_[k]);
  nodes_[node].box = box;
  if (last - first <= kLeaf) {
    nodes_[node].first = first;
    nodes_[node].count = last - first;
    nodes_[node].leaf = true;
    return;
  }
  const std::array<double, 3> extent{box.high[0] - box.low[0], box.high[1] - box.low[1],
                                     weight * (box.high[2] - box.low[2])};
  const std::size_t axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  const std::uint32_t middle = (first + last) / 2;
  std::vector<std::uint32_t> order(last - first);
  std::iota(order.begin(), order.end(), first);
  const auto center = [&](std::uint32_t k) { return boxes_[k].low[axis] + boxes_[k].high[axis]; };
  std::nth_element(order.begin(), order.begin() + (middle - first), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return center(a) != center(b) ? center(a) < center(b) : a < b;
  });
  std::vector<PatchPiece> pieces;
  std::vector<ConfigurationBox> boxes;
  for (const std::uint32_t k : order) {
    pieces.push_back(pieces_[k]);
    boxes.push_back(boxes_[k]);
  }
  std::copy(pieces.begin(), pieces.end(), pieces_.begin() + first);
  std::copy(boxes.begin(), boxes.end(), boxes_.begin() + first);
  const std::uint32_t child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = child;
  nodes_.resize(nodes_.size() + 2);
  build(child, first, middle, weight);
  build(child + 1, middle, last, weight);
}

std::size_t PatchTree::bytes() const {
  return nodes_.size() * sizeof(Node) + pieces_.size() * (sizeof(PatchPiece) + sizeof(ConfigurationBox));
}

double square_distance(const ConfigurationBox& box, Point at, double theta, double weight) {
  const double dx = outside(box.low[0], box.high[0], at.x), dy = outside(box.low[1], box.high[1], at.y);
  double turn = outside(box.low[2], box.high[2], theta);
  for (const double shift : {-2 * std::numbers::pi, 2 * std::numbers::pi})
    turn = std::min(turn, outside(box.low[2], box.high[2], theta + shift));
  return dx * dx + dy * dy + (turn == 0 ? 0 : weight * weight * turn * turn);
}

}  // namespace dymsum::apps
