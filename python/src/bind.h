// The parts of the module, each in the file of its name.
#pragma once

#include <nanobind/nanobind.h>

#include "lists.h"

namespace dymsum::python {

namespace nb = nanobind;

void bind_leaving(nb::module_& m);  // first: others let go of the GIL
void bind_errors(nb::module_& m);
void bind_exact(nb::module_& m);  // scales, orientations, rotations, poses
void bind_region(nb::module_& m);
void bind_region_io(nb::module_& m);
void bind_shapes(nb::module_& m);
void bind_planar_sum(nb::module_& m);
void bind_planar_sums(nb::module_& m);
void bind_frames(nb::module_& m);
void bind_moving_sums(nb::module_& m);
void bind_edited_sum(nb::module_& m);
void bind_family(nb::module_& m);
void bind_scale_range(nb::module_& m);
void bind_obstacle_parts(nb::module_& m);
void bind_obstacle(nb::module_& m);
void bind_queries(nb::module_& m);
void bind_obstacle_mesh(nb::module_& m);
void bind_motion(nb::module_& m);
void bind_planner(nb::module_& m);
void bind_mesh(nb::module_& m);
void bind_mesh_io(nb::module_& m);
void bind_solids(nb::module_& m);
void bind_spatial_sum(nb::module_& m);
void bind_spatial_sums(nb::module_& m);
void bind_planar_boolean(nb::module_& m);
void bind_solid_union(nb::module_& m);
void bind_named_repairs(nb::module_& m);
void bind_moving_solids(nb::module_& m);
void bind_edited_solids(nb::module_& m);
void bind_scaling_solids(nb::module_& m);
void bind_turning_solids(nb::module_& m);
void bind_solid_families(nb::module_& m);
void bind_convex_sum(nb::module_& m);
void bind_convex_solid(nb::module_& m);
void bind_depth(nb::module_& m);
void bind_local_sum(nb::module_& m);
void bind_continuous_depth(nb::module_& m);
void bind_planar_local_sum(nb::module_& m);
void bind_nesting(nb::module_& m);
void bind_nfp_table(nb::module_& m);
void bind_placement(nb::module_& m);
void bind_set_check(nb::module_& m);
void bind_growing_disc(nb::module_& m);
void bind_shape_features(nb::module_& m);
void bind_uncertain(nb::module_& m);
void bind_uncertain_solid(nb::module_& m);

}  // namespace dymsum::python
