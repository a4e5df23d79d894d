// Whether motions and paths are free.
#include "dymsum/motion.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/path_check.h"
#include "enumeration.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_motion_results(nb::module_& m) {
  Record<TranslationCheck>(m, "TranslationCheck", "Whether a translation is free, and where it first is not.")
      .field("free", &TranslationCheck::free)
      .field("first", &TranslationCheck::first, "the share of the way up to which it is free")
      .field("at", &TranslationCheck::at)
      .field("contact", &TranslationCheck::contact);
  enumeration<TurnDirection>(m, "TurnDirection", "Which way a rotation goes.");
  Record<TurnInterval>(m, "TurnInterval", "A closed interval of angles, counter-clockwise.")
      .field("begin", &TurnInterval::begin)
      .field("end", &TurnInterval::end)
      .field("at_begin", &TurnInterval::at_begin)
      .field("at_end", &TurnInterval::at_end);
  Record<RotationCheck>(m, "RotationCheck", "Whether a rotation in place is free.")
      .field("free", &RotationCheck::free)
      .field("first", &RotationCheck::first)
      .field("contact", &RotationCheck::contact)
      .field("always", &RotationCheck::always)
      .field("free_angles", &RotationCheck::free_angles);
  Record<MotionCheck> check(m, "MotionCheck", "Whether a motion is free, certified.");
  enumeration<MotionCheck::Outcome>(check, "Outcome", "What is proved of a motion.");
  check.field("outcome", &MotionCheck::outcome)
      .field("low", &MotionCheck::low, "the way is proved free on [0, low)")
      .field("high", &MotionCheck::high)
      .field("contact", &MotionCheck::contact)
      .field("poses", &MotionCheck::poses);
}

void bind_motion_options(nb::module_& m) {
  Record<MotionOptions> options(m, "MotionOptions", "Options of check_motion.");
  options.def(
      "__init__",
      [](MotionOptions* self, double resolution, std::uint64_t most_poses) {
        new (self) MotionOptions{resolution, most_poses};
      },
      "resolution"_a = MotionOptions().resolution, "most_poses"_a = MotionOptions().most_poses);
  options.option("resolution", &MotionOptions::resolution).option("most_poses", &MotionOptions::most_poses);
}

void bind_checks(nb::module_& m) {
  m.def(
      "check_translation",
      [](const RegionArgument& robot, const RegionArgument& obstacle, const RationalPoint& from,
         const RationalPoint& to, const Orientation& theta, Touching touch) {
        return take(without_gil([&] { return check_translation(*robot, *obstacle, from, to, theta, touch); }));
      },
      "robot"_a, "obstacle"_a, "from_"_a, "to"_a, "theta"_a, "touch"_a = Touching::allowed,
      R"doc(The robot at orientation theta, moved straight; positions are taken exactly. Raises Error: not_finite.

>>> from dymsum import Orientation, check_translation, shapes
>>> unit = shapes.rectangle(0, 0, 1, 1)
>>> check_translation(unit, unit, (-3, 0), (0, 0), Orientation()).first
Fraction(2, 3)
)doc");
  m.def(
      "check_rotation",
      [](const RegionArgument& robot, const RegionArgument& obstacle, const RationalPoint& at, const Orientation& from,
         const Orientation& to, TurnDirection turn, Touching touch) {
        return take(without_gil([&] { return check_rotation(*robot, *obstacle, at, from, to, turn, touch); }));
      },
      "robot"_a, "obstacle"_a, "at"_a, "from_"_a, "to"_a, "turn"_a, "touch"_a = Touching::allowed,
      "The robot at `at`, turned in place. Exact.");
  m.def(
      "check_motion",
      [](const RegionArgument& robot, const RegionArgument& obstacle, const Configuration& a, const Configuration& b,
         const MotionOptions& options, const Progress& progress) {
        return run(progress,
                   [&](const Progress& watched) { return check_motion(*robot, *obstacle, a, b, options, watched); });
      },
      "robot"_a, "obstacle"_a, "a"_a, "b"_a, "options"_a = MotionOptions(), "progress"_a = nb::none(),
      "x, y and theta linear in time at once; certified. Raises Error: unsupported_operand, not_finite, cancelled.");
}

}  // namespace

void bind_motion(nb::module_& m) {
  bind_motion_results(m);
  bind_motion_options(m);
  bind_checks(m);
}

}  // namespace dymsum::python
