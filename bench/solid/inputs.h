// Operands of the solid benchmark, made anew on every run: same arguments, same coordinates everywhere.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "coordinate_kinds.h"
#include "dymsum/mesh.h"

namespace dymsum::bench {

/// Generated coordinates are multiples of 2^-22, with the sizes below 26 bits, unless they are to be as computed.
enum class Snapping { snapped, raw };

/// 2 nu nv triangles about the z axis.
MeshData torus(double large, double small, int nu, int nv, Snapping = Snapping::snapped);
/// A sphere of 2 slices (stacks - 1) triangles, its radius times 1 + bump * a sum of 12 plane waves drawn by the seed.
MeshData blob(double radius, double bump, int stacks, int slices, std::uint32_t seed, Snapping = Snapping::snapped);
/// Turned about x, then y, then z, in radians.
MeshData turned(const MeshData& mesh, double x, double y, double z, Snapping = Snapping::snapped);

/// Bars along x upon bars along y, with square gaps between them.
MeshData grate(int bars);
/// A back along y with teeth along x or z.
MeshData comb(int teeth, bool upright);
/// A wheel of two units of height with so many teeth, its centre at the origin.
MeshData gear(int teeth, double radius);
MeshData ell();              ///< a cube of size 10 without a corner of 6 x 6 x 10
MeshData tunnel();           ///< a cube of size 10 about the origin with a tunnel of 2 x 2 along x
MeshData cube(double half);  ///< about the origin

struct SolidPair {
  std::string name, group;
  MeshData p, q;
  double published_ms = 0;  ///< of the best research code on this class of machine, 0 where unknown
  double limit_ms = 0;      ///< what the project promises on one core
};

/// All pairs; with real meshes where `data`/solid has them.
std::vector<SolidPair> solid_pairs(const std::string& data);
/// Tori or blobs of about so many triangles each.
SolidPair growth_pair(bool blobs, int triangles);
/// The same in coordinates of a kind; what is snapped already, not what is raw. What rounding spoils is left out, with
/// a note.
std::vector<SolidPair> with_coordinates(std::vector<SolidPair> pairs, Kind kind, std::vector<std::string>& notes);
/// Puts two solids in coordinates of a kind; what is wrong where rounding spoils one, else "".
std::string set_coordinates(MeshData& p, MeshData& q, Kind kind);
/// The pair of that name.
const SolidPair& pair_named(const std::vector<SolidPair>& pairs, std::string_view name);

}  // namespace dymsum::bench
