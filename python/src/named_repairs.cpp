// Repairs by name, and coordinates on a grid.
#include "dymsum/named_repairs.h"

#include "arguments.h"
#include "bind.h"
#include "dymsum/snapping.h"
#include "enumeration.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_region_repairs(nb::module_& m) {
  enumeration<RegionRepairKind>(m, "RegionRepairKind", "The repairs of regions.");
  m.def("all_region_repairs", &all_region_repairs, "All RegionRepairKinds, in their order.");
  Record<RegionRepairOptions>(m, "RegionRepairOptions", "Which repairs of regions may be made.")
      .constructible()
      .option("kinds", &RegionRepairOptions::kinds);
  Record<RegionRepairMark>(m, "RegionRepairMark", "Where something was repaired.")
      .field("kind", &RegionRepairMark::kind)
      .field("at", &RegionRepairMark::at);
  Record<RegionRepairLog> log(m, "RegionRepairLog", "What was repaired of a region, and where.");
  log.field("counts", &RegionRepairLog::counts)
      .field("duplicate_rings", &RegionRepairLog::duplicate_rings)
      .field("marks", &RegionRepairLog::marks, "the first ones of every kind, kind by kind")
      .def("changed", &RegionRepairLog::changed)
      .def("kinds", &RegionRepairLog::kinds)
      .def("to_string", &RegionRepairLog::to_string);
  log.attr("kMostMarks") = RegionRepairLog::kMostMarks;
  Record<LoggedRegion>(m, "LoggedRegion", "A repaired region, and what was changed where.")
      .field("region", &LoggedRegion::region)
      .field("log", &LoggedRegion::log);
  m.def(
      "repair",
      [](const RegionDataArgument& data, const RegionRepairOptions& options) { return take(repair(*data, options)); },
      "data"_a, "options"_a, "repair of those kinds alone, with positions.");
}

void bind_mesh_repairs(nb::module_& m) {
  enumeration<MeshRepairKind>(m, "MeshRepairKind", "The repairs of solids.");
  m.def("all_mesh_repairs", &all_mesh_repairs, "All MeshRepairKinds, in their order.");
  enumeration<NestedShells>(m, "NestedShells", "What a shell is that runs the same way as the one around it.");
  Record<MeshRepairOptions>(m, "MeshRepairOptions", "Which repairs of solids may be made.")
      .constructible()
      .option("kinds", &MeshRepairOptions::kinds)
      .option("nested", &MeshRepairOptions::nested)
      .option("crack_width", &MeshRepairOptions::crack_width, "None: 2^-20 of the diagonal")
      .option("hole_length", &MeshRepairOptions::hole_length, "around a hole; None: half of the diagonal, of 64 edges");
  Record<MeshRepairMark>(m, "MeshRepairMark", "Where something was repaired.")
      .field("kind", &MeshRepairMark::kind)
      .field("at", &MeshRepairMark::at);
  Record<MeshRepairLog> log(m, "MeshRepairLog", "What was repaired of a solid, and where.");
  log.field("counts", &MeshRepairLog::counts)
      .field("nested_bodies", &MeshRepairLog::nested_bodies)
      .field("loose_walls", &MeshRepairLog::loose_walls)
      .field("duplicate_faces", &MeshRepairLog::duplicate_faces)
      .field("longest_hole", &MeshRepairLog::longest_hole, "of those filled: its open edges together")
      .field("marks", &MeshRepairLog::marks, "the first ones of every kind, kind by kind")
      .def("changed", &MeshRepairLog::changed)
      .def("kinds", &MeshRepairLog::kinds)
      .def("to_string", &MeshRepairLog::to_string);
  log.attr("kMostMarks") = MeshRepairLog::kMostMarks;
  Record<LoggedMesh>(m, "LoggedMesh", "A repaired solid, and what was changed where.")
      .field("mesh", &LoggedMesh::mesh)
      .field("log", &LoggedMesh::log);
  m.def(
      "repair",
      [](const MeshDataArgument& data, const MeshRepairOptions& options) { return take(repair(*data, options)); },
      "data"_a, "options"_a, "repair of those kinds alone, with positions.");
  m.def(
      "repair_with_thin_parts",
      [](const MeshDataArgument& data, const MeshRepairOptions& options) {
        return take(repair_with_thin_parts(*data, options));
      },
      "data"_a, "options"_a, "The same, and points, segments and open surfaces stay.");
}

template <class Data>
void bind_snapped(nb::module_& m, const char* name) {
  Record<Snapped<Data>>(m, name, "Coordinates on a grid, and what that moved.")
      .field("data", &Snapped<Data>::data)
      .field("report", &Snapped<Data>::report);
}

void bind_snapping(nb::module_& m) {
  Record<CoordinateGrid>(m, "CoordinateGrid", "The multiples of base^exponent, with the base 2 or 10.")
      .constructible()
      .option("base", &CoordinateGrid::base)
      .option("exponent", &CoordinateGrid::exponent)
      .def("to_string", &CoordinateGrid::to_string);
  m.def(
      "coordinate_grid", [](const std::string& text) { return take(coordinate_grid(text)); }, "text"_a,
      "The grid that a text names: \"2^-20\", \"1e-6\". Raises Error: malformed.");
  Record<SnapReport>(m, "SnapReport", "What rounding to a grid moved.")
      .field("coordinates", &SnapReport::coordinates)
      .field("moved", &SnapReport::moved)
      .field("largest_move", &SnapReport::largest_move)
      .def("to_string", &SnapReport::to_string);
  bind_snapped<RegionData>(m, "SnappedRegion");
  bind_snapped<MeshData>(m, "SnappedMesh");
  m.def(
      "snapped", [](const RegionDataArgument& data, const CoordinateGrid& grid) { return take(snapped(*data, grid)); },
      "data"_a, "grid"_a);
  m.def(
      "snapped", [](const MeshDataArgument& data, const CoordinateGrid& grid) { return take(snapped(*data, grid)); },
      "data"_a, "grid"_a, "Every coordinate rounded to the nearest multiple of the grid; not validated.");
  Record<CoordinateNoise>(m, "CoordinateNoise", "Coordinates that rounding took off a grid.")
      .field("grid", &CoordinateNoise::grid)
      .field("noisy", &CoordinateNoise::noisy)
      .field("coordinates", &CoordinateNoise::coordinates)
      .def("to_string", &CoordinateNoise::to_string);
  m.def(
      "coordinate_noise", [](const RegionDataArgument& data) { return coordinate_noise(*data); }, "data"_a);
  m.def(
      "coordinate_noise", [](const MeshDataArgument& data) { return coordinate_noise(*data); }, "data"_a,
      "The grid that coordinates are off by rounding alone; None where there is none.");
}

}  // namespace

void bind_named_repairs(nb::module_& m) {
  bind_region_repairs(m);
  bind_mesh_repairs(m);
  bind_snapping(m);
}

}  // namespace dymsum::python
