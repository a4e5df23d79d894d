// Bullet and Coal on convex pairs; FCL, Coal and Bullet on meshes.
#pragma once

#include <string>
#include <vector>

#include "dymsum/mesh.h"

namespace dymsum::bench {

class Report;

/// Rows of the table of convex pairs; errors are relative to `width`.
void other_convex_rows(const std::string& name, const Mesh& p, const Mesh& q, double width,
                       const std::vector<Point3>& positions, const std::vector<double>& truth, Report& report);
/// Meshes of known depth, and what each system says.
void mesh_rows(Report& report);

}  // namespace dymsum::bench
