#include "cspace/queries/patch_tree.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>

namespace dymsum::cspace {
namespace {

constexpr std::uint32_t kLeaf = 4;
constexpr double kLongest = 0.1;  // radians: boxes of longer intervals are mostly empty
constexpr double kFullTurn = 2 * std::numbers::pi;

using Box = std::array<Range, 3>;  // x, y, theta

Box join(const Box& a, const Box& b) { return {join(a[0], b[0]), join(a[1], b[1]), join(a[2], b[2])}; }

// The error of half a width, relatively: the difference from the midpoint, which is a double itself. No input shows it:
// boxes are wider by far more (kIntervalBox), and searches add what positions err by.
constexpr double kHalf = exact::rounding_bound(1, 2);

double midpoint(Range r) { return r.low / 2 + r.high / 2; }
double half(Range r) { return std::max(r.high - midpoint(r), midpoint(r) - r.low) * (1 + kHalf); }

// Splits intervals, by their indices, until few are left.
class Builder {
 public:
  Builder(const std::vector<Box>& boxes, double weight, std::vector<PatchTree::Node>& nodes)
      : boxes_(boxes), weight_(weight), nodes_(nodes), order(boxes.size()) {
    std::iota(order.begin(), order.end(), 0u);
    nodes_.emplace_back();
    fill(0, 0, static_cast<std::uint32_t>(order.size()));
  }

 private:
  struct Group {
    std::uint32_t first = 0, last = 0;
  };

  Box around(Group g) const {
    Box box = boxes_[order[g.first]];
    for (std::uint32_t k = g.first; k < g.last; ++k) box = join(box, boxes_[order[k]]);
    return box;
  }

  std::uint32_t split(Group g) {
    const Box box = around(g);
    const std::array<double, 3> extent{box[0].high - box[0].low, box[1].high - box[1].low,
                                       weight_ * (box[2].high - box[2].low)};
    const std::size_t axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
    const std::uint32_t center = (g.first + g.last) / 2;
    const auto key = [&](std::uint32_t k) { return boxes_[k][axis].low + boxes_[k][axis].high; };
    std::nth_element(order.begin() + g.first, order.begin() + center, order.begin() + g.last,
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    return center;
  }

  void fill(std::uint32_t node, std::uint32_t first, std::uint32_t last) {
    std::vector<Group> groups{{first, last}};
    while (groups.size() < PatchTree::kWide) {
      const auto most = std::max_element(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
        return a.last - a.first < b.last - b.first;
      });
      if (most->last - most->first <= kLeaf) break;
      const Group whole = *most;
      const std::uint32_t center = split(whole);
      *most = {whole.first, center};
      groups.push_back({center, whole.last});
    }
    for (std::size_t k = 0; k < PatchTree::kWide; ++k) set(node, k, k < groups.size() ? groups[k] : Group{});
  }

  void set(std::uint32_t node, std::size_t k, Group g) {
    if (g.first == g.last) {
      nodes_[node].x_half[k] = -std::numeric_limits<double>::infinity();
      return;
    }
    const Box box = around(g);
    PatchTree::Node& n = nodes_[node];
    n.x[k] = midpoint(box[0]), n.x_half[k] = half(box[0]);
    n.y[k] = midpoint(box[1]), n.y_half[k] = half(box[1]);
    n.theta[k] = midpoint(box[2]), n.theta_half[k] = half(box[2]);
    n.first[k] = g.first;
    n.count[k] = g.last - g.first;
    if (n.count[k] <= kLeaf) {
      // How nth_element leaves them differs from library to library.
      std::sort(order.begin() + g.first, order.begin() + g.last);
      return;
    }
    n.count[k] = 0;
    const std::uint32_t child = n.first[k] = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    fill(child, g.first, g.last);
  }

  const std::vector<Box>& boxes_;
  double weight_;
  std::vector<PatchTree::Node>& nodes_;

 public:
  std::vector<std::uint32_t> order;
};

double outside(double midpoint, double half, double v) { return std::max(0.0, std::abs(v - midpoint) - half); }
// Midpoints are at most a little more than half a turn from 0, and so is v.
double angle_outside(double midpoint, double half, double v) {
  const double off = std::abs(v - midpoint);
  return std::max(0.0, std::min(off, std::abs(kFullTurn - off)) - half);
}
double squared(double v) { return v * v; }

}  // namespace

PatchTree::PatchTree(const CspaceObstacle& obstacle, const PatchForms& forms, double weight) {
  const std::vector<PatchInterval> found = make_intervals(obstacle, forms, kLongest);
  std::vector<Box> boxes;
  std::vector<Slab> slabs;
  for (const PatchInterval& s : found) {
    const IntervalBox box = box_of(forms, s);
    boxes.push_back({box.at.x, box.at.y, box.theta});
    slabs.push_back(
        {box.along, midpoint(box.u), half(box.u), midpoint(box.v), half(box.v), midpoint(box.theta), half(box.theta)});
  }
  const Builder builder(boxes, weight, nodes_);
  for (const std::uint32_t k : builder.order) {
    intervals_.push_back(found[k]);
    slabs_.push_back(slabs[k]);
  }
}

std::size_t PatchTree::bytes() const {
  return nodes_.size() * sizeof(Node) + intervals_.size() * (sizeof(PatchInterval) + sizeof(Slab));
}

std::array<double, PatchTree::kWide> square_distances(const PatchTree::Node& node, Point at, double theta,
                                                      double weight) {
  std::array<double, PatchTree::kWide> all;
  for (std::size_t k = 0; k < PatchTree::kWide; ++k) {
    const double x = outside(node.x[k], node.x_half[k], at.x), y = outside(node.y[k], node.y_half[k], at.y);
    all[k] = x * x + y * y + squared(weight * angle_outside(node.theta[k], node.theta_half[k], theta));
  }
  return all;
}

double square_distance(const PatchTree::Slab& slab, Point at, double theta, double weight) {
  const double u = outside(slab.u, slab.u_half, dot(slab.along, at));
  const double v = outside(slab.v, slab.v_half, cross(slab.along, at));
  return u * u + v * v + squared(weight * angle_outside(slab.theta, slab.theta_half, theta));
}

}  // namespace dymsum::cspace
