// Unions of unit cubes: sums by membership of lattice cells, as a slow independent answer for solids.
#pragma once

#include <array>
#include <cstddef>
#include <random>
#include <set>

#include "dymsum/mesh.h"

namespace dymsum::oracles {

using Voxel = std::array<int, 3>;  ///< the cube from here to (+1, +1, +1)
using Voxels = std::set<Voxel>;
using IntegerMap = std::array<std::array<int, 3>, 3>;
inline constexpr IntegerMap kNoShear{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// The boundary, every exposed square a face; the map is applied to all vertices (its determinant has to be positive).
/// Edges may have four faces, vertices several fans.
MeshData voxel_mesh(const Voxels& voxels, const IntegerMap& map = kNoShear);

/// Sizes of the open sum int P + int Q and of what is tight in its complement.
struct VoxelSum {
  std::size_t volume = 0;       ///< cubes
  std::size_t tight_faces = 0;  ///< squares in no closure of a free cube
  std::size_t tight_edges = 0;  ///< in no closure of a free cube or tight square
  std::size_t tight_points = 0;
};
/// By membership: the open sum is the union of the open cubes of size 2 at sums of voxels. O(cells of the box times
/// voxels).
VoxelSum voxel_sum(const Voxels& p, const Voxels& q);

/// Closed cells of the lattice by doubled coordinates: an odd one is a unit interval, an even one a point. So (1, 0, 0)
/// is the segment from the origin to (1, 0, 0).
using LatticeCells = std::set<Voxel>;

/// Points, segments and squares as faces, cubes as their boundary.
MeshData lattice_mesh(const LatticeCells& cells, const IntegerMap& map = kNoShear);

/// As voxel_sum of the open sum int P + Q.
VoxelSum lattice_sum(const Voxels& p, const LatticeCells& q);
/// Of both together: int P + Q and P + int Q.
VoxelSum lattice_sum_of_both(const LatticeCells& p, const LatticeCells& q);
/// Whether the closed sum holds the centre of a cell, and so all of it: doubled coordinates.
bool closed_sum_holds(const LatticeCells& p, const LatticeCells& q, const Voxel& x);
/// Of the closed sum: its cubes, and its squares, segments and points in no closure of a larger one.
VoxelSum closed_lattice_sum(const LatticeCells& p, const LatticeCells& q);
/// The volume of the union of the sums of two cells each.
std::size_t volume_of_sums(const LatticeCells& p, const LatticeCells& q);

/// A pair in boxes of at most `size` voxels a side; of some pairs Q is what fits into the gaps of P.
std::array<Voxels, 2> random_voxels(int size, std::mt19937_64& random);

}  // namespace dymsum::oracles
