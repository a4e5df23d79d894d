// Whether a vertex of a family that was read can be one: what it names is there, and its lines meet at it.
#pragma once

#include <array>
#include <optional>

#include "planar/family/scaling_cells.h"

namespace dymsum::io {

class NameCheck {
 public:
  explicit NameCheck(const planar::ScalingCells& cells) : path_(cells.path) {}

  /// What is wrong with a vertex, or null. A crossing has two contacts whose lines are not parallel, a corner lies on
  /// the lines of both contacts at every scale.
  const char* fault(const SumVertex& v) const;

 private:
  using Vector = std::array<exact::BigRational, 2>;
  /// At scale t: the line through `still` + t `moved`.
  struct Line {
    Vector direction, still, moved;
  };
  bool names_an_edge(const Contact& c) const;
  Vector vertex(std::uint32_t op, std::uint32_t source) const;
  Line line(const Contact& c) const;
  bool on_line(const SumVertex& v, const Contact& c) const;

  const planar::ScalingPath& path_;
};

}  // namespace dymsum::io
