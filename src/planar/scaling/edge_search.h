// Edges of both operands that cross properly when Q, reflected, stands at a place: they prove that the place lies in
// the open sum. In doubles with proved bounds, without the exact scale.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/two_lanes.h"
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
  bool cross(const CrossingEdges& edges, const Place& at) const { return cross(edges, Way(at, at)); }
  /// At both places, see find_or_spare().
  bool cross(const CrossingEdges& edges, const Place& from, const Place& to) const {
    return cross(edges, Way(from, to));
  }
  /// Some that cross: of those that did so lately, for what covered other places often covers this one, or of all.
  /// Nothing where doubles know none, as where one operand lies in the other.
  std::optional<CrossingEdges> find(const Place& at) { return find(Way(at, at)); }
  /// Some that cross at both places, and so wherever between them something is that moves from one to the other in a
  /// straight line: the sum of two edges is a parallelogram whose sides do not turn. Where the last searches were in
  /// vain, only some of those asked for are made.
  std::optional<CrossingEdges> find_or_spare(const Place& from, const Place& to);
  void remember(const CrossingEdges& edges);

 private:
  /// Two places.
  struct Way {
    Way(const Place& from, const Place& to)
        : x{from.x, to.x}, y{from.y, to.y}, error{from.error, to.error}, tau{from.tau, to.tau} {}
    Two x, y, error, tau;
  };
  /// What an operand's coordinates are multiplied by.
  Two scale(std::uint32_t op, const Way& at) const { return op == window_.frame().moving ? at.tau : both(1); }
  bool cross(const CrossingEdges& edges, const Way& at) const;
  bool opposite(std::uint32_t op, std::uint32_t edge, std::uint32_t other_edge, const Way& at) const;
  std::optional<CrossingEdges> find_lately(const Way& at);
  std::optional<CrossingEdges> find_new(const Way& at);
  std::optional<CrossingEdges> find(const Way& at) {
    const std::optional<CrossingEdges> known = find_lately(at);
    return known ? known : find_new(at);
  }
  std::optional<CrossingEdges> find_in(const EdgeTree& p, const EdgeTree& q, const Way& at);
  std::optional<CrossingEdges> find_in_leaves(const EdgeTree::Node& a, const EdgeTree::Node& b, const Way& at) const;

  const Window& window_;
  std::array<CrossingEdges, 8> lately_{};  ///< the last one first
  std::size_t known_ = 0;
  std::uint32_t in_vain_ = 0;  ///< searches since the last one that found something, or was spared
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack_;
};

}  // namespace dymsum::planar
