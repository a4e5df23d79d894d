// What holds at every scale.
#pragma once

#include "planar/scaling/window.h"

namespace dymsum::planar {

/// Whether pairs of vertices lie on the lines of a window's segments at every scale. A side is linear in s: zero at s =
/// 1 and s = 2 is zero always.
class AlwaysOn {
 public:
  explicit AlwaysOn(const Window& window) : window_(window) {}
  bool operator()(std::uint32_t segment, Pair v);

 private:
  const Window& window_;
  std::shared_ptr<const Lattice> doubled_;  // at scale 2
};

}  // namespace dymsum::planar
