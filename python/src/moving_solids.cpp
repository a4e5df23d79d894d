// Sums of solids of any shape that follow the poses of both operands.
#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/moving_solid_sum.h"
#include "held.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

/// A MovingSolidSum, its operands and options, and the watch whose Progress it keeps.
struct MovingSolid {
  MovingSolid(const MeshArgument& p_of, const MeshArgument& q_of, const MovingSolidOptions& o)
      : p(p_of.object), q(q_of.object), options(own_options(o)), watch(options.progress), held(create(*p_of, *q_of)) {}

  static MovingSolidOptions own_options(MovingSolidOptions options) {
    options.progress = own_progress(options.progress);
    return options;
  }
  MovingSolidSum create(const Mesh& p_of, const Mesh& q_of) {
    MovingSolidOptions own = options;
    own.progress = watch.progress();
    return watch.take(without_gil([&] { return MovingSolidSum::create(p_of, q_of, own); }));
  }
  SolidFrameWork set(const SolidPose& p_pose, const SolidPose& q_pose) {
    return held.alone([&](MovingSolidSum& sum) {
      watch.begin();
      return watch.take(without_gil([&] { return sum.set(p_pose, q_pose); }));
    });
  }

  nb::object p, q;
  MovingSolidOptions options;
  Watch watch;
  Held<MovingSolidSum> held;
};

void bind_options(nb::module_& m) {
  Record<MovingSolidOptions> options(m, "MovingSolidOptions", "Options of sums of solids in motion.");
  options.def(
      "__init__",
      [](MovingSolidOptions* self, Semantics semantics, bool tight, FrameMode mode, int threads, Progress progress) {
        new (self) MovingSolidOptions{semantics, tight, mode, threads, std::move(progress)};
      },
      "semantics"_a = Semantics::closed, "tight"_a = true, "mode"_a = FrameMode::automatic, "threads"_a = 1,
      "progress"_a = nb::none());
  options.option("semantics", &MovingSolidOptions::semantics)
      .option("tight", &MovingSolidOptions::tight, "look for tight features; False lists none")
      .option("mode", &MovingSolidOptions::mode, "automatic, window or rebuild: all give the same sum")
      .option("threads", &MovingSolidOptions::threads, "0: as many as there are cores")
      .option("progress", &MovingSolidOptions::progress, "called with the stage and its share in [0, 1]; False stops");
}

void bind_results(nb::module_& m) {
  Record<SolidFrameWork>(m, "SolidFrameWork", "The work of one frame.").listed();
  Record<SolidFrameChanges>(m, "SolidFrameChanges", "What happened to the faces since the frame before.").listed();
}

void bind_class(nb::module_& m) {
  nb::class_<MovingSolid> type(m, "MovingSolidSum",
                               R"doc(P (+) Q of solids of any shape: it follows the poses of both, exactly.

>>> from dymsum import MovingSolidSum, Rotation, SolidPose, shapes, solids
>>> ell = solids.prism(shapes.letter_l(3, 2, 1).parts[0].outer, 1)
>>> sum = MovingSolidSum(ell, solids.box(0, 0, 0, 1, 1, 1))
>>> work = sum.set(SolidPose(Rotation.of(1, 0, 0, 1)))
>>> sum.sum().shells, len(sum.changes().appeared) > 0
(1, True)
)doc",
                               nb::type_slots(WatchedSlots<MovingSolid>::slots));
  type.def(
          "__init__",
          [](MovingSolid* self, const MeshArgument& p, const MeshArgument& q, const MovingSolidOptions& options) {
            new (self) MovingSolid(p, q, options);
          },
          "p"_a, "q"_a, "options"_a = MovingSolidOptions())
      .def_static(
          "create",
          [](const MeshArgument& p, const MeshArgument& q, const MovingSolidOptions& options) {
            return new MovingSolid(p, q, options);
          },
          nb::rv_policy::take_ownership, "p"_a, "q"_a, "options"_a = MovingSolidOptions(),
          "At the identity. Raises Error: unsupported_operand; out_of_range for threads below 0; cancelled.")
      .def("set", &MovingSolid::set, "p"_a, "q"_a = SolidPose(),
           "Moves both. Raises Error: unsupported_operand, cancelled; nothing changes then.")
      .def("p_pose",
           [](MovingSolid& self) { return self.held.alone([](MovingSolidSum& sum) { return sum.p_pose(); }); })
      .def("q_pose",
           [](MovingSolid& self) { return self.held.alone([](MovingSolidSum& sum) { return sum.q_pose(); }); })
      .def(
          "sum",
          [](MovingSolid& self) {
            return self.held.alone([&](MovingSolidSum& sum) {
              return remembered(SpatialSum(sum.sum()), "posed_sum", self.p, self.q, sum.p_pose(), sum.q_pose(),
                                self.options);
            });
          },
          "A copy of the exact sum at the current poses.")
      .def("work", [](MovingSolid& self) { return self.held.alone([](MovingSolidSum& sum) { return sum.work(); }); })
      .def(
          "changes",
          [](MovingSolid& self) {
            return self.held.alone([](MovingSolidSum& sum) { return without_gil([&] { return sum.changes(); }); });
          },
          "From the frame before to this one.")
      .def_prop_ro("options", [](const MovingSolid& self) { return MovingSolid::own_options(self.options); })
      .def("__reduce__", [](nb::handle_t<MovingSolid> self) {
        const auto* object = nb::inst_ptr<MovingSolid>(self);
        return nb::make_tuple(
            nb::module_::import_("dymsum._remake").attr("moving_solid"),
            nb::make_tuple(object->p, object->q, object->options, self.attr("p_pose")(), self.attr("q_pose")()));
      });
  m.def(
      "posed_sum",
      [](const MeshArgument& p, const MeshArgument& q, const SolidPose& p_pose, const SolidPose& q_pose,
         const MovingSolidOptions& options) {
        return remembered(
            run_with(options, [&](const MovingSolidOptions& own) { return posed_sum(*p, *q, p_pose, q_pose, own); }),
            "posed_sum", p.object, q.object, p_pose, q_pose, options);
      },
      "p"_a, "q"_a, "p_pose"_a, "q_pose"_a = SolidPose(), "options"_a = MovingSolidOptions(),
      R"doc(P (+) Q at a pair of poses, computed from scratch. Raises Error: as MovingSolidSum.

>>> from dymsum import Rotation, SolidPose, posed_sum, solids
>>> box = solids.box(0, 0, 0, 1, 2, 3)
>>> posed_sum(box, box, SolidPose(Rotation.of(1, 0, 0, 1))).volume()  # a quarter turn about z
54.0
)doc");
}

/// The sums as a list, each as posed_sum would have made it.
nb::list sums_at(const MeshArgument& p, const MeshArgument& q, const std::vector<SolidPose>& p_poses,
                 const std::vector<SolidPose>& q_poses, const MovingSolidOptions& options) {
  std::vector<SpatialSum> sums(p_poses.size());
  run_with(options, [&](const MovingSolidOptions& own) {
    return posed_sums(
        *p, *q, p_poses, q_poses, [&](std::size_t k, const SpatialSum& sum) { sums[k] = sum; }, own);
  });
  nb::list list;
  for (std::size_t k = 0; k < sums.size(); ++k)
    list.append(remembered(std::move(sums[k]), "posed_sum", p.object, q.object, p_poses[k],
                           q_poses.empty() ? SolidPose() : q_poses[k], options));
  return list;
}

void bind_batch(nb::module_& m) {
  m.def(
      "posed_sums", &sums_at, "p"_a, "q"_a, "p_poses"_a, "q_poses"_a = std::vector<SolidPose>(),
      "options"_a = MovingSolidOptions(),
      nb::sig("def posed_sums(p: dymsum.MeshLike, q: dymsum.MeshLike, p_poses: "
              "collections.abc.Sequence[SolidPose], q_poses: collections.abc.Sequence[SolidPose] = ..., "
              "options: MovingSolidOptions = ...) -> list[SpatialSum]"),
      R"doc(P (+) Q at many poses, which need not be near each other, on options.threads threads: the sums in the order of the
poses. q_poses are as many as P's, or none for the identity. Raises Error: as MovingSolidSum; out_of_range for another
number of Q's poses; cancelled.

>>> from dymsum import Rotation, SolidPose, posed_sums, solids
>>> box = solids.box(0, 0, 0, 1, 2, 3)
>>> turns = [SolidPose(), SolidPose(Rotation.of(1, 0, 0, 1))]
>>> [sum.volume() for sum in posed_sums(box, box, turns)]
[48.0, 54.0]
)doc");
}

}  // namespace

void bind_moving_solids(nb::module_& m) {
  bind_options(m);
  bind_results(m);
  bind_class(m);
  bind_batch(m);
}

}  // namespace dymsum::python
