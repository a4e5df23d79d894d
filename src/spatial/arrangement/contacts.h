// The segments and points in which two facets in different planes meet.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "spatial/arrangement/near_pairs.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

// The facets of a convolution with what they have in common: planes, and edges of sums.

struct TableFacet {
  SumFacet facet;
  PlaneId plane = 0;              ///< the same for all facets in one plane
  std::int8_t side = 1;           ///< -1 where the facet's normal is opposite to the plane's
  std::array<EdgeId, 4> edge{};   ///< of the facet edge from corner k to corner k + 1
  std::array<bool, 4> forward{};  ///< whether it runs along the edge
};

struct FacetTable {
  std::vector<TableFacet> facets;
  std::vector<bool> inner;  ///< per edge of the space: see find_inner_edges; empty where nobody looked

  bool is_inner(EdgeId edge) const { return !inner.empty() && inner[edge]; }
  SumPoint corner(std::uint32_t f, int k) const { return facets[f].facet.corner[k]; }
};

/// Adds the planes and edges to the space. O(n log n), and an exact comparison for every facet that shares a plane.
FacetTable facet_table(SumSpace& space, const ReducedConvolution& convolution, StageWatch& watch);

/// Marks the edges of sums that split a face and bound nothing: an edge inside a face of one operand, between two of
/// its triangles, plus a vertex, where both triangles plus that vertex are in the table. O(n).
void find_inner_edges(const SumSpace& space, const SolidOperand& p, const SolidOperand& q, FacetTable& table);

/// Marks the edges of sums that have two facets, of one plane and with one normal, on their two sides: nothing changes
/// across them. O(n).
void find_inner_edges(const SumSpace& space, FacetTable& table);

/// The common points of facets f < g, from `from` to `to` in the direction n_f x n_g of their planes' normals; one
/// point where both are equal. `from_inner`: there the contact goes on into neighbours across inner edges of the table,
/// and nothing ends but triangles; likewise `to_inner`.
struct Contact {
  std::uint32_t f = 0, g = 0;
  PointSource from, to;
  bool from_inner = false, to_inner = false;
  bool point() const { return from == to; }
};

struct ContactCounts {
  std::uint64_t box_pairs = 0, contacts = 0;
};

struct Contacts {
  std::vector<Contact> contacts;                       ///< sorted by f, g
  std::vector<std::array<std::uint32_t, 2>> coplanar;  ///< pairs in one plane whose boxes overlap
  ContactCounts counts;
};

/// The contact of two facets in different planes that share no edge. Exact.
std::optional<Contact> contact(const SumSpace& space, const FacetTable& table, std::uint32_t f, std::uint32_t g);

/// All of them, but for points at which the contacts of neighbours go on, or that are corners of both facets with
/// facet edges that end there. Where two facets in different planes share an edge of sums, that edge is all they have
/// in common, and not listed. With `within` only contacts that meet that box, on the grid, need be listed.
Contacts find_contacts(const SumSpace& space, const FacetTable& table, StageWatch& watch, const Box* within = nullptr);
/// The same of facets of several surfaces, each of which has in common with itself nothing but corners and edges of
/// sums: `near` are the pairs of facets of two surfaces that may meet. Of one surface those in one plane are listed
/// that have an edge in common.
Contacts find_contacts_between(const SumSpace& space, const FacetTable& table, NearPairs near, StageWatch& watch);

/// The interval of a facet on a plane that is none of a facet, from `from` to `to` in the direction n_f x n_plane.
struct PlaneCut {
  std::uint32_t facet = 0;
  PlaneId plane = 0;
  PointSource from, to;
  bool from_inner = false, to_inner = false;  ///< as of a Contact
};
/// The cuts of planes through facets that do not lie in them: intervals that are no points. Exact.
std::vector<PlaneCut> plane_cuts(const SumSpace& space, const FacetTable& table, std::span<const PlaneId> planes);

}  // namespace dymsum::spatial
