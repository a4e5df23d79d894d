// Edits of a mesh's data, with names of its vertices and faces.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/editable_solid_sum.h"

namespace dymsum::spatial {

/// Mesh data that need not be valid, with the names of what they hold.
struct NamedMeshData {
  MeshData data;
  std::vector<std::uint64_t> vertex_names, face_names, face_ancestors;
  std::uint64_t next_name = 1;  ///< greater than all of them
};

/// Makes one edit. Error out_of_range for what there is not or cannot be; `edited` is then as it was. O(n); remove: and
/// a validation for each triangulation of the gap that is tried.
Result<void> apply(const SolidEdit& edit, NamedMeshData& edited);

}  // namespace dymsum::spatial
