// Faces that are given twice.
#pragma once

#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

/// Which faces run as one before them does, vertex by vertex; empty where none does, and where all edges have as many
/// faces in one direction as in the other, so that with them the faces are closed: as bodies given twice, which are
/// bodies that overlap. O(n log n).
std::vector<bool> duplicate_faces(const std::vector<Face>& faces);

}  // namespace dymsum::spatial
