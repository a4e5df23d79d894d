// A closed surface of triangles that is edited: vertices merged, edges and triangles split. Every edit is the image of
// the surface under a continuous map, so it stays closed and oriented; triangles that cancel each other disappear.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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

}  // namespace dymsum::spatial
