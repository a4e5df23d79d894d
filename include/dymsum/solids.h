// Generators of solid test and demo shapes. All return valid meshes; same arguments, same coordinates everywhere.
// Arguments that are coordinates, as those of a box, are coordinates of the mesh as they are; all others are the
// nearest doubles of a cube's lattice, and within a few units of the last place of circles, spheres and regular solids.
// On request (`snap`, a power of two) every coordinate is rounded to its nearest multiple of `snap`, ties up:
// coordinates of fewer bits are in a smaller tier. Arguments that give no valid solid throw std::invalid_argument.
#pragma once

#include <string_view>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/region.h"

namespace dymsum::solids {

inline constexpr double kDemoSnap = 0x1p-20;  ///< a `snap` for shapes of about unit size: what thesis_models have

Mesh box(double x0, double y0, double z0, double x1, double y1, double z1, double snap = 0);  ///< 6 quadrangles
/// A prism over a simple counter-clockwise ring, from z = 0: 2 faces and one for each edge.
Mesh prism(const Ring& base, double height, double snap = 0);
/// A cube of this size about the origin, every face split into k x k squares of two triangles: 12 k^2 triangles.
Mesh tessellated_cube(double size, int k, double snap = 0);
Mesh cone(int sides, double radius, double height, double snap = 0);       ///< triangles only: 2 sides - 2
Mesh cylinder(int sides, double radius, double height, double snap = 0);   ///< triangles only: 4 sides - 4
Mesh dipyramid(int sides, double radius, double height, double snap = 0);  ///< 2 sides triangles
Mesh pyramid(int sides, double radius, double height, double snap = 0);    ///< triangles only: 2 sides - 2
/// An icosahedron with every face split into frequency^2: 20 frequency^2 triangles.
Mesh geodesic_sphere(int frequency, double radius, double snap = 0);
/// 2 slices (stacks - 1) triangles.
Mesh ellipsoid(int slices, int stacks, double rx, double ry, double rz, double snap = 0);
Mesh triakis_icosahedron(double radius, double snap = 0);          ///< 60 triangles
Mesh truncated_icosidodecahedron(double radius, double snap = 0);  ///< 236 triangles
/// A capsule, stacks odd: 2 slices (stacks - 1) triangles.
Mesh rod(int slices, int stacks, double radius, double length, double snap = 0);

/// Stand-ins for the models of the thesis's figures 5.3 and 5.4, with their facet counts: cone 78, cube 12, cylinder
/// 140, DD 32 (a 16-sided dipyramid), ellipse 960, GS1 80, GS2 180, GS3 320, GS4 500, HP 10, T 60, TI 236, v-rod 324.
/// Their coordinates are multiples of kDemoSnap.
struct NamedMesh {
  std::string_view name;
  Mesh mesh;
};
std::vector<NamedMesh> thesis_models();

}  // namespace dymsum::solids
