// The complex of a region: all centres of discs that touch its boundary at two positions or more and lie outside it (or
// inside it). A sum with a disc is a level of this complex, an event one of its nodes. See
// docs/design/growing-discs.md.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"
#include "exact/root_expression.h"

namespace dymsum::shape {

/// The side of the boundary on which the discs lie.
enum class Side : std::uint8_t { outside, inside };

inline constexpr std::uint32_t kNoIndex = 0xffffffff;

/// A piece of boundary that a disc can touch by itself: the inside of a walk edge, or a walk vertex that is strictly
/// convex as seen from the region (from its complement, where the discs lie inside). Walks have no flat vertices: edges
/// that continue each other straight on are one site, with the index of the first in the order of the walk.
struct Site {
  enum class Kind : std::uint8_t { edge, vertex };
  Kind kind = Kind::edge;
  std::uint32_t index = 0;      ///< of the edge or vertex in the region
  std::uint32_t loop = 0;       ///< closed walk of the boundary; sites of a loop are consecutive, in its order
  std::uint32_t component = 0;  ///< connected piece of the region
  Point a, b;  ///< the edge's ends in the order of the walk, the discs on the right; equal for a vertex
};

/// A disc that touches at least two positions, or a reflex vertex. Nodes are sorted by radius.
struct Node {
  enum class Kind : std::uint8_t {
    corner,  ///< a reflex vertex of the boundary: radius 0, one spoke
    pass,    ///< two spokes: a contact goes from an edge to its end
    neck,    ///< two spokes, both up: between two positions opposite each other, the radius is smallest on its track
    joint,   ///< three positions or more
  };
  Kind kind = Kind::joint;
  std::uint32_t rank = 0;           ///< equal exactly for equal radii; ascending, without gaps
  Point centre = {};                ///< each coordinate within some ulps of the larger one
  double radius = 0;                ///< the nearest double
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

struct ExactComplex;  // exact/: the sites in integers and what every node is made of

/// What it took to make a complex.
struct Work {
  std::uint64_t candidates = 0;      ///< pairs of sites, in both orders
  std::uint64_t closing_rounds = 0;  ///< how often envelopes named pairs that were no candidates
  std::uint64_t full_sites = 0;      ///< sites that took all others as candidates
  bool certified = false;            ///< of the fast engine: without all pairs
  exact::RungCounts signs;
};

/// Nodes and edges in a canonical order: the same whatever the engine and the number of threads.
struct Complex {
  Side side = Side::outside;
  std::vector<Site> sites;
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  std::vector<std::uint32_t> first_spoke;  ///< node -> into spokes; one more than nodes
  std::vector<Spoke> spokes;               ///< counter-clockwise about each node
  std::shared_ptr<const ExactComplex> exact;
  Work work;
};

/// How the complex is made; the result is the same.
enum class Engine : std::uint8_t {
  fast,   ///< candidates from an approximate diagram, certified
  brute,  ///< every site is a candidate of every site: O(n^2) steps at least
};

/// Errors: unsupported_operand where discs lie outside and a polyline or point touches another piece of the region or
/// itself, with the position; out_of_range for coordinates beyond 2^1000 and where a node's disc is larger than doubles
/// reach; cancelled where `progress` stops it: it is queried in the stage "complex", not while the approximate diagram
/// is made, and not at the end. An empty region has the empty complex.
Result<Complex> make_complex(const Region& region, Side side, Engine engine = Engine::fast, int threads = 0,
                             const Progress& progress = {});

// Exact questions. Radii and positions are in input coordinates.

/// The radius of a node.
exact::RootExpression exact_radius(const Complex& complex, std::uint32_t node);
/// The sign of the node's radius minus r.
int compare_radius(const Complex& complex, std::uint32_t node, const Rational& r);
/// How many nodes have a radius below r; of at most r. O(log n) comparisons.
std::uint32_t nodes_below(const Complex& complex, const Rational& r);
std::uint32_t nodes_up_to(const Complex& complex, const Rational& r);

struct ExactPoint {
  exact::RootExpression x, y;
};
struct ExactDisc {
  ExactPoint centre;
  exact::RootExpression radius;
};
ExactDisc exact_disc(const Complex& complex, std::uint32_t node);

/// The position at which a disc touches.
struct Contact {
  std::uint32_t site = 0;
  Point at;  ///< each coordinate within some ulps of the larger one
};
/// The contacts of a node, clockwise about its centre; a position where an edge meets its end is one contact, of the
/// site that comes last in the walk. A corner has its two edges.
std::vector<Contact> contacts_of(const Complex& complex, std::uint32_t node);

/// The disc of radius r on an edge. Requires low radius <= r <= high radius, and an edge that is not flat.
struct DiscOnEdge {
  Point centre, left, right;  ///< centre and contacts, each coordinate within some ulps of the larger one
};
DiscOnEdge disc_on_edge(const Complex& complex, std::uint32_t edge, const Rational& r);
/// The same, exactly.
ExactPoint exact_centre_on_edge(const Complex& complex, std::uint32_t edge, const Rational& r);
/// Where the disc of a site with that centre touches it: the vertex, or the foot on the edge.
ExactPoint exact_contact(const Complex& complex, std::uint32_t site, const ExactPoint& centre);

}  // namespace dymsum::shape
