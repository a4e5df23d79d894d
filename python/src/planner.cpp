// Paths, or why there is none; and checks of whole paths.
#include "dymsum/planner.h"

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/path_check.h"
#include "enumeration.h"
#include "record.h"

namespace dymsum::python {

/// An ExactConfiguration, or (x, y, theta) with an exact position and an angle in radians.
struct ConfigurationArgument {
  std::array<Result<Rational>, 2> position = {Rational(), Rational()};
  double radians = 0;
  std::optional<ExactConfiguration> exact;
  /// Raises what is wrong with the numbers.
  ExactConfiguration value() const {
    if (exact) return *exact;
    RationalPoint at{take(Result<Rational>(position[0])), take(Result<Rational>(position[1]))};
    return {std::move(at), take(Orientation::nearest(radians))};
  }
};

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::python::ConfigurationArgument> {
  NB_TYPE_CASTER(dymsum::python::ConfigurationArgument,
                 const_name("dymsum.ExactConfiguration | collections.abc.Sequence[fractions.Fraction | float]"))
  bool from_python(handle src, uint32_t, cleanup_list*) {
    value = {};
    if (isinstance<dymsum::ExactConfiguration>(src)) value.exact = *inst_ptr<dymsum::ExactConfiguration>(src);
    return value.exact || dymsum::python::read_configuration(src, value.position, value.radians);
  }
};

}  // namespace nanobind::detail

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_waypoint(nb::module_& m) {
  Record<Waypoint> waypoint(m, "Waypoint", "A point of a path, and how it is reached.");
  enumeration<Waypoint::Move>(waypoint, "Move", "How a waypoint is reached.");
  waypoint.constructible()
      .field("move", &Waypoint::move)
      .field("at", &Waypoint::at, "exactly")
      .field("theta", &Waypoint::theta, "exactly")
      .field("approx", &Waypoint::approx);
}

void bind_exact_placements(nb::module_& m) {
  Record<ExactConfiguration>(m, "ExactConfiguration",
                             R"doc(A configuration of numbers that doubles may not hold: a position and an Orientation.

>>> from fractions import Fraction
>>> from dymsum import ExactConfiguration, Orientation
>>> ExactConfiguration((Fraction(1, 3), 0), Orientation.of(1, 2)).at.x
Fraction(1, 3)
)doc")
      .constructible()
      .field("at", &ExactConfiguration::at)
      .field("theta", &ExactConfiguration::theta);
  Record<ExactPose>(m, "ExactPose", "A pose whose position doubles may not hold; theta is in radians.")
      .constructible()
      .field("at", &ExactPose::at)
      .field("theta", &ExactPose::theta);
}

void bind_no_path(nb::module_& m) {
  Record<FreeComponent>(m, "FreeComponent", "A connected component of free space.").listed();
  Record<SearchLimit> limit(m, "SearchLimit", "What a search that did not decide was limited by.");
  Record<SearchLimit::Passage>(limit, "Passage", "The passage nearest to the goal that was not crossed.").listed();
  limit.listed();
  Record<NoPath> reason(m, "NoPath", "Why there is no path.");
  enumeration<NoPath::Kind>(reason, "Kind", "Why there is no path.");
  reason.listed();
}

void bind_plan_options(nb::module_& m) {
  Record<PlanOptions> options(m, "PlanOptions", "Options of plan.");
  options.def(
      "__init__",
      [](PlanOptions* self, Touching touching, double seconds, std::uint64_t slice_bytes, Progress progress,
         std::uint64_t memory) {
        new (self) PlanOptions{touching, seconds, slice_bytes, std::move(progress), memory};
      },
      "touching"_a = Touching::allowed, "time_limit_seconds"_a = 60.0, "slice_bytes"_a = PlanOptions{}.slice_bytes,
      "progress"_a = nb::none(), "memory"_a = 0);
  options.option("touching", &PlanOptions::touching)
      .option("time_limit_seconds", &PlanOptions::time_limit_seconds)
      .option("slice_bytes", &PlanOptions::slice_bytes)
      .option("progress", &PlanOptions::progress)
      .option("memory", &PlanOptions::memory, "bytes that the search may hold; 0: no limit");
}

void bind_plan(nb::module_& m) {
  Record<PlanWork>(m, "PlanWork", "The work that was done.").listed();
  Record<Plan>(m, "Plan", "A path, or the reason why there is none.")
      .field("path", &Plan::path, "from start to goal; empty when there is none")
      .field("reason", &Plan::reason, "exactly when there is none")
      .field("work", &Plan::work)
      .def("found", &Plan::found)
      .def_prop_ro(
          "configurations",
          [](const Plan& self) {
            std::vector<double> all;
            for (const Waypoint& w : self.path) all.insert(all.end(), {w.approx.x, w.approx.y, w.approx.theta});
            return array_of(std::move(all), 3);
          },
          "The waypoints in doubles, shape (n, 3): x, y, theta.");
  m.def(
      "plan",
      [](const CspaceObstacle& obstacle, const ConfigurationArgument& start, const ConfigurationArgument& goal,
         const PlanOptions& options) {
        const ExactConfiguration from = start.value(), to = goal.value();
        return run_with(options, [&](const PlanOptions& own) { return plan(obstacle, from, to, own); });
      },
      "obstacle"_a, "start"_a, "goal"_a, "options"_a = PlanOptions(),
      R"doc(A path from start to goal, or why there is none: a proof. Both are (x, y, theta), x and y exactly and theta in
radians, or an ExactConfiguration. Raises Error: bad_rotation, not_finite, out_of_range, unsupported_operand, cancelled.

>>> from dymsum import CspaceObstacle, plan, shapes
>>> obstacle = CspaceObstacle(shapes.rectangle(-1.5, -0.25, 1.5, 0.25), shapes.grate(4, 2, 1, 6))
>>> plan(obstacle, (-4, 3, 0), (12, 3, 1)).found()
True
>>> plan(obstacle, (1.5, 3, 1.5707963267948966), (12, 3, 0)).reason.kind.name
'separated'
)doc");
}

void bind_direct_plan(nb::module_& m) {
  m.def(
      "direct_plan",
      [](const Region& robot, const Region& obstacle, const ConfigurationArgument& start,
         const ConfigurationArgument& goal, const PlanOptions& options) {
        const ExactConfiguration from = start.value(), to = goal.value();
        return run_with(options, [&](const PlanOptions& own) { return direct_plan(robot, obstacle, from, to, own); });
      },
      "robot"_a, "obstacle"_a, "start"_a, "goal"_a, "options"_a = PlanOptions(),
      R"doc(The plan where slices at the two angles tell it, without the obstacle of all angles: start or goal is not free,
or translations before or after one rotation in place lead from one to the other; None where they do not tell. Raises
Error as plan and CspaceObstacle do.

>>> from dymsum import direct_plan, shapes
>>> direct_plan(shapes.rectangle(-1.5, -0.25, 1.5, 0.25), shapes.grate(4, 2, 1, 6), (-4, 3, 0), (-4, 3, 1)).found()
True
)doc");
}

void bind_check(nb::module_& m) {
  Record<PathCheck>(m, "PathCheck", "Whether a path is free, and the first piece that is not.").listed();
  m.def(
      "check_path",
      [](const RegionArgument& robot, const RegionArgument& obstacle, const std::vector<Waypoint>& path, Touching touch,
         const Progress& progress) {
        return run(progress, [&](const Progress& watched) {
          return check_path(*robot, *obstacle, std::span<const Waypoint>(path), touch, watched);
        });
      },
      "robot"_a, "obstacle"_a, "path"_a, "touch"_a = Touching::allowed, "progress"_a = nb::none(),
      "Each piece by the move of its end, exactly. Raises Error: malformed, cancelled.");
  m.def(
      "check_path",
      [](const RegionArgument& robot, const RegionArgument& obstacle, const std::vector<ExactPose>& poses,
         Touching touch, const MotionOptions& options, const Progress& progress) {
        return run(progress, [&](const Progress& watched) {
          return check_path(*robot, *obstacle, std::span<const ExactPose>(poses), touch, options, watched);
        });
      },
      "robot"_a, "obstacle"_a, "poses"_a, "touch"_a = Touching::allowed, "options"_a = MotionOptions(),
      "progress"_a = nb::none(),
      "The same of positions that doubles may not hold; a piece that moves and turns at once has doubles.");
  m.def(
      "check_path",
      [](const RegionArgument& robot, const RegionArgument& obstacle, const Rows<3>& poses, Touching touch,
         const MotionOptions& options, const Progress& progress) {
        const std::span<const Configuration> all(reinterpret_cast<const Configuration*>(poses.data), poses.size);
        return run(progress, [&](const Progress& watched) {
          return check_path(*robot, *obstacle, all, touch, options, watched);
        });
      },
      "robot"_a, "obstacle"_a, "poses"_a, "touch"_a = Touching::allowed, "options"_a = MotionOptions(),
      "progress"_a = nb::none(), "From each pose (x, y, theta) to the next, shape (n, 3), linear in time; certified.");
}

}  // namespace

void bind_planner(nb::module_& m) {
  bind_waypoint(m);
  bind_exact_placements(m);
  bind_no_path(m);
  bind_plan_options(m);
  bind_plan(m);
  bind_direct_plan(m);
  bind_check(m);
}

}  // namespace dymsum::python
