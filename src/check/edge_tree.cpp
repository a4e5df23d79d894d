#include "check/edge_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planar/position/exact_source.h"

namespace dymsum::check {
namespace {

double box_distance(Point low, Point high, Point p) {
  return std::hypot(std::max({low.x - p.x, p.x - high.x, 0.0}), std::max({low.y - p.y, p.y - high.y, 0.0}));
}

Point centre(const Segment& s) {
  return {s.from->near.x / 2 + s.to->near.x / 2, s.from->near.y / 2 + s.to->near.y / 2};
}

}  // namespace

std::vector<Segment> edges_of(const PlanarSum& set) {
  std::vector<Segment> edges;
  const auto point = [&](const SumVertex& v) {
    return std::make_shared<const ExactPoint>(exact_source(set)->homogeneous(v));
  };
  const auto add_ring = [&](const SumRing& ring) {
    std::vector<PointRef> points;
    for (const SumVertex& v : ring.vertices) points.push_back(point(v));
    for (std::size_t k = 0; k < points.size(); ++k) edges.push_back({points[k], points[(k + 1) % points.size()]});
  };
  for (const SumPart& part : set.parts) {
    add_ring(part.outer);
    for (const SumRing& hole : part.holes) add_ring(hole);
  }
  for (const SumSegment& s : set.segments) edges.push_back({point(s.from), point(s.to)});
  for (const SumVertex& v : set.points) {
    const PointRef p = point(v);
    edges.push_back({p, p});
  }
  return edges;
}

EdgeTree::EdgeTree(std::vector<Segment> edges) : edges_(std::move(edges)) {
  for (const Segment& s : edges_)
    for (const PointRef& p : {s.from, s.to}) reach_ = std::max({reach_, std::abs(p->near.x), std::abs(p->near.y)});
  if (!edges_.empty()) add_node(0, static_cast<std::uint32_t>(edges_.size()));
}

void EdgeTree::add_node(std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t kLeaf = 4;
  Point low = edges_[first].from->near, high = low;
  for (std::uint32_t k = first; k < last; ++k)
    for (const PointRef& p : {edges_[k].from, edges_[k].to}) {
      low = {std::min(low.x, p->near.x), std::min(low.y, p->near.y)};
      high = {std::max(high.x, p->near.x), std::max(high.y, p->near.y)};
    }
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({low, high, first, last, 0});
  if (last - first <= kLeaf) return;
  const bool wide = high.x - low.x > high.y - low.y;
  const std::uint32_t half = first + (last - first) / 2;
  std::nth_element(
      edges_.begin() + first, edges_.begin() + half, edges_.begin() + last,
      [&](const Segment& a, const Segment& b) { return wide ? centre(a).x < centre(b).x : centre(a).y < centre(b).y; });
  add_node(first, half);
  nodes_[node].right = static_cast<std::uint32_t>(nodes_.size());
  add_node(half, last);
}

void EdgeTree::collect(Point p, double slack, double& best,
                       std::vector<std::pair<double, std::uint32_t>>& found) const {
  std::vector<std::pair<double, std::uint32_t>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [distance, k] = stack.back();
    stack.pop_back();
    if (distance > best + slack) continue;
    const Node& node = nodes_[k];
    if (node.right == 0) {
      for (std::uint32_t e = node.first; e < node.last; ++e) {
        const double d = check::rough_distance(p, edges_[e]);
        if (d > best + slack) continue;  // not so for what is no number
        if (d < best) best = d;
        found.emplace_back(d, e);
      }
      continue;
    }
    const std::uint32_t left = k + 1;
    std::pair<double, std::uint32_t> one{box_distance(nodes_[left].low, nodes_[left].high, p), left},
        other{box_distance(nodes_[node.right].low, nodes_[node.right].high, p), node.right};
    if (one.first < other.first) std::swap(one, other);
    stack.push_back(one);
    stack.push_back(other);
  }
}

std::uint32_t EdgeTree::rough_nearest(Point p) const {
  double best = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, std::uint32_t>> found;
  collect(p, 0, best, found);
  return std::min_element(found.begin(), found.end())->second;
}

EdgeTree::Nearest EdgeTree::nearest(const ExactPoint& p) const {
  const double slack = slack_of(reach_ + std::abs(p.near.x) + std::abs(p.near.y));
  double best = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, std::uint32_t>> found;
  collect(p.near, slack, best, found);
  std::optional<Nearest> nearest;
  for (const auto& [distance, edge] : found) {
    if (distance > best + slack) continue;
    Fraction squared = squared_distance(p, edges_[edge]);
    if (!nearest || squared < nearest->squared) nearest = Nearest{std::move(squared), edge};
  }
  return *std::move(nearest);
}

}  // namespace dymsum::check
