// Penetration depth of solids of any shape and of planar regions; many questions at once.
#include "dymsum/penetration_depth.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "enumeration.h"
#include "held.h"
#include "record.h"
#include "spatial_operand.h"

#include <span>
#include <stdexcept>

namespace dymsum::python {
namespace {

using namespace nb::literals;

/// The position, exactly; ValueError where it is not finite.
template <std::size_t K>
const auto& finite(const Position<K>& position) {
  if (!position.exact) throw std::invalid_argument("the position is not finite");
  return *position.exact;
}

/// A SolidDepth and what it is made of again.
struct Depth {
  Depth(const SpatialOperandArgument& p_of, const SpatialOperandArgument& q_of, const DepthOptions& o)
      : p(p_of.object), q(q_of.object), options(o), held(create(*p_of, *q_of, o)) {
    options.progress = {};
  }

  static SolidDepth create(const SpatialOperand& p, const SpatialOperand& q, const DepthOptions& o) {
    return run_with(o, [&](const DepthOptions& own) { return SolidDepth::create(p, q, own); });
  }
  SolidDistance at(const Position<3>& moved, double time_limit) {
    const auto& at = finite(moved);
    return held.alone([&](SolidDepth& depth) { return without_gil([&] { return depth.at(at, time_limit); }); });
  }
  Rational along(const Position<3>& moved, const Position<3>& direction) {
    const auto &at = finite(moved), &along = finite(direction);
    return held.alone([&](SolidDepth& depth) { return without_gil([&] { return depth.along(at, along); }); });
  }
  SolidDepth copy() {
    return held.alone([](SolidDepth& depth) { return SolidDepth(depth); });
  }

  nb::object p, q;
  DepthOptions options;
  Held<SolidDepth> held;
};

/// A DepthQuestion that keeps its solids alive.
struct Question {
  nb::object p, q;
  Point3 moved;
};

void bind_solid_distance(nb::module_& m) {
  enumeration<Meeting>(m, "Meeting", "How two sets lie.",
                       {"their interiors meet", "they touch and no more", "they have no point in common"});
  Record<SolidTouch>(m, "SolidTouch", "A feature of P and one of Q that touch: their relative interiors meet.")
      .listed();
  Record<SolidWay>(m, "SolidWay", "A shortest move of Q: it separates overlapping solids, or brings others in touch.")
      .listed();
  Record<SolidDistance> distance(m, "SolidDistance", "The depth of what overlaps, else the gap.");
  Record<SolidDistance::Work>(distance, "Work", "What an answer took.").listed();
  distance.listed();
}

void bind_depth_options(nb::module_& m) {
  enumeration<DepthEngine>(m, "DepthEngine", "How depth is found; the answers are equal.",
                           {"best first over the facets of the convolution; no sum is built",
                            "all faces and tight features of the exact sum: the reference"});
  Record<DepthOptions> options(m, "DepthOptions", "Options of SolidDepth.");
  options.def(
      "__init__",
      [](DepthOptions* self, DepthEngine engine, int threads, Progress progress, bool contacts) {
        new (self) DepthOptions{engine, threads, std::move(progress), contacts};
      },
      "engine"_a = DepthEngine::search, "threads"_a = 0, "progress"_a = nb::none(), "contacts"_a = true);
  options.option("engine", &DepthOptions::engine)
      .option("threads", &DepthOptions::threads, "of the preparation, 0: as many as there are cores")
      .option("progress", &DepthOptions::progress)
      .option("contacts", &DepthOptions::contacts, "false: contacts stay empty, which saves time");
  Record<DepthBatchOptions> batch(m, "DepthBatchOptions", "Options of depth_batch.");
  batch.def(
      "__init__",
      [](DepthBatchOptions* self, int threads, double time_limit, Progress progress) {
        new (self) DepthBatchOptions{threads, time_limit, std::move(progress)};
      },
      "threads"_a = 0, "time_limit"_a = 0.0, "progress"_a = nb::none());
  batch.option("threads", &DepthBatchOptions::threads, "0: as many as there are cores; the rows do not depend on it")
      .option("time_limit", &DepthBatchOptions::time_limit, "seconds for each row, 0: none")
      .option("progress", &DepthBatchOptions::progress);
}

void bind_solid_depth(nb::module_& m) {
  nb::class_<Depth> type(m, "SolidDepth",
                         R"doc(How deep solids of any shape lie in each other: exactly, and as a global minimum.

P and Q have fixed orientations, Q is moved by translations. Prepared once, asked often; after small moves most of the
last answer is used again. One thread at a time; work is done without the GIL.

>>> from dymsum import SolidDepth, solids
>>> box = solids.box(-1, -1, -1, 1, 1, 1)
>>> depth = SolidDepth(box, box)
>>> found = depth.at((1.5, 0, 0))
>>> found.meeting, found.squared, found.ways[0].direction
(Meeting.overlapping, Fraction(1, 4), Point3(x=1.0, y=0.0, z=0.0))
>>> depth.along((1.5, 0, 0), (0, 0, 1))
Fraction(2, 1)
)doc");
  type.def(
          "__init__",
          [](Depth* self, const SpatialOperandArgument& p, const SpatialOperandArgument& q,
             const DepthOptions& options) { new (self) Depth(p, q, options); },
          "p"_a, "q"_a, "options"_a = DepthOptions(),
          "Raises Error: no_area for an empty operand; unsupported_operand for thin parts of both and coordinates that "
          "need "
          "more "
          "than 250 bits on their common grid; out_of_range; cancelled.")
      .def_static(
          "create",
          [](const SpatialOperandArgument& p, const SpatialOperandArgument& q, const DepthOptions& options) {
            return new Depth(p, q, options);
          },
          nb::rv_policy::take_ownership, "p"_a, "q"_a, "options"_a = DepthOptions())
      .def("at", &Depth::at, "q_moved_by"_a = nb::make_tuple(0.0, 0.0, 0.0), "time_limit"_a = 0.0,
           "Depth or gap with all shortest moves, exactly. A limit in seconds, 0: none. Raises ValueError for what is "
           "not finite and a limit below 0.")
      .def(
          "along", &Depth::along, "q_moved_by"_a, "direction"_a,
          "The smallest s >= 0 so that Q, moved also by s times `direction`, does not overlap P. Raises ValueError for "
          "what is not finite and a direction of zero.")
      .def(
          "facet_count",
          [](Depth& self) { return self.held.alone([](SolidDepth& depth) { return depth.facet_count(); }); },
          "Of the convolution, without those deep inside the sum.")
      .def_prop_ro(
          "options", [](const Depth& self) { return self.options; }, "Without the progress.")
      .def("__copy__",
           [](nb::handle_t<Depth> self) {
             auto* own = nb::inst_ptr<Depth>(self);
             return self.type()(own->p, own->q, own->options);
           })
      .def("__reduce__", [](nb::handle_t<Depth> self) {
        auto* own = nb::inst_ptr<Depth>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(own->p, own->q, own->options));
      });
}

std::vector<Point3> moves_of(const Rows<3>& rows) {
  std::vector<Point3> moves;
  for (std::size_t k = 0; k < rows.size; ++k) moves.push_back({rows.row(k)[0], rows.row(k)[1], rows.row(k)[2]});
  return moves;
}

Error infinite_move(std::size_t k) {
  Error error{ErrorCode::not_finite, "a translation is not finite", {}};
  error.evidence.vertex = static_cast<std::int64_t>(k);
  return error;
}

std::vector<SolidDistance> rows_of(Depth& pair, const Positions<3>& moves, const DepthBatchOptions& options) {
  const SolidDepth own = pair.copy();
  if (moves.exact.empty()) {
    const std::vector<Point3> all = moves_of(moves.doubles);
    return run_with(options, [&](const DepthBatchOptions& watched) { return depth_batch(own, all, watched); });
  }
  if (!moves.not_finite.empty()) take(Result<void>(infinite_move(moves.not_finite.front())));
  return run_with(options, [&](const DepthBatchOptions& watched) {
    return depth_batch(own, std::span<const RationalPoint3>(moves.exact), watched);
  });
}

nb::list answers(const std::vector<Question>& questions, const DepthBatchOptions& options, bool return_errors) {
  std::vector<DepthQuestion> all;
  for (const Question& q : questions) all.push_back({nb::inst_ptr<Mesh>(q.p), nb::inst_ptr<Mesh>(q.q), q.moved});
  auto rows = run_with(options, [&](const DepthBatchOptions& watched) { return depth_batch(all, watched); });
  nb::list list;
  for (Result<SolidDistance>& row : rows)
    list.append(!row && return_errors ? error_object(row.error()) : nb::cast(take(std::move(row))));
  return list;
}

/// The first rows' answers as arrays.
nb::object row_arrays(Depth& pair, const Positions<3>& moves, const DepthBatchOptions& options) {
  const std::vector<SolidDistance> rows = rows_of(pair, moves, options);
  std::vector<std::uint8_t> meeting, complete;
  std::vector<double> distance, at_least, direction;
  std::vector<std::uint32_t> ways;
  for (const SolidDistance& row : rows) {
    meeting.push_back(static_cast<std::uint8_t>(row.meeting)), complete.push_back(row.complete);
    distance.push_back(row.distance), at_least.push_back(row.at_least);
    const Point3 way = row.ways.empty() ? Point3{} : row.ways.front().direction;
    direction.insert(direction.end(), {way.x, way.y, way.z});
    ways.push_back(static_cast<std::uint32_t>(row.ways.size()));
  }
  return nb::module_::import_("dymsum._values")
      .attr("DepthRows")(array_of(std::move(meeting)).object, array_of(std::move(distance)).object,
                         array_of(std::move(direction), 3).object, array_of(std::move(ways)).object,
                         truths_of(std::move(complete)).object, array_of(std::move(at_least)).object);
}

void bind_question(nb::module_& m) {
  nb::class_<Question>(m, "DepthQuestion", "Two solids and how Q is moved.")
      .def(
          "__init__",
          [](Question* self, const MeshArgument& p, const MeshArgument& q, const Point3& moved) {
            new (self) Question{p.object, q.object, moved};
          },
          "p"_a, "q"_a, "q_moved_by"_a = nb::make_tuple(0.0, 0.0, 0.0))
      .def_prop_ro(
          "p", [](const Question& self) { return self.p; }, nb::sig("def p(self) -> Mesh"))
      .def_prop_ro(
          "q", [](const Question& self) { return self.q; }, nb::sig("def q(self) -> Mesh"))
      .def_prop_ro("q_moved_by", [](const Question& self) { return self.moved; })
      .def("__reduce__", [](nb::handle_t<Question> self) {
        const auto* own = nb::inst_ptr<Question>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(own->p, own->q, own->moved));
      });
}

void bind_depth_batch(nb::module_& m) {
  m.def("depth_batch", &rows_of, "pair"_a, "moves"_a, "options"_a = DepthBatchOptions(),
        nb::sig("def depth_batch(pair: SolidDepth, moves: numpy.typing.ArrayLike, options: DepthBatchOptions = ...) -> "
                "list[SolidDistance]"),
        R"doc(One answer for every translation of Q, shape (n, 3), in their order, in parallel and without the GIL.

Raises Error: not_finite with the index of the translation as `vertex`; out_of_range; cancelled.

>>> from dymsum import SolidDepth, depth_batch, solids
>>> box = solids.box(-1, -1, -1, 1, 1, 1)
>>> [row.distance for row in depth_batch(SolidDepth(box, box), [(1.5, 0, 0), (0, 0, 0), (0, 5, 0)])]
[0.5, 2.0, 3.0]
)doc");
  m.def(
      "depth_batch",
      [](const std::vector<Question>& questions, const DepthBatchOptions& options) {
        return answers(questions, options, false);
      },
      "questions"_a, "options"_a = DepthBatchOptions(),
      nb::sig("def depth_batch(questions: collections.abc.Sequence[DepthQuestion], options: DepthBatchOptions = ...) "
              "-> list[SolidDistance]"),
      "One answer for every pair, in their order. Raises Error: as SolidDepth; not_finite; out_of_range; cancelled.");
  m.def("depth_batch", &answers, "questions"_a, "options"_a = DepthBatchOptions(), nb::kw_only(), "return_errors"_a,
        nb::sig("def depth_batch(questions: collections.abc.Sequence[DepthQuestion], options: DepthBatchOptions = ..., "
                "*, return_errors: bool) -> list[SolidDistance | dymsum.Error]"),
        "The same; with return_errors what fails is an Error in the list instead of raised.");
  m.def("depth_batch_arrays", &row_arrays, "pair"_a, "moves"_a, "options"_a = DepthBatchOptions(),
        nb::sig("def depth_batch_arrays(pair: SolidDepth, moves: numpy.typing.ArrayLike, options: DepthBatchOptions = "
                "...) -> dymsum.DepthRows"),
        R"doc(The same for translations as arrays: meeting (n; values of Meeting), distance (n), direction (n, 3) of the
first shortest move, ways (n), complete (n), at_least (n).

>>> import numpy
>>> from dymsum import SolidDepth, depth_batch_arrays, solids
>>> box = solids.box(-1, -1, -1, 1, 1, 1)
>>> rows = depth_batch_arrays(SolidDepth(box, box), numpy.array([[1.5, 0, 0], [0, 0, 0], [0, 5, 0]]))
>>> rows.distance, rows.ways
(array([0.5, 2. , 3. ]), array([1, 6, 1], dtype=uint32))
)doc");
}

/// A PlanarDepth and what it is made of again.
struct DepthOfRegions {
  nb::object p, q;
  PlanarDepth depth;
};

DepthOfRegions of_regions(const RegionArgument& p, const RegionArgument& q) {
  return {p.object, q.object, take(without_gil([&] { return PlanarDepth::create(*p, *q); }))};
}

void bind_planar_depth(nb::module_& m) {
  Record<PlanarFeature> feature(m, "PlanarFeature", "A vertex of a region, or the edge that starts there.");
  enumeration<PlanarFeature::Kind>(feature, "Kind", "What a feature is.");
  feature.listed();
  Record<PlanarTouch>(m, "PlanarTouch", "A feature of P and one of Q that touch: their relative interiors meet.")
      .listed();
  Record<PlanarWay>(m, "PlanarWay", "A shortest move of planar Q.").listed();
  Record<PlanarDistance>(m, "PlanarDistance", "The depth of regions that overlap, else the gap.").listed();
  nb::class_<DepthOfRegions>(
      m, "PlanarDepth",
      R"doc(How deep planar regions lie in each other: the sum is built once. May be shared by threads.

>>> from dymsum import PlanarDepth, shapes
>>> slot = shapes.letter_u(4, 4, 1)
>>> PlanarDepth(slot, shapes.rectangle(0, 0, 2, 1)).at((1.25, 2)).squared
Fraction(1, 16)
)doc")
      .def(
          "__init__",
          [](DepthOfRegions* self, const RegionArgument& p, const RegionArgument& q) {
            new (self) DepthOfRegions(of_regions(p, q));
          },
          "p"_a, "q"_a, "Raises Error: no_area where an operand is empty; unsupported_operand; those of nfp.")
      .def_static("create", &of_regions, "p"_a, "q"_a)
      .def(
          "at",
          [](const DepthOfRegions& self, const Position<2>& moved) {
            const RationalPoint& at = finite(moved);
            return without_gil([&] { return self.depth.at(at); });
          },
          "q_moved_by"_a = nb::make_tuple(0.0, 0.0),
          "Depth or gap with all shortest moves, exactly. Raises ValueError for what is not finite.")
      .def("__reduce__", [](nb::handle_t<DepthOfRegions> self) {
        const auto* own = nb::inst_ptr<DepthOfRegions>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(own->p, own->q));
      });
}

}  // namespace

void bind_depth(nb::module_& m) {
  bind_solid_distance(m);
  bind_depth_options(m);
  bind_solid_depth(m);
  bind_question(m);
  bind_depth_batch(m);
  bind_planar_depth(m);
}

}  // namespace dymsum::python
