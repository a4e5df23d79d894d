// The segments and points in which two facets in different planes meet.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "spatial/arrangement/facet_table.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

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
