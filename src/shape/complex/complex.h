// The complex of a region: all centres of discs that touch its boundary at two places or more and lie outside it (or
// inside it). A sum with a disc is a level of this complex, an event one of its nodes. See docs/design/growing-discs.md.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum::shape {

/// On which side of the boundary the discs lie.
enum class Side : std::uint8_t { outside, inside };

inline constexpr std::uint32_t kNoIndex = 0xffffffff;

/// A piece of boundary that a disc can touch by itself: the inside of a walk edge, or a walk vertex that is convex as
/// seen from the region (from its complement, where the discs lie inside).
struct Site {
  enum class Kind : std::uint8_t { edge, vertex };
  Kind kind = Kind::edge;
  std::uint32_t index = 0;      ///< of the edge or vertex in the region
  std::uint32_t loop = 0;       ///< closed walk of the boundary; sites of a loop are consecutive
  std::uint32_t component = 0;  ///< connected piece of the region
  Point a, b;                   ///< the edge's ends in the order of the walk, the discs on the right; equal for a vertex
};

/// A disc that touches at least two places. Nodes are sorted by radius.
struct Node {
  enum class Kind : std::uint8_t {
    corner,  ///< a reflex vertex of the boundary: radius 0
    neck,    ///< between two places opposite each other: radius smallest on its edge of the complex
    joint,   ///< three places or more, or the end of a flat edge
  };
  Kind kind = Kind::joint;
  std::uint32_t rank = 0;    ///< equal exactly for equal radii; ascending
  Point centre;              ///< each coordinate within some ulps of the larger one
  double radius = 0;         ///< within some ulps
  std::uint32_t vertex = kNoIndex;  ///< corner: of the region
};

/// Centres of discs that touch the same two sites, from node `low` up to node `high`; radii ascend strictly, or are all
/// equal (flat: two parallel edges that face each other).
struct Edge {
  std::uint32_t low = 0, high = kNoIndex;  ///< high = kNoIndex: unbounded
  std::uint32_t left = 0, right = 0;       ///< sites on the left and right of the walk from low to high
  bool flat = false;
};

/// An edge as seen from one of its nodes.
struct Spoke {
  std::uint32_t edge = 0;
  bool up = false;  ///< the edge ascends from here (its `low` is this node); a flat edge: its low is this node
};

struct Complex {
  Side side = Side::outside;
  std::vector<Site> sites;
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  std::vector<std::uint32_t> first_spoke;  ///< node -> into spokes; one more than nodes
  std::vector<Spoke> spokes;               ///< counter-clockwise about each node
  // ... what exact questions need
};

/// The disc of radius r on an edge: low radius <= r <= high radius.
struct DiscOnEdge {
  Point centre, left, right;  ///< centre and contacts, each coordinate within some ulps of the larger one
};

// Exact: how many nodes have a radius below r, and how many one of at most r.
// std::uint32_t nodes_below(const Complex&, const Rational& r); nodes_up_to(...)
// DiscOnEdge disc_on_edge(const Complex&, std::uint32_t edge, const Rational& r);
// Contacts of a node (sites and places), exact radius as an expression in text, exact comparison of a radius with a
// rational, exact comparisons of further quantities through exact/root_expression.

}  // namespace dymsum::shape
