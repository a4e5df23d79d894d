#include "spatial/mesh/duplicate_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

namespace dymsum::spatial {

namespace {

/// From its smallest vertex on.
Face from_smallest(Face face) {
  if (!face.empty()) std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  return face;
}

/// Whether every edge has as many faces in one direction as in the other.
bool all_edges_balanced(const std::vector<Face>& faces) {
  struct Side {
    std::array<std::uint32_t, 2> ends;
    bool forward;
  };
  std::vector<Side> sides;
  for (const Face& face : faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t a = face[k], b = face[k + 1 < face.size() ? k + 1 : 0];
      sides.push_back({{std::min(a, b), std::max(a, b)}, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.ends < b.ends; });
  for (std::size_t k = 0; k < sides.size();) {
    std::int64_t more = 0;
    const std::size_t first = k;
    for (; k < sides.size() && sides[k].ends == sides[first].ends; ++k) more += sides[k].forward ? 1 : -1;
    if (more != 0) return false;
  }
  return true;
}

}  // namespace

std::vector<bool> duplicate_faces(const std::vector<Face>& faces) {
  std::vector<Face> keys;
  keys.reserve(faces.size());
  for (const Face& face : faces) keys.push_back(from_smallest(face));
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  std::vector<bool> again(faces.size());
  bool any = false;
  for (std::size_t k = 1; k < order.size(); ++k)
    if (keys[order[k]] == keys[order[k - 1]]) again[order[k]] = any = true;
  if (!any || all_edges_balanced(faces)) again.clear();
  return again;
}

}  // namespace dymsum::spatial
