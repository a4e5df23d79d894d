#include "spatial/convex/position_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "spatial/convex/nearest_positions.h"

namespace dymsum::spatial {
namespace {

double coordinate(const Point3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

class PositionOrder {
 public:
  PositionOrder(const ConvexOperands& operands, const SolidPose& p, const SolidPose& q,
                std::span<const ConvexSum::Vertex> vertices, std::span<const Point3> nearest)
      : operands_(operands),
        poses_{p, q},
        vertices_(vertices),
        nearest_(nearest),
        rotation_{p.rotation.matrix(), q.rotation.matrix()} {
    const bool still = p == SolidPose() && q == SolidPose();
    sums_of_doubles_ = still && operands.operand[0].exact.empty() && operands.operand[1].exact.empty();
  }

  bool less(std::uint32_t a, std::uint32_t b) {
    for (int axis = 0; axis < 3; ++axis) {
      const double u = coordinate(nearest_[a], axis), v = coordinate(nearest_[b], axis);
      if (u != v) return u < v;  // rounding keeps the order
      if (const int order = order_of_rests(a, b, axis); order != 0) return order < 0;
    }
    return false;
  }

 private:
  int order_of_rests(std::uint32_t a, std::uint32_t b, int axis) {
    if (same_part(0, vertices_[a].p, vertices_[b].p, axis) && same_part(1, vertices_[a].q, vertices_[b].q, axis))
      return 0;
    if (!sums_of_doubles_ || !std::isfinite(coordinate(nearest_[a], axis))) return exact_order(a, b, axis);
    const double u = rest(a, axis), v = rest(b, axis);
    return (u > v) - (u < v);
  }

  /// Whether two vertices of an operand add the same to a coordinate, as all coordinates of theirs that count for it
  /// are the same: nearly all ties are of this kind. Others may be ties as well.
  bool same_part(std::size_t op, std::uint32_t a, std::uint32_t b, int axis) const {
    if (a == b) return true;
    const ConvexOperands::Operand& operand = operands_.operand[op];
    if (!operand.exact.empty()) return false;
    for (int k = 0; k < 3; ++k)
      if (rotation_[op][static_cast<std::size_t>(3 * axis + k)] != 0 &&
          coordinate(operand.vertices[a], k) != coordinate(operand.vertices[b], k))
        return false;
    return true;
  }

  /// What the nearest double of a sum of two doubles leaves out: a double, exactly.
  double rest(std::uint32_t vertex, int axis) const {
    const double a = coordinate(operands_.operand[0].vertices[vertices_[vertex].p], axis),
                 b = coordinate(operands_.operand[1].vertices[vertices_[vertex].q], axis), sum = a + b, taken = sum - a;
    return (a - (sum - taken)) + (b - taken);
  }

  int exact_order(std::uint32_t a, std::uint32_t b, int axis) {
    const auto at = [&](std::uint32_t v) {
      return exact::BigInteger(position(0, vertices_[v].p)[static_cast<std::size_t>(axis)] +
                               position(1, vertices_[v].q)[static_cast<std::size_t>(axis)]);
    };
    return at(a).compare(at(b));
  }

  /// Made where it is needed first: vertices of the sum share those of the operands.
  const BigVector& position(std::size_t op, std::uint32_t v) {
    if (!exactly_) {
      exactly_.emplace(operands_, poses_[0], poses_[1]);
      for (std::size_t k = 0; k < 2; ++k) positions_[k].resize(operands_.operand[k].size());
    }
    std::optional<BigVector>& known = positions_[op][v];
    if (!known) known = exactly_->of(static_cast<int>(op), v);
    return *known;
  }

  const ConvexOperands& operands_;
  std::array<SolidPose, 2> poses_;
  std::span<const ConvexSum::Vertex> vertices_;
  std::span<const Point3> nearest_;
  std::array<std::array<std::int64_t, 9>, 2> rotation_;
  bool sums_of_doubles_;
  std::optional<ExactPositions> exactly_;
  std::array<std::vector<std::optional<BigVector>>, 2> positions_;
};

}  // namespace

std::vector<Point3> nearest_positions(const ConvexOperands& operands, const SolidPose& p, const SolidPose& q,
                                      std::span<const ConvexSum::Vertex> vertices) {
  std::array<std::vector<std::uint32_t>, 2> used, position;  // vertices of the sum, and where these stand among them
  for (std::size_t op = 0; op < 2; ++op) position[op].assign(operands.operand[op].size(), kNoPair.p);
  const auto position_of = [&](std::size_t op, std::uint32_t v) {
    if (position[op][v] == kNoPair.p) {
      position[op][v] = static_cast<std::uint32_t>(used[op].size());
      used[op].push_back(v);
    }
    return position[op][v];
  };
  std::vector<VertexPair> pairs;
  pairs.reserve(vertices.size());
  for (const ConvexSum::Vertex& v : vertices) pairs.push_back({position_of(0, v.p), position_of(1, v.q)});
  NearestPositions positions(operands, {used[0], used[1]});
  positions.pose(p, q);
  std::vector<Point3> at(pairs.size());
  positions.position(pairs, at);
  return at;
}

std::vector<std::uint32_t> order_by_position(const ConvexOperands& operands, const SolidPose& p, const SolidPose& q,
                                             std::span<const ConvexSum::Vertex> vertices,
                                             std::span<const Point3> nearest) {
  // By x first, side by side with the indices; then intervals of one x, most of one vertex.
  struct Key {
    double x;
    std::uint32_t vertex;
  };
  std::vector<Key> keys;
  keys.reserve(vertices.size());
  for (std::uint32_t v = 0; v < vertices.size(); ++v) keys.push_back({nearest[v].x, v});
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.x < b.x; });
  PositionOrder positions(operands, p, q, vertices, nearest);
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const Key& key : keys) order.push_back(key.vertex);
  for (std::size_t first = 0, last = 0; first < keys.size(); first = last) {
    for (last = first + 1; last < keys.size() && keys[last].x == keys[first].x;) ++last;
    if (last - first == 1) continue;
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(first), order.begin() + static_cast<std::ptrdiff_t>(last),
              [&](std::uint32_t a, std::uint32_t b) { return positions.less(a, b); });
  }
  return order;
}

}  // namespace dymsum::spatial
