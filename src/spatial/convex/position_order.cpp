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
      : operands_(operands), poses_{p, q}, vertices_(vertices), nearest_(nearest) {
    for (std::size_t op = 0; op < 2; ++op) {
      const std::array<std::int64_t, 9> rotation = poses_[op].rotation.matrix();
      for (std::size_t k = 0; k < 9; ++k) depends_[op][k / 3] |= rotation[k] != 0 ? 1U << k % 3 : 0U;
    }
    const bool still = p == SolidPose() && q == SolidPose();
    sums_of_doubles_ = still && operands.operand[0].exact.empty() && operands.operand[1].exact.empty();
  }

  bool less(std::uint32_t a, std::uint32_t b) {
    const Apart apart{apart_along(0, vertices_[a].p, vertices_[b].p), apart_along(1, vertices_[a].q, vertices_[b].q)};
    const Point3 &u = nearest_[a], &v = nearest_[b];
    if (const int x = order(a, b, 0, u.x, v.x, apart)) return x < 0;
    if (const int y = order(a, b, 1, u.y, v.y, apart)) return y < 0;
    return order(a, b, 2, u.z, v.z, apart) < 0;
  }

 private:
  using Apart = std::array<unsigned, 2>;

  /// The order along an axis, from the nearest doubles: rounding keeps the order.
  int order(std::uint32_t a, std::uint32_t b, std::size_t axis, double u, double v, const Apart& apart) {
    if (u != v) return u < v ? -1 : 1;
    // Nearly all ties are of this kind. Others may be ties as well.
    if ((apart[0] & depends_[0][axis]) == 0 && (apart[1] & depends_[1][axis]) == 0) return 0;
    return order_of_rests(a, b, static_cast<int>(axis));
  }
  int order_of_rests(std::uint32_t a, std::uint32_t b, int axis) {
    if (!sums_of_doubles_ || !std::isfinite(coordinate(nearest_[a], axis))) return exact_order(a, b, axis);
    const double u = rest(a, axis), v = rest(b, axis);
    return (u > v) - (u < v);
  }

  /// The axes along which two vertices of an operand lie apart, as bits; all of them where that is not looked at.
  unsigned apart_along(std::size_t op, std::uint32_t a, std::uint32_t b) const {
    if (a == b) return 0;
    const ConvexOperands::Operand& operand = operands_.operand[op];
    if (!operand.exact.empty()) return 7;
    const Point3 &u = operand.vertices[a], &v = operand.vertices[b];
    return (u.x != v.x ? 1U : 0U) | (u.y != v.y ? 2U : 0U) | (u.z != v.z ? 4U : 0U);
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
  std::array<std::array<unsigned, 3>, 2> depends_{};  // of each operand, each coordinate: on which of its own, as bits
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
  // What sorts vertices by x first, side by side with the indices; then come intervals of one x, most of one vertex.
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
