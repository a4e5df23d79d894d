// The structure of a sum, whatever its positions, and what an event changes in it: one definition for all motions.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "dymsum/spatial_sum.h"

namespace dymsum::spatial {

// Hashes that names of the parts of a sum are made of.

inline std::uint64_t mixed(std::uint64_t h, std::uint64_t v) {
  h ^= v + 0x9e3779b97f4a7c15ULL + (h << 6) + (h >> 2);
  h ^= h >> 31, h *= 0x7fb5d329728ea185ULL, h ^= h >> 27, h *= 0x81dadef4bc2dd44dULL;
  return h ^ (h >> 33);
}
/// A hash of values in any order, which it sorts.
inline std::uint64_t mixed_list(std::uint64_t seed, std::vector<std::uint64_t>& values) {
  std::sort(values.begin(), values.end());
  for (const std::uint64_t v : values) seed = mixed(seed, v);
  return mixed(seed, values.size());
}

// Euler numbers of the shells of a sum.

/// V - E + F of every shell, sorted; a face with h holes counts 1 - h. Where shells, or parts of one, touch in a vertex
/// or along an edge, it counts once for each of the surfaces that go on there: faces go together that bound one wedge
/// of the outside. So 2 - 2 g for a shell of genus g. Exact. O(n log n).
std::vector<std::int64_t> shell_euler_numbers(const SpatialSum& sum);

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
