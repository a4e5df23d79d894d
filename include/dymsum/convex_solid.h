// The sum of two convex solids in motion as a finished solid that follows: facets and positions in flat arrays whose
// indices stay, what changed from one to the next, and buffers of single-precision numbers for renderers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/convex_sum.h"
#include "dymsum/mesh.h"

namespace dymsum {

/// A run of indices.
struct IndexRange {
  std::size_t first = 0, count = 0;
  friend bool operator==(const IndexRange&, const IndexRange&) = default;
};

/// What happened to a facet from one solid to the next. Its identity is what makes it: a face of P, a face of Q (where
/// the two face the same way, that of P), or an edge of P with an edge of Q; it keeps its index as long as it is there.
struct FacetChange {
  enum class Kind : std::uint8_t {
    appeared,
    disappeared,
    reshaped,  ///< still there, with other vertices
    turned,    ///< still there, with the same vertices in the opposite order: seen from the other side
  };
  Kind kind = Kind::reshaped;
  std::uint32_t facet = 0;                                        ///< its index
  std::uint32_t vertices_appeared = 0, vertices_disappeared = 0;  ///< of its vertices, by pairs
  friend bool operator==(const FacetChange&, const FacetChange&) = default;
};

/// What changes from one solid to the next.
struct SolidChanges {
  std::vector<FacetChange> facets;  ///< sorted by index; the others have the same vertices
  std::vector<std::uint32_t> vertices_appeared, vertices_disappeared;  ///< indices, sorted
  bool moved = false;                 ///< an operand has moved: the positions of all vertices may differ
  std::vector<IndexRange> triangles;  ///< of SolidBuffers that may differ, in order, apart from each other
};

/// Positions and triangles as renderers take them, kept by the caller from solid to solid.
struct SolidBuffers {
  std::vector<float> positions;          ///< x, y, z of every vertex by its index, 0 where that is free
  std::vector<std::uint32_t> triangles;  ///< three vertices each, counter-clockwise from outside; 0, 0, 0: none
  /// What the last `write` wrote: indices of vertices (of three numbers), of triangles (of three numbers).
  std::vector<IndexRange> positions_changed, triangles_changed;
  std::uint64_t frame = 0;  ///< that of the solid written last; 0: none
};

/// The exact sum of two convex solids at one pose, the same set as ConvexSum::sum(), in an order that stays: a facet
/// and a vertex keep their indices as long as they are there, and indices that are free are taken by the next ones that
/// appear. Facets are whole (no two lie in one plane). A value; ConvexSum keeps one and brings it up to date.
struct ConvexSolid {
  static constexpr std::uint32_t kFree = 0xffffffff;

  struct Facet {
    std::uint32_t first = 0, count = 0;  ///< its vertices are corners[first], ...; none where the index is free
    std::uint32_t first_triangle = 0;    ///< its count - 2 triangles in SolidBuffers
    SolidFeature p, q;
    friend bool operator==(const Facet&, const Facet&) = default;
  };

  std::vector<ConvexSum::Vertex> vertices;  ///< pairs of vertices of the meshes; {kFree, kFree} where the index is free
  std::vector<Point3> at;                   ///< each coordinate the double nearest to the exact one
  std::vector<Facet> facets;
  std::vector<std::uint32_t> corners;  ///< indices of vertices; of a facet counter-clockwise seen from outside
  std::size_t vertex_count = 0, facet_count = 0, triangle_slots = 0;
  SolidPose p_pose, q_pose;
  SolidChanges changes;     ///< since the solid before; of the first one everything
  std::uint64_t frame = 0;  ///< 1 for the first solid, one more for every one after it, changed or not

  std::span<const std::uint32_t> corners_of(std::size_t facet) const {
    return {corners.data() + facets[facet].first, facets[facet].count};
  }
  /// Brings buffers up to date: only what differs from the solid before where they hold that one, all of it otherwise.
  /// Coordinates are the floats nearest to `at`. Requires buffers that are empty or were last written by this solid
  /// (in any of its frames). O(vertices + triangles that changed).
  void write(SolidBuffers& buffers) const;
};

}  // namespace dymsum
