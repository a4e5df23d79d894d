// Edges of both operands that cross properly when Q, reflected, stands at a place: they prove that the place lies in the open sum. In
// doubles with proved bounds, without the exact scale.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "planar/scaling/window.h"

namespace dymsum::planar {

/// Walk edges of P and Q.
using CrossingEdges = std::array<std::uint32_t, 2>;

class EdgeSearch {
 public:
  explicit EdgeSearch(const Window& window) : window_(window) {}

  /// In the window's coordinates, each within `error`.
  struct Place {
    double x, y, error, tau;
  };
  bool cross(const CrossingEdges& edges, const Place& at) const;
  /// Some that cross: of those that did so lately, for what covered other places often covers this one, or of all. Nothing where doubles
  /// know none, as where one operand lies in the other.
  std::optional<CrossingEdges> find(const Place& at);
  void remember(const CrossingEdges& edges);

 private:
  bool opposite(std::uint32_t op, std::uint32_t edge, std::uint32_t other_edge, const Place& at) const;
  std::optional<CrossingEdges> find_in(const EdgeTree& p, const EdgeTree& q, const Place& at);

  const Window& window_;
  std::array<CrossingEdges, 8> lately_{};  ///< the last one first
  std::size_t known_ = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack_;
};

}  // namespace dymsum::planar
