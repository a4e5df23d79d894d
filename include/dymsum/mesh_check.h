// Everything that is wrong with a mesh, where Mesh::create stops at the first fault.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/rational.h"
#include "dymsum/result.h"

namespace dymsum {

struct MeshCheck {
  /// In the order of Mesh's checks, those of a kind in the order of the lists: coordinates, indices, faces without
  /// three vertices or with one twice, vertices at one position, vertices without a face, faces by themselves, faces
  /// that are there twice, edges, faces that meet, shells. As the errors of Mesh::create, with the same evidence, and a
  /// position where there is one. Faces that are wrong by themselves are left out of what follows, and vertices at one
  /// position are one there.
  std::vector<Error> faults;
  std::uint64_t count = 0;      ///< of all faults, also those beyond MeshCheckOptions::listed
  std::uint64_t crossings = 0;  ///< of these, pairs of faces that cross, touch or lie on each other
  std::size_t open_edges = 0;   ///< edges with a face on one side only
  std::size_t shells = 0;       ///< pieces that edges connect, of faces that are right by themselves
  /// Of closed and oriented surfaces, what they enclose by winding number, counted as often as they go around it.
  std::optional<Rational> volume;
  bool valid() const { return count == 0; }
};

struct MeshCheckOptions {
  std::size_t listed = 1000;  ///< how many faults are kept; all are counted
};

/// Exact; nothing is repaired. A mesh without faults is one that Mesh::create takes. O((n + k) log n) for k pairs of
/// faces with overlapping boxes.
MeshCheck check_mesh(const MeshData& data, const MeshCheckOptions& options = {});

}  // namespace dymsum
