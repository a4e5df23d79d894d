// Generators of solid test and demo shapes. All return valid meshes whose coordinates are multiples of 2^-20; same
// arguments, same coordinates everywhere.
#pragma once

#include <string_view>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/region.h"

namespace dymsum::solids {

Mesh box(double x0, double y0, double z0, double x1, double y1, double z1);  ///< 6 quadrangles
Mesh prism(const Ring& base, double height);  ///< over a simple counter-clockwise ring, from z = 0: 2 faces + its edges
/// A cube of this size about the origin, every face split into k x k squares of two triangles: 12 k^2 triangles.
Mesh tessellated_cube(double size, int k);
Mesh cone(int sides, double radius, double height);       ///< triangles only: 2 sides - 2
Mesh cylinder(int sides, double radius, double height);   ///< triangles only: 4 sides - 4
Mesh dipyramid(int sides, double radius, double height);  ///< 2 sides triangles
Mesh pyramid(int sides, double radius, double height);    ///< triangles only: 2 sides - 2
Mesh geodesic_sphere(
    int frequency, double radius);  ///< an icosahedron with every face split into frequency^2: 20 frequency^2 triangles
Mesh ellipsoid(int slices, int stacks, double rx, double ry, double rz);  ///< 2 slices (stacks - 1) triangles
Mesh triakis_icosahedron(double radius);                                  ///< 60 triangles
Mesh truncated_icosidodecahedron(double radius);                          ///< 236 triangles
Mesh rod(int slices, int stacks, double radius,
         double length);  ///< a capsule, stacks odd: 2 slices (stacks - 1) triangles

/// Stand-ins for the models of the thesis's figures 5.3 and 5.4, with their facet counts: cone 78, cube 12, cylinder
/// 140, DD 32 (a 16-sided dipyramid), ellipse 960, GS1 80, GS2 180, GS3 320, GS4 500, HP 10, T 60, TI 236, v-rod 324.
struct NamedMesh {
  std::string_view name;
  Mesh mesh;
};
std::vector<NamedMesh> thesis_models();

}  // namespace dymsum::solids
