// The thesis's own update of a local sum (Behar 2016, 7.2.3), to compare with: facets of the last place that hold no
// longer are repaired by descent from where they were; where the surface that is left ends inside the box, facets are
// looked for about its end.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/local_sum.h"

namespace dymsum::bench {

struct GapFillingWork {
  std::uint64_t ended = 0, repaired = 0;  ///< facets that hold no longer, and those that descent found
  std::uint64_t queries = 0, found = 0;   ///< boxes about open ends, and the facets in them that were missing
  bool closed = true;                     ///< in the end the surface ends only at the box
};

/// The part in a box as LocalSum has it, without tight features, as far as the thesis's method finds it: pieces of the
/// surface that hang together with nothing that was there before are missed, and nothing tells of them (its figure
/// 7.2). The first call finds all.
class GapFilling {
 public:
  GapFilling(const Mesh& p, const Mesh& q);
  ~GapFilling();

  /// Requires a box and poses that LocalSum takes.
  LocalPart in(const ClipBox& box, const SolidPose& p);
  const GapFillingWork& work() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace dymsum::bench
