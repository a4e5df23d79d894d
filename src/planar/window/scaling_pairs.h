// Edges of both operands that cross properly when Q, reflected, stands at a position: they prove that the position lies
// in the open sum. In doubles with proved bounds, without the exact scale.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/doubles.h"
#include "base/memory_budget.h"
#include "planar/boundary/collision.h"
#include "planar/window/scaling_window.h"

namespace dymsum::planar {

class EdgeSearch {
 public:
  explicit EdgeSearch(const Window& window) : window_(window) {}

  /// A position in the window's coordinates, each within `error`.
  struct Position {
    double x, y, error, tau;
  };
  bool cross(const CrossingEdges& edges, const Position& at) const { return cross(edges, PositionPair(at, at)); }
  /// Whether the edges cross at both positions, see find_or_spare().
  bool cross(const CrossingEdges& edges, const Position& from, const Position& to) const {
    return cross(edges, PositionPair(from, to));
  }
  /// Some that cross: of those that did so recently, for what covered other positions often covers this one, or of all.
  /// Nothing where doubles know none, as where one operand lies in the other.
  std::optional<CrossingEdges> find(const Position& at) { return find(PositionPair(at, at)); }
  /// Some that cross at both positions, and so wherever between them something is that moves from one to the other in a
  /// straight line: the sum of two edges is a parallelogram whose sides do not turn. Where the last searches were in
  /// vain, only some of those requested are made.
  std::optional<CrossingEdges> find_or_spare(const Position& from, const Position& to);
  void remember(const CrossingEdges& edges) { recent_.remember(edges); }

 private:
  /// Two places.
  struct PositionPair {
    PositionPair(const Position& from, const Position& to)
        : x{from.x, to.x}, y{from.y, to.y}, error{from.error, to.error}, tau{from.tau, to.tau} {}
    Two x, y, error, tau;
  };
  /// What an operand's coordinates are multiplied by.
  Two scale(std::uint32_t op, const PositionPair& at) const { return op == window_.frame().moving ? at.tau : both(1); }
  bool cross(const CrossingEdges& edges, const PositionPair& at) const;
  bool opposite(std::uint32_t op, std::uint32_t edge, std::uint32_t other_edge, const PositionPair& at) const;
  std::optional<CrossingEdges> find_recent(const PositionPair& at) {
    return recent_.find([&](const CrossingEdges& edges) { return cross(edges, at); });
  }
  std::optional<CrossingEdges> find_new(const PositionPair& at);
  std::optional<CrossingEdges> find(const PositionPair& at) {
    const std::optional<CrossingEdges> known = find_recent(at);
    return known ? known : find_new(at);
  }
  std::optional<CrossingEdges> find_in(const EdgeTree& p, const EdgeTree& q, const PositionPair& at);
  std::optional<CrossingEdges> find_in_leaves(const EdgeTree::Node& a, const EdgeTree::Node& b,
                                              const PositionPair& at) const;

  const Window& window_;
  RecentEdges<8> recent_;
  std::uint32_t in_vain_ = 0;  ///< searches since the last one that found something, or was spared
};

/// What windows before found out about crossings inside the sum: the edges that covered one crossing of a segment often
/// cover the next one, in this window or a later one. By segments, named by their ids in one convolution. What is
/// remembered decides nothing: edges are queried again whether they cross.
class CoverMemory {
 public:
  /// A memory for a convolution with so many segments.
  explicit CoverMemory(std::uint32_t segments) : of_(segments) {}
  std::size_t bytes() const { return bytes_of(of_); }

  /// Whether edges that are remembered for one of two segments cross at both positions.
  bool covers(std::uint32_t a, std::uint32_t b, const EdgeSearch& search, const EdgeSearch::Position& from,
              const EdgeSearch::Position& to) {
    for (std::size_t k = 0; k < 2; ++k)
      for (const std::uint32_t segment : {a, b}) {
        Covers& known = of_[segment];
        if (known[k][0] == kNone || !search.cross(known[k], from, to)) continue;
        if (k > 0) std::swap(known[0], known[1]);
        return true;
      }
    return false;
  }
  void remember(std::uint32_t segment, const CrossingEdges& edges) { of_[segment] = {edges, of_[segment][0]}; }

 private:
  struct Covers : std::array<CrossingEdges, 2> {  // the last one first
    Covers() : array{CrossingEdges{kNone, kNone}, CrossingEdges{kNone, kNone}} {}
    Covers(const CrossingEdges& last, const CrossingEdges& before) : array{last, before} {}
  };
  base::CountedArray<Covers> of_;
};

}  // namespace dymsum::planar
