// Depth that follows a motion without jumps where that is possible.
#include "dymsum/continuous_depth.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "enumeration.h"
#include "held.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

/// A DepthPatch that one thread uses at a time.
struct Patch {
  explicit Patch(DepthPatch patch) : held(std::move(patch)) {}
  Held<DepthPatch> held;
};

/// A ContinuousDepth, its operands and options, and the watch whose Progress it keeps.
struct Continuous {
  Continuous(const MeshArgument& p_of, const MeshArgument& q_of, const ContinuousDepthOptions& o)
      : p(p_of.object), q(q_of.object), options(o), watch(o.progress), held(create(*p_of, *q_of)) {}

  ContinuousDepth create(const Mesh& p_of, const Mesh& q_of) {
    ContinuousDepthOptions own = options;
    own.progress = watch.progress();
    return watch.take(without_gil([&] { return ContinuousDepth::create(p_of, q_of, own); }));
  }
  ContinuousContact query(const Point3& moved, const Rotation& turned) {
    return held.alone([&](ContinuousDepth& depth) {
      watch.begin();
      return watch.take(without_gil([&] { return depth.query(moved, turned); }));
    });
  }
  Rational squared() {
    return held.alone([](ContinuousDepth& depth) { return without_gil([&] { return depth.euclidean_squared(); }); });
  }
  std::vector<SolidWay> ways() {
    return held.alone([](ContinuousDepth& depth) { return without_gil([&] { return depth.euclidean_ways(); }); });
  }
  Patch* patch() {
    return held.alone([](ContinuousDepth& depth) { return new Patch(depth.patch()); });
  }

  nb::object p, q;
  ContinuousDepthOptions options;
  Watch watch;
  Held<ContinuousDepth> held;
};

void bind_continuous_options(nb::module_& m) {
  Record<ContinuousDepthOptions> options(m, "ContinuousDepthOptions", "Options of ContinuousDepth.");
  options.def(
      "__init__",
      [](ContinuousDepthOptions* self, std::optional<double> smoothing_length, double inflation, double margin,
         int halvings, bool tight, int threads, Progress progress) {
        new (self)
            ContinuousDepthOptions{smoothing_length, inflation, margin, halvings, tight, threads, std::move(progress)};
      },
      "smoothing_length"_a = nb::none(), "inflation"_a = 2.0, "margin"_a = 0.0, "halvings"_a = 5, "tight"_a = true,
      "threads"_a = 1, "progress"_a = nb::none());
  options
      .option("smoothing_length", &ContinuousDepthOptions::smoothing_length,
              "normals are averaged over this distance; 0: the exact depth; None: a quarter of the smaller diagonal")
      .option("inflation", &ContinuousDepthOptions::inflation,
              "a branch is left where it is more than this times the shortest way out")
      .option("margin", &ContinuousDepthOptions::margin,
              "how far Q may move before another local sum is made; 0: the smoothing length")
      .option("halvings", &ContinuousDepthOptions::halvings, "a step is cut into at most 2 ** halvings parts")
      .option("tight", &ContinuousDepthOptions::tight, "passages without clearance are ways out")
      .option("threads", &ContinuousDepthOptions::threads, "0: as many as there are cores")
      .option("progress", &ContinuousDepthOptions::progress);
}

void bind_contact(nb::module_& m) {
  enumeration<Discontinuity>(m, "Discontinuity", "Why an answer does not follow from the last one continuously.",
                             {"it does", "there is no last one inside", "the branch ends here, or turns back",
                              "the branch goes on, but is too long a way out", "the sum's boundary changed too much"});
  Record<ContinuousContact> contact(m, "ContinuousContact", "Depth at one pose, rounded.");
  Record<ContinuousContact::Work>(contact, "Work", "What an answer took.")
      .field("local_sums", &ContinuousContact::Work::local_sums)
      .field("steps", &ContinuousContact::Work::steps)
      .field("normals", &ContinuousContact::Work::normals)
      .field("projection_us", &ContinuousContact::Work::projection_us, "microseconds, without local sums");
  contact.field("meeting", &ContinuousContact::meeting)
      .field("depth", &ContinuousContact::depth, "Q moved by this along `normal` does not overlap P")
      .field("euclidean_depth", &ContinuousContact::euclidean_depth, "of the shortest way out")
      .field("normal", &ContinuousContact::normal, "of length 1")
      .field("euclidean_normal", &ContinuousContact::euclidean_normal)
      .field("witness_p", &ContinuousContact::witness_p, "what touches after the move, on P")
      .field("witness_q", &ContinuousContact::witness_q, "the same point of Q, where it is now")
      .field("contact", &ContinuousContact::contact, "features that hold the witnesses")
      .field("branch", &ContinuousContact::branch, "the same as long as nothing jumps; from 1")
      .field("discontinuity", &ContinuousContact::discontinuity)
      .field("smoothed", &ContinuousContact::smoothed, "false: the shortest way out is given instead")
      .field("gradient", &ContinuousContact::gradient, "of `depth`, by the translation of Q")
      .field("torque", &ContinuousContact::torque, "of `depth`, by a turn of Q about its origin, normals kept")
      .field("turn_rate", &ContinuousContact::turn_rate, "an upper bound: radians of `normal` a unit of translation")
      .field("error", &ContinuousContact::error)
      .field("work", &ContinuousContact::work);
}

void bind_patch(nb::module_& m) {
  nb::class_<Patch>(m, "DepthPatch", "A piece of a sum's boundary: answers near its place without another local sum.")
      .def(
          "covers",
          [](Patch& self, const Point3& moved) {
            return self.held.alone([&](DepthPatch& patch) { return patch.covers(moved); });
          },
          "q_moved_by"_a)
      .def(
          "at",
          [](Patch& self, const Point3& moved) {
            return self.held.alone([&](DepthPatch& patch) { return without_gil([&] { return patch.at(moved); }); });
          },
          "q_moved_by"_a, "Follows this patch's last answer. Raises ValueError for what is not finite.");
}

void bind_class_of_continuous_depth(nb::module_& m) {
  nb::class_<Continuous> type(
      m, "ContinuousDepth",
      R"doc(How deep Q lies in P while it moves and turns: a depth, a direction and contact points that do not jump where
that is possible, and tell where they do.

One thread at a time; work is done without the GIL.

>>> from dymsum import ContinuousDepth, ContinuousDepthOptions, solids
>>> box = solids.box(-1, -1, -1, 1, 1, 1)
>>> pair = ContinuousDepth(box, box, ContinuousDepthOptions(smoothing_length=2))
>>> for x in (1.2, 1.3, 1.4):
...     found = pair.query((x, 0, 1.3))
...     print(f"{found.depth:.3f} {found.euclidean_depth:.3f} {found.normal.x:.3f} {found.discontinuity.name}")
0.865 0.700 0.587 entered
0.990 0.700 0.707 none
0.760 0.600 0.790 none
)doc",
      nb::type_slots(WatchedSlots<Continuous>::slots));
  type.def(
          "__init__",
          [](Continuous* self, const MeshArgument& p, const MeshArgument& q, const ContinuousDepthOptions& options) {
            new (self) Continuous(p, q, options);
          },
          "p"_a, "q"_a, "options"_a = ContinuousDepthOptions(),
          "Raises Error: no_area for an empty operand; unsupported_operand for thin parts; not_finite and out_of_range "
          "for options; cancelled.")
      .def_static(
          "create",
          [](const MeshArgument& p, const MeshArgument& q, const ContinuousDepthOptions& options) {
            return new Continuous(p, q, options);
          },
          nb::rv_policy::take_ownership, "p"_a, "q"_a, "options"_a = ContinuousDepthOptions())
      .def("query", &Continuous::query, "q_moved_by"_a, "q_turned"_a = Rotation(),
           "Q turned about its origin, then moved. Raises Error: not_finite; unsupported_operand; cancelled.")
      .def("euclidean_squared", &Continuous::squared,
           "The square of the shortest way out at the last pose, exactly; 0 where they do not overlap.")
      .def("euclidean_ways", &Continuous::ways,
           "All shortest moves of Q at the last pose, exactly, with all pairs of features that touch then; none where "
           "they do not overlap.")
      .def("patch", &Continuous::patch, nb::rv_policy::take_ownership,
           "What is known of the boundary at the last pose.")
      .def(
          "forget", [](Continuous& self) { self.held.alone([](ContinuousDepth& depth) { depth.forget(); }); },
          "The next answer is a first one.")
      .def("smoothing_length",
           [](Continuous& self) {
             return self.held.alone([](ContinuousDepth& depth) { return depth.smoothing_length(); });
           })
      .def_prop_ro("options", [](const Continuous& self) { return self.options; })
      .def("__reduce__", [](nb::handle_t<Continuous> self) {
        const auto* own = nb::inst_ptr<Continuous>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(own->p, own->q, without_progress(own->options)));
      });
}

}  // namespace

void bind_continuous_depth(nb::module_& m) {
  bind_continuous_options(m);
  bind_contact(m);
  bind_patch(m);
  bind_class_of_continuous_depth(m);
}

}  // namespace dymsum::python
