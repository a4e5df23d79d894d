// Segments that are edges of faces: files list them beside the faces, and they say nothing new.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::io {

class FaceEdges {
 public:
  /// The edges of the faces with three and more vertices. O(n log n).
  explicit FaceEdges(const std::vector<Face>& faces);
  /// Whether a face with two vertices is one.
  bool has(const Face& segment) const;

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted_;
};

}  // namespace dymsum::io
