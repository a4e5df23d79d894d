// The facets of a sum that have to be looked at exactly.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

/// The facets of an overlay of merged operands for which something may be truly zero. Of all others its words say what
/// they are: append_face_and_vertex, and a crossing that crosses_properly.
class CloseFacets {
 public:
  /// O(faces + crossings). No memory is allocated once warm.
  void find(const Overlay& overlay);
  bool of_face(int op, std::uint32_t f) const { return faces_[op][f] != 0; }
  bool of_crossing(std::uint32_t id) const { return crossings_[id] != 0; }
  /// Memory held beside this.
  std::size_t bytes() const { return faces_[0].capacity() + faces_[1].capacity() + crossings_.capacity(); }

 private:
  std::array<std::vector<std::uint8_t>, 2> faces_;
  std::vector<std::uint8_t> crossings_;
};

}  // namespace dymsum::spatial
