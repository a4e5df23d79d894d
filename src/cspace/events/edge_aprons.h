// What lies beside the edges of an operand: where a point that is a little to the left of an edge's line is provably
// in its interior.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

class EdgeAprons {
 public:
  /// Points that lie at most `depth` to the left of an edge's line.
  EdgeAprons(const TurningForms& forms, double depth) : forms_(forms), depth_(depth) {
    for (std::uint32_t op = 0; op < 2; ++op) clear_[op].assign(forms.size(op), kUnknown);
  }

  enum class Beside : std::uint8_t {
    no,    ///< nothing is known of it
    edge,  ///< in the interior, if left of the edge
    prev,  ///< if left of the edge and of the one before it
    next,  ///< of the one after it
  };
  /// What lies beside a point at `along` (a length along an edge from its start) and `left` of its line, both of which
  /// may err by a quarter of the depth. Sharp corners, edges that are not much longer than the depth or near to others,
  /// and pieces without area: no.
  Beside beside(std::uint32_t op, std::uint32_t edge, double along, double left);

 private:
  static constexpr std::uint8_t kUnknown = 2;
  bool clear(std::uint32_t op, std::uint32_t edge) const;
  bool blunt(std::uint32_t op, std::uint32_t edge, std::uint32_t next) const;

  const TurningForms& forms_;
  double depth_;
  std::array<std::vector<std::uint8_t>, 2> clear_;
};

}  // namespace dymsum::planar
