// Fast questions to an obstacle, one at a time and in batches.
#include "dymsum/obstacle_queries.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "parallel.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_query_answers(nb::module_& m) {
  Record<Clearance>(m, "Clearance", "The distance of a configuration to the boundary of the obstacle.").listed();
  Record<FreeAngles>(m, "FreeAngles", "Angles at which the robot can stand at a position, counter-clockwise.")
      .listed()
      .def("single", &FreeAngles::single);
}

/// Throws where a theta is not finite: what the library requires.
std::span<const Configuration> configurations(const Rows<3>& rows) {
  static_assert(sizeof(Configuration) == 3 * sizeof(double));
  return {reinterpret_cast<const Configuration*>(rows.data), rows.size};
}

Array<bool> contains_each(const ObstacleQueries& self, const Rows<3>& at, int threads) {
  std::vector<std::uint8_t> inside = without_gil([&] { return self.contains(configurations(at), threads); });
  return truths_of(std::move(inside));
}

nb::object clearance_each(const ObstacleQueries& self, const Rows<3>& from, std::optional<double> weight,
                          Touching touching, int threads, const Progress& progress) {
  const auto all = configurations(from);
  const double length = weight ? *weight : self.gyration_radius();
  std::vector<double> distance(all.size()), error(all.size()), nearest(3 * all.size());
  std::vector<std::uint32_t> patch(all.size());
  Watch watch(progress);
  const bool done = without_gil([&] {
    return for_each_item(all.size(), 16, threads, watch.progress(), [&](std::size_t i) {
      const Clearance one = self.clearance(all[i], length, touching);
      distance[i] = one.distance;
      error[i] = one.error;
      patch[i] = one.patch;
      nearest[3 * i] = one.nearest.x, nearest[3 * i + 1] = one.nearest.y, nearest[3 * i + 2] = one.nearest.theta;
    });
  });
  watch.raise();
  if (!done) throw ErrorRaised({ErrorCode::cancelled, "stopped on request", {}});
  return nb::module_::import_("dymsum._values")
      .attr("Clearances")(array_of(std::move(distance)).object, array_of(std::move(error)).object,
                          array_of(std::move(patch)).object, array_of(std::move(nearest), 3).object);
}

void bind_single(nb::class_<ObstacleQueries>& type) {
  type.def(
          "contains", [](const ObstacleQueries& self, const Configuration& at) { return self.contains(at); }, "at"_a,
          "Whether the robot at (x, y, theta) overlaps the obstacle; touching is free. Exact. Raises ValueError for a "
          "theta "
          "that is not finite.")
      .def(
          "contains",
          [](const ObstacleQueries& self, double x, double y, const Orientation& theta) {
            return self.contains(x, y, theta);
          },
          "x"_a, "y"_a, "theta"_a)
      .def(
          "free_angles",
          [](const ObstacleQueries& self, double x, double y) {
            return without_gil([&] { return self.free_angles(x, y); });
          },
          "x"_a, "y"_a, R"doc(All angles at which the robot can stand at (x, y), touching allowed. Raises ValueError.

>>> from dymsum import CspaceObstacle, ObstacleQueries, shapes
>>> rod, wall = shapes.rectangle(-1, -0.25, 1, 0.25), shapes.rectangle(0, 0, 4, 4)
>>> queries = ObstacleQueries(CspaceObstacle(rod, wall))
>>> len(queries.free_angles(4.5, 2)), len(queries.free_angles(2, 2))
(2, 0)
)doc")
      .def(
          "clearance",
          [](const ObstacleQueries& self, const Configuration& from, std::optional<double> weight, Touching touching) {
            return self.clearance(from, weight ? *weight : self.gyration_radius(), touching);
          },
          "from_"_a, "weight"_a = nb::none(), "touching"_a = Touching::allowed,
          "The signed distance to the boundary in the metric dx^2 + dy^2 + weight^2 dtheta^2; weight, a length per "
          "radian, is "
          "gyration_radius() by default. Raises ValueError for what is not finite, and a weight that is negative or "
          "too large.")
      .def("exact_answers", &ObstacleQueries::exact_answers)
      .def("largest_weight", &ObstacleQueries::largest_weight)
      .def("gyration_radius", &ObstacleQueries::gyration_radius)
      .def("bounds_evaluated", &ObstacleQueries::bounds_evaluated)
      .def("bytes", &ObstacleQueries::bytes);
}

void bind_batches(nb::class_<ObstacleQueries>& type) {
  type.def("contains_each", &contains_each, "poses"_a, "threads"_a = 0,
           "contains for configurations (x, y, theta), shape (n, 3), in parallel without the GIL (threads 0: all "
           "cores): n truth "
           "values.")
      .def(
          "free_each",
          [](const ObstacleQueries& self, const Rows<3>& at, int threads) {
            return Array<bool>{~contains_each(self, at, threads).object};
          },
          "poses"_a, "threads"_a = 0, "The opposite: where the robot may stand.")
      .def("clearance_each", &clearance_each, "poses"_a, "weight"_a = nb::none(), "touching"_a = Touching::allowed,
           "threads"_a = 0, "progress"_a = nb::none(),
           nb::sig("def clearance_each(self, poses: numpy.typing.ArrayLike, weight: float | None = None, touching: "
                   "Touching = ..., "
                   "threads: int = 0, progress: collections.abc.Callable[[str, float], bool | None] | None = None) -> "
                   "dymsum.Clearances"),
           "clearance for configurations, shape (n, 3), in parallel: arrays distance (n), error (n), patch (n), "
           "nearest (n, 3).");
}

}  // namespace

void bind_queries(nb::module_& m) {
  bind_query_answers(m);
  nb::class_<ObstacleQueries> type(
      m, "ObstacleQueries", nb::dynamic_attr(),
      R"doc(An index over the patches of an obstacle. Answers may be asked for on several threads.

>>> from dymsum import CspaceObstacle, ObstacleQueries, shapes
>>> queries = ObstacleQueries(CspaceObstacle(shapes.rectangle(-1, -0.25, 1, 0.25), shapes.rectangle(0, 0, 4, 4)))
>>> queries.contains((2, 2, 0)), queries.clearance((6, 2, 0), weight=float("inf")).distance
(True, 1.0)
>>> queries.free_each([(2, 2, 0), (6, 2, 0)])
array([False,  True])
)doc");
  type.def(
          "__init__",
          [](nb::pointer_and_handle<ObstacleQueries> self, nb::handle_t<CspaceObstacle> obstacle) {
            const CspaceObstacle& of = *nb::inst_ptr<CspaceObstacle>(obstacle);
            without_gil([&] { new (self.p) ObstacleQueries(of); });
            nb::inst_mark_ready(self.h);
            self.h.attr("_obstacle") = obstacle;
          },
          "obstacle"_a, nb::keep_alive<1, 2>())
      .def("__reduce__", [](nb::handle_t<ObstacleQueries> self) {
        return nb::make_tuple(self.type(), nb::make_tuple(self.attr("_obstacle")));
      });
  bind_single(type);
  bind_batches(type);
}

}  // namespace dymsum::python
