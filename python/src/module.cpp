// dymsum._core: the library's public headers as a Python module.
#include "bind.h"
#include "dymsum/version.h"

NB_MODULE(_core, m) {
  using namespace dymsum::python;
  m.doc() = "The compiled part of dymsum.";
  m.attr("__version__") = DYMSUM_VERSION;
  m.def("version", &dymsum::version, "The version of the library that runs: \"0.1.0\".");
  // What stands as a default value is bound before the functions that have it.
  for (const auto part : {bind_leaving,        bind_errors,           bind_exact,          bind_region,
                          bind_region_io,      bind_planar_sum,       bind_planar_sums,    bind_frames,
                          bind_moving_sums,    bind_family,           bind_scale_range,    bind_obstacle_parts,
                          bind_obstacle,       bind_queries,          bind_motion,         bind_planner,
                          bind_mesh,           bind_mesh_io,          bind_shapes,         bind_solids,
                          bind_spatial_sum,    bind_convex_sum,       bind_convex_solid,   bind_spatial_sums,
                          bind_named_repairs,  bind_solid_union,      bind_planar_boolean, bind_moving_solids,
                          bind_edited_solids,  bind_obstacle_mesh,    bind_nesting,        bind_nfp_table,
                          bind_placement,      bind_growing_disc,     bind_shape_features, bind_depth,
                          bind_local_sum,      bind_continuous_depth, bind_scaling_solids, bind_planar_local_sum,
                          bind_turning_solids, bind_set_check,        bind_edited_sum,     bind_solid_families,
                          bind_uncertain,      bind_uncertain_solid}) {
    part(m);
  }
}
