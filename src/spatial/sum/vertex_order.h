// The vertices of a sum from their sources: their canonical order, and their positions in doubles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/parallel.h"
#include "dymsum/spatial_sum.h"
#include "spatial/convolution/sum_space.h"

namespace dymsum::spatial {

/// The order of points by x, y, z. `Points` has source(id) and approx(id) of each. Exact.
template <class Points>
class VertexOrder {
 public:
  VertexOrder(const SumSpace& space, const Points& points) : space_(space), points_(points) {}

  /// Sorts by the doubles of x first, then intervals in which these do not decide.
  void sort(std::vector<std::uint32_t>& ids, int threads) const {
    struct Key {
      double x;
      std::uint32_t id;
      auto operator<=>(const Key&) const = default;
    };
    std::vector<Key> keys;
    keys.reserve(ids.size());
    double radius = 0;
    for (const std::uint32_t id : ids) {
      const Approx& at = points_.approx(id);
      keys.push_back({at.at.x, id}), radius = std::max(radius, at.radius);
    }
    base::parallel_sort(keys, threads, std::less<>());
    for (std::size_t k = 0; k < keys.size(); ++k) ids[k] = keys[k].id;
    const double near = 4 * radius + space_.span() * 0x1p-50;
    for (std::size_t first = 0, last = 0; first < keys.size(); first = last) {
      for (last = first + 1; last < keys.size() && keys[last].x - keys[last - 1].x <= near;) ++last;
      std::sort(ids.begin() + static_cast<std::ptrdiff_t>(first), ids.begin() + static_cast<std::ptrdiff_t>(last),
                [&](std::uint32_t a, std::uint32_t b) { return order(a, b) > 0; });
    }
  }

 private:
  /// The sign of b's position less a's, by x, y, z.
  int order(std::uint32_t a, std::uint32_t b) const {
    if (a == b) return 0;
    const Approx &u = points_.approx(a), &v = points_.approx(b);
    const double gap[3] = {v.at.x - u.at.x, v.at.y - u.at.y, v.at.z - u.at.z};
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(gap[axis]) > 2 * (u.radius + v.radius) + space_.span() * 0x1p-50) return gap[axis] > 0 ? 1 : -1;
      const int s = space_.exact_order(points_.source(a), points_.source(b), axis);
      if (s != 0) return s;
    }
    return 0;
  }

  const SumSpace& space_;
  const Points& points_;
};

/// The space's doubles in the operands' own coordinates.
class VertexPositions {
 public:
  explicit VertexPositions(const SumSpace& space) : span_(space.span()) {
    for (int axis = 0; axis < 3; ++axis) {
      const SumSpace::Line line = space.line(axis);
      unit_[axis] = std::ldexp(1.0, line.unit), offset_[axis] = line.p_offset + line.q_offset;
    }
  }
  /// Adds a vertex to a sum, whose error becomes at least that of the vertex.
  void add(const Approx& at, SpatialSum& sum) const {
    sum.vertices.push_back(
        {at.at.x * unit_[0] + offset_[0], at.at.y * unit_[1] + offset_[1], at.at.z * unit_[2] + offset_[2]});
    for (int axis = 0; axis < 3; ++axis) {
      const double size = (span_ + at.radius) * unit_[axis] + std::abs(offset_[axis]);
      sum.at_error = std::max(sum.at_error, at.radius * unit_[axis] + size * 0x1p-51);
    }
  }

 private:
  double span_, unit_[3], offset_[3];
};

}  // namespace dymsum::spatial
