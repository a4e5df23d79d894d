// The (x, y, theta) obstacle of a robot that translates and turns.

#include <algorithm>
#include <functional>

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/cspace_obstacle.h"
#include "dymsum/obstacle_file.h"
#include "paths.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

CspaceObstacle created_obstacle(const RegionArgument& robot, const RegionArgument& obstacle,
                                const ObstacleOptions& options) {
  return run_with(options, [&](const ObstacleOptions& own) { return CspaceObstacle::create(*robot, *obstacle, own); });
}

void require_slab(const CspaceObstacle& obstacle, std::uint32_t slab) {
  if (slab >= std::max<std::size_t>(1, obstacle.angles().size())) throw nb::index_error("no such slab");
}

/// Patches are determined by their place, or by their contacts where they are copies.
bool has_patch(const CspaceObstacle& obstacle, const Patch& patch) {
  const std::vector<Patch>& all = obstacle.patches();
  if (std::less_equal<>()(all.data(), &patch) && std::less<>()(&patch, all.data() + all.size())) return true;
  return std::any_of(all.begin(), all.end(), [&](const Patch& one) {
    return one.contact == patch.contact && one.left == patch.left && one.right == patch.right;
  });
}

void bind_obstacle_reading(nb::class_<CspaceObstacle>& type) {
  const auto here = nb::rv_policy::reference_internal;
  type.def("robot", &CspaceObstacle::robot, here)
      .def("obstacle", &CspaceObstacle::obstacle, here)
      .def("angles", &CspaceObstacle::angles, here, "The event angles, ascending in (-pi, pi].")
      .def("half_tangent", &CspaceObstacle::half_tangent, "angle"_a, "An event angle more exactly than by a double.")
      .def("events", &CspaceObstacle::events, here)
      .def("tight", &CspaceObstacle::tight, here, "Tight placements, by increasing angle.")
      .def("may_have_tight_curves", &CspaceObstacle::may_have_tight_curves)
      .def("patches", &CspaceObstacle::patches, here)
      .def("shells", &CspaceObstacle::shells, here)
      .def("free_cells", &CspaceObstacle::free_cells, here)
      .def("work", &CspaceObstacle::work, here)
      .def("slab_of", &CspaceObstacle::slab_of, "theta"_a, "The slab of an orientation, None at an event angle itself.")
      .def("inside", &CspaceObstacle::inside, "slab"_a, "A rational orientation inside a slab.")
      .def(
          "loops",
          [](const CspaceObstacle& self, std::uint32_t slab) {
            require_slab(self, slab);
            return self.loops(slab);
          },
          "slab"_a, "The boundary in a slab: loops of patch indices.")
      .def(
          "free_cell",
          [](const CspaceObstacle& self, std::uint32_t slab, std::uint32_t patch) {
            require_slab(self, slab);
            return self.free_cell(slab, patch);
          },
          "slab"_a, "patch"_a)
      .def(
          "ends",
          [](const CspaceObstacle& self, const Patch& patch, double theta) {
            if (!has_patch(self, patch)) throw nb::value_error("a patch of another obstacle");
            return self.ends(patch, theta);
          },
          "patch"_a, "theta"_a, "Where a patch starts and ends at an angle, in doubles.");
}

void bind_questions(nb::class_<CspaceObstacle>& type) {
  type.def(
          "slice",
          [](nb::handle_t<CspaceObstacle> self, const Orientation& theta, Semantics semantics) {
            const CspaceObstacle& obstacle = *nb::inst_ptr<CspaceObstacle>(self);
            SumOptions options;
            options.semantics = semantics;
            PlanarSum sum = take(without_gil([&] { return obstacle.slice(theta, semantics); }));
            return remembered(std::move(sum), "cspace_slice", obstacle.robot(), obstacle.obstacle(), theta,
                              kept(options));
          },
          "theta"_a, "semantics"_a = Semantics::closed, "The exact slice O (+) -R(theta).")
      .def("contains", &CspaceObstacle::contains, "x"_a, "y"_a, "theta"_a,
           "Whether the robot overlaps the obstacle there: touching is free. Exact; see ObstacleQueries for fast "
           "answers.")
      .def(
          "turn_marks", [](const CspaceObstacle& self, double x, double y) { return self.turn_marks(x, y); }, "x"_a,
          "y"_a, "What happens to the robot at (x, y) while it turns once.")
      .def(
          "turn_marks",
          [](const CspaceObstacle& self, double x, double y, const Orientation& from, const Orientation& to) {
            return self.turn_marks(x, y, from, to);
          },
          "x"_a, "y"_a, "from_"_a, "to"_a, "The same on the way counter-clockwise between two orientations.")
      .def("__reduce__", [](const CspaceObstacle& self) {
        return nb::make_tuple(nb::module_::import_("dymsum._core").attr("parse_obstacle"),
                              nb::make_tuple(format_obstacle(self), "pickle"));
      });
}

void bind_obstacle_class(nb::module_& m) {
  nb::class_<CspaceObstacle> type(
      m, "CspaceObstacle",
      R"doc(The exact obstacle of a robot that translates and rotates about the origin of its coordinates.

>>> from dymsum import CspaceObstacle, Orientation, shapes
>>> obstacle = CspaceObstacle(shapes.rectangle(-1.5, -0.25, 1.5, 0.25), shapes.grate(4, 2, 1, 6))
>>> len(obstacle.patches()), len(obstacle.shells()), len(obstacle.angles())
(80, 7, 8)
>>> obstacle.contains(0, 0, Orientation())
True
>>> obstacle.slice(Orientation.of(1, 1)).area_exact()
Fraction(66, 1)
)doc");
  Record<CspaceObstacle::HalfTangent>(type, "HalfTangent", "tan(theta / 2), or tan((theta - pi) / 2) where `opposite`.")
      .field("opposite", &CspaceObstacle::HalfTangent::opposite)
      .field("high", &CspaceObstacle::HalfTangent::high)
      .field("low", &CspaceObstacle::HalfTangent::low);
  type.def(
          "__init__",
          [](CspaceObstacle* self, const RegionArgument& robot, const RegionArgument& obstacle,
             const ObstacleOptions& options) { new (self) CspaceObstacle(created_obstacle(robot, obstacle, options)); },
          "robot"_a, "obstacle"_a, "options"_a = ObstacleOptions(),
          "Raises Error: unsupported_operand for pieces without area in both, empty regions, coordinates beyond 2^400; "
          "cancelled.")
      .def_static("create", &created_obstacle, "robot"_a, "obstacle"_a, "options"_a = ObstacleOptions());
  bind_obstacle_reading(type);
  bind_questions(type);
}

}  // namespace

void bind_obstacle(nb::module_& m) {
  bind_obstacle_class(m);
  m.def(
      "cspace_slice",
      [](const RegionArgument& robot, const RegionArgument& obstacle, const Orientation& theta,
         const SumOptions& options) {
        PlanarSum sum =
            run_with(options, [&](const SumOptions& own) { return cspace_slice(*robot, *obstacle, theta, own); });
        return remembered(std::move(sum), "cspace_slice", robot.object, obstacle.object, theta, kept(options));
      },
      "robot"_a, "obstacle"_a, "theta"_a, "options"_a = SumOptions(),
      R"doc(O (+) -R(theta), exactly, without the obstacle of all angles.

>>> from dymsum import Orientation, cspace_slice, shapes
>>> rod, wall = shapes.rectangle(0, 0, 2, 1), shapes.rectangle(0, 0, 4, 4)
>>> cspace_slice(rod, wall, Orientation.of_degrees(90)).bounds()
[0.0, -2.0, 5.0, 4.0]
)doc");
  m.def("format_obstacle", &format_obstacle, "obstacle"_a, "The obstacle as text; nothing is rounded.");
  m.def(
      "parse_obstacle",
      [](const std::string& text, const std::string& name) { return take(parse_obstacle(text, name)); }, "text"_a,
      "name_for_errors"_a = "text", "The obstacle of such a text. Raises Error: truncated, malformed.");
  m.def(
      "read_obstacle", [](const PathArgument& path) { return take(read_obstacle(path.text)); }, "path"_a);
}

}  // namespace dymsum::python
