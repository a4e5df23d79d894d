// Sums of convex solids by brute force, in doubles and without proofs, written for speed: what our updates are to be
// compared with beside the thesis's brute force. Built with the library's flags.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/rotation.h"

namespace dymsum::bench {

/// Three coordinates of many vectors, each list by itself and filled up to whole blocks with zeros (points: with copies
/// of the first one).
struct Vectors {
  std::vector<double> x, y, z;
  std::size_t count = 0;
  Point3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// A convex solid: coplanar faces are one face.
struct ExpertSolid {
  explicit ExpertSolid(const Mesh& mesh);

  Vectors vertices, edges, normals;  ///< edges from a vertex to another; normals as long as the faces' areas
  struct Edge {
    std::uint32_t from, left, right;  ///< its first vertex, and the faces beside it
  };
  std::vector<Edge> sides;             ///< of the edges
  std::vector<std::uint32_t> on_face;  ///< a vertex of each face
};

class ExpertBrute {
 public:
  /// How the arcs' crossings are looked for. Both look at all pairs of edges, 64 at a time by the signs of products of
  /// normals and edges, and at few of them twice.
  enum class Signs : std::uint8_t {
    by_pairs,  ///< the signs of both faces of an edge are computed for the edge
    by_faces,  ///< those of a face once for all its edges
  };

  ExpertBrute(const Mesh& p, const Mesh& q);
  /// The extreme vertices of all faces, and all crossings, P standing there. Ties are broken by rounding.
  void build(const SolidPose& p, Signs signs);

  std::size_t crossings() const { return crossings_.size(); }
  double volume() const;  ///< from the faces' extreme vertices

 private:
  void turn(const SolidPose& pose);
  void find_extremes();
  void find_crossings(Signs signs);

  ExpertSolid p_at_rest_, p_, q_;
  std::vector<std::uint32_t> extreme_of_p_, extreme_of_q_;  ///< for each face of P (Q) the other solid's vertex
  std::vector<std::uint64_t> signs_;                        ///< a row of bits for each face, or for two
  struct Crossing {
    std::uint32_t p, q;  ///< edges
  };
  std::vector<Crossing> crossings_;
};

}  // namespace dymsum::bench
