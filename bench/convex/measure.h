// Timings of convex sums in motion. Every system gets the same solids at the same poses; answers are compared.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dymsum/convex_sum.h"
#include "dymsum/solids.h"
#include "spread.h"

namespace dymsum::bench {

/// Means per move, in microseconds of processor time; 0 where not measured.
struct MotionRow {
  std::string p, q;
  std::size_t p_triangles = 0, q_triangles = 0, facets = 0;  ///< facets of the sum, coplanar ones whole
  double update_us = 0, static_us = 0, brute_us = 0, brute_merged_us = 0, hull_us = 0;
  double expert_pairs_us = 0, expert_faces_us = 0;  ///< see convex/expert.h
  /// Up to the finished solid: by updating, and by the static walk on operands that are there; per move.
  Spread update_solid_us, static_solid_us;
  double fresh_solid_us = 0;  ///< ConvexSum and its sum, from two meshes
  MotionWork work;            ///< totals over all moves
  std::size_t moves = 0;
  std::size_t compared = 0,
              different =
                  0;  ///< moves at which the solids of update and static walk were compared, some with all others
};

struct MotionProtocol {
  int moves = 100;
  int brute_moves = 3;  ///< of them, spread evenly, with the brute force
  int hull_moves = 0;   ///< of them, with CGAL's hull
  bool solids = false;  ///< finish them
  bool expert = false;  ///< with the expert's brute force where the thesis's is run; for poses without ties
  std::uint64_t seed = 1;
};

/// P turns about random axes, each kept for a random number of moves, by 2 pi / steps a move.
MotionRow measure_rotation(const solids::NamedMesh& p, const solids::NamedMesh& q, int steps,
                           const MotionProtocol& protocol);
/// P turns about the z axis, on which many of its directions meet those of Q; a quarter of a turn and a little more.
MotionRow measure_shared_axis(const solids::NamedMesh& p, const solids::NamedMesh& q, int steps,
                              const MotionProtocol& protocol);
/// P is scaled by random factors, each in [1/2, 2] and independent per axis.
MotionRow measure_scaling(const solids::NamedMesh& p, const solids::NamedMesh& q, const MotionProtocol& protocol);

/// One sum at a random pose beside CGAL's Nef polyhedra.
struct NefRow {
  std::string p, q;
  double ours_ms = 0, nef_ms = 0;
  std::size_t vertices = 0, nef_vertices = 0;
  bool same = false;  ///< vertices, and volume to 1e-9
};
NefRow measure_nef(const solids::NamedMesh& p, const solids::NamedMesh& q, const Rotation& turn);

}  // namespace dymsum::bench
