#include "io/mesh/face_edges.h"

#include <algorithm>

namespace dymsum::io {

FaceEdges::FaceEdges(const std::vector<Face>& faces) {
  for (const Face& face : faces) {
    for (std::size_t k = 0; face.size() >= 3 && k < face.size(); ++k)
      sorted_.push_back(std::minmax(face[k], face[(k + 1) % face.size()]));
  }
  std::sort(sorted_.begin(), sorted_.end());
}

bool FaceEdges::has(const Face& segment) const {
  const std::pair<std::uint32_t, std::uint32_t> ends = std::minmax(segment[0], segment[1]);
  return std::binary_search(sorted_.begin(), sorted_.end(), ends);
}

}  // namespace dymsum::io
