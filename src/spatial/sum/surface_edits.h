// A closed surface of triangles that is edited: vertices merged, edges and triangles split. Every edit is the image of
// the surface under a continuous map, so it stays closed and oriented; triangles that cancel each other disappear.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::spatial {

class SurfaceEdits {
 public:
  struct Part {
    std::array<std::uint32_t, 3> v;
    std::uint32_t face;
    double moved;  ///< no point of it is further from where it came from
    bool live = true;
  };

  /// `moved`: how far rounding may have moved its points already.
  SurfaceEdits(const MeshData& triangles, const std::vector<std::uint32_t>& faces, double moved);

  /// Vertex u becomes w. Their distance is at most `by`.
  void merge(std::uint32_t u, std::uint32_t w, double by);
  /// The edge a b gets the vertex p, which is at most `by` from a point of it. Triangles that have p already vanish.
  void split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t p, double by);
  /// The same for a triangle, of which p is no corner.
  void split_part(std::uint32_t part, std::uint32_t p, double by);
  std::uint32_t add_vertex(const Point3& at);

  bool has_edge(std::uint32_t a, std::uint32_t b) const;
  const std::vector<Point3>& vertices() const { return at_; }
  const std::vector<Part>& parts() const { return parts_; }
  double moved() const { return moved_; }  ///< of any point, also of those that vanished

 private:
  void kill(std::uint32_t part);
  void add(const Part& part);  ///< or take away what it cancels

  std::vector<Point3> at_;
  std::vector<Part> parts_;
  std::vector<std::vector<std::uint32_t>> around_;  // of every vertex its parts; dead ones are left in
  double moved_ = 0;
};

// The numbers by which the topology of two surfaces of triangles is compared.

struct SurfaceTopology {
  std::size_t pieces = 0;  ///< connected, if only by a vertex
  std::int64_t euler = 0;  ///< vertices less edges plus triangles
  friend bool operator==(const SurfaceTopology&, const SurfaceTopology&) = default;
};

/// Requires that all vertices are used. O(n log n).
SurfaceTopology topology_of(const MeshData& triangles);

// What rounding did to a surface of triangles.

/// rounding_changed_topology with the position where two vertices became one, a triangle became a line, or two
/// triangles cross or touch, that did not before; nothing for a surface that stayed what it was. Requires: triangles
/// that share nothing but vertices and edges before rounding; edges and vertices may be those of more than two
/// triangles. Exact. O((n + k) log n) for k pairs with overlapping boxes.
std::optional<Error> rounding_error(const MeshData& triangles);

}  // namespace dymsum::spatial
