// The structure of a sum, whatever its positions, and what an event changes in it: one definition for all motions.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "dymsum/spatial_sum.h"

namespace dymsum::spatial {

struct SumTopology {
  std::vector<std::int64_t> euler;     ///< of every shell, sorted: shell_euler_numbers
  std::array<std::size_t, 3> tight{};  ///< faces, segments, points
  friend bool operator==(const SumTopology&, const SumTopology&) = default;
};

struct SumShape {
  std::uint64_t hash = 0;  ///< of faces by their planes, how they meet, shells, tight features, and the topology
  SumTopology topology;
  friend bool operator==(const SumShape&, const SumShape&) = default;
};

/// The name of the plane of what touches on a face, as a function of the motion: so it does not matter which of several
/// coplanar facets names a face.
using PlaneName = std::function<std::uint64_t(const SolidContact&)>;

/// Independent of the order of vertices. O(n log n), and a name for every distinct contact.
SumShape shape_of(const SpatialSum& sum, const PlaneName& plane_name);

struct ShapeChange {
  bool visible = false;   ///< the structures before, at or after differ
  bool topology = false;  ///< the topologies do
};
/// The change at an event; `at` is empty where the sum cannot be had there.
ShapeChange change_of(const SumShape& before, const std::optional<SumShape>& at, const SumShape& after);

}  // namespace dymsum::spatial
