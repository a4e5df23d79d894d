// Sums of convex solids in motion, depths, and batches of poses.
#include "dymsum/convex_sum.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/convex_memory.h"
#include "dymsum/convex_solid.h"
#include "enumeration.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

/// A ConvexSum and the operands that it is made of again.
struct Convex {
  nb::object p, q;
  ConvexSum sum;
};

Convex of_meshes(const MeshArgument& p, const MeshArgument& q) {
  return {p.object, q.object, take(without_gil([&] { return ConvexSum::create(*p, *q); }))};
}

Convex of_sum(nb::handle_t<SpatialSum> p, const MeshArgument& q) {
  const SpatialSum& first = *nb::inst_ptr<SpatialSum>(p);
  return {nb::borrow(p), q.object, take(without_gil([&] { return ConvexSum::create(first, *q); }))};
}

void bind_convex_results(nb::module_& m) {
  enumeration<ConvexEngine>(m, "ConvexEngine", "How a sum of convex solids is found.");
  Record<MotionWork>(m, "MotionWork", "The work of one move.").listed();
  Record<ConvexDepth>(m, "ConvexDepth", "How deep a point lies in a sum.").listed();
}

void bind_making(nb::class_<Convex>& type) {
  type.def(
          "__init__",
          [](Convex* self, const MeshArgument& p, const MeshArgument& q) { new (self) Convex(of_meshes(p, q)); }, "p"_a,
          "q"_a, "At the identity. Raises Error: not_convex, no_area, unsupported_operand.")
      .def(
          "__init__",
          [](Convex* self, nb::handle_t<SpatialSum> p, const MeshArgument& q) { new (self) Convex(of_sum(p, q)); },
          "p"_a, "q"_a, "Of a convex sum and one more solid.")
      .def_static("create", &of_meshes, "p"_a, "q"_a)
      .def_static("create", &of_sum, "p"_a, "q"_a)
      .def("__copy__", [](const Convex& self) { return Convex(self); })
      .def("__reduce__", [](nb::handle_t<Convex> self) {
        const auto* object = nb::inst_ptr<Convex>(self);
        return nb::make_tuple(nb::module_::import_("dymsum._remake").attr("convex"),
                              nb::make_tuple(object->p, object->q, object->sum.p_pose(), object->sum.q_pose()));
      });
}

void bind_moving(nb::class_<Convex>& type) {
  type.def(
          "set", [](Convex& self, const Rotation& p) { return self.sum.set(p); }, "p"_a)
      .def(
          "set", [](Convex& self, const SolidPose& p, const SolidPose& q) { return self.sum.set(p, q); }, "p"_a,
          "q"_a = SolidPose(), "Moves P and Q to these poses.")
      .def(
          "rebuild", [](Convex& self, ConvexEngine engine) { return self.sum.rebuild(engine); },
          "engine"_a = ConvexEngine::walk)
      .def(
          "rebuild",
          [](Convex& self, const SolidPose& p, const SolidPose& q, ConvexEngine engine) {
            return self.sum.rebuild(p, q, engine);
          },
          "p"_a, "q"_a, "engine"_a = ConvexEngine::walk)
      .def("p_pose", [](const Convex& self) { return self.sum.p_pose(); })
      .def("q_pose", [](const Convex& self) { return self.sum.q_pose(); })
      .def("work", [](const Convex& self) { return self.sum.work(); })
      .def(
          "solid", [](Convex& self) { return ConvexSolid(self.sum.solid()); },
          "A copy of the finished solid, in an order that stays from move to move.");
}

void bind_telling(nb::class_<Convex>& type) {
  type.def("tier_bits", [](const Convex& self) { return self.sum.tier_bits(); })
      .def("face_vertex_count", [](const Convex& self) { return self.sum.face_vertex_count(); })
      .def("edge_edge_count", [](const Convex& self) { return self.sum.edge_edge_count(); })
      .def("facet_count", [](const Convex& self) { return self.sum.facet_count(); })
      .def(
          "changed_facets", [](const Convex& self) { return self.sum.changed_facets(); },
          "What touches at the faces that the last move brought, sorted.")
      .def(
          "exact", [](const Convex& self, const ConvexSum::Vertex& vertex) { return self.sum.exact(vertex); },
          "vertex"_a,
          "The exact position of a vertex of P plus one of Q. Raises ValueError where there are no such vertices.")
      .def(
          "sum",
          [](const Convex& self) {
            return remembered(self.sum.sum(), "sum_of_convex", self.p, self.q, self.sum.p_pose(), self.sum.q_pose());
          },
          "The sum at the current poses.")
      .def("volume_exact", [](const Convex& self) { return self.sum.volume_exact(); })
      .def(
          "volume", [](const Convex& self) { return self.sum.volume(); }, "With a relative error of at most 1e-12.")
      .def("bytes", [](const Convex& self) { return self.sum.bytes(); })
      .def(
          "same_combinatorics",
          [](const Convex& self, const Convex& other) { return self.sum.same_combinatorics(other.sum); }, "other"_a)
      .def(
          "support", [](const Convex& self, const Point3& direction) { return self.sum.support(direction); },
          "direction"_a, "The vertex that is extreme in a direction. Raises ValueError where that is not finite.")
      .def(
          "depth", [](const Convex& self, const Point3& point) { return self.sum.depth(point); },
          "point"_a = nb::make_tuple(0.0, 0.0, 0.0),
          "How deep a point lies, with the nearest facet. Raises ValueError where it is not finite.");
}

void bind_convex_sum_class(nb::module_& m) {
  nb::class_<Convex> type(m, "ConvexSum",
                          R"doc(Holds P (+) Q of convex solids and follows the motion of both. One thread at a time.

>>> from dymsum import ConvexSum, Rotation, negated, solids
>>> sum = ConvexSum(solids.rod(18, 9, 0.5, 3), negated(solids.box(-1, -1, -1, 1, 1, 1)))
>>> work = sum.set(Rotation.about((1, 2, 3), 0.05))
>>> sum.depth((0.75, 0, 0)).inside
True
)doc");
  Record<ConvexSum::Vertex>(type, "Vertex", "A vertex of P plus a vertex of Q, by their indices in the meshes.")
      .field("p", &ConvexSum::Vertex::p)
      .field("q", &ConvexSum::Vertex::q)
      .constructible();
  Record<ConvexSum::FacetCount>(type, "FacetCount", "How many facets, and how many of them the last move brought.")
      .listed();
  Record<ConvexSum::Support>(type, "Support", "An extreme vertex and its position.")
      .field("vertex", &ConvexSum::Support::vertex)
      .field("at", &ConvexSum::Support::at);
  bind_making(type);
  bind_moving(type);
  bind_telling(type);
}

/// Rotations from an array of shape (n, 4) of quaternions (w, x, y, z).
std::vector<Rotation> rotations_of(const Rows<4>& quaternions) {
  std::vector<Rotation> all;
  for (std::size_t i = 0; i < quaternions.size; ++i) {
    const double* q = quaternions.row(i);
    all.push_back(of_item(i, [&] { return take(Rotation::nearest(q[0], q[1], q[2], q[3])); }));
  }
  return all;
}

std::vector<PoseReport> batch(const MeshArgument& p, const MeshArgument& q, const std::vector<Rotation>& poses,
                              const BatchOptions& options) {
  return run_with(options, [&](const BatchOptions& own) { return pose_batch(*p, *q, poses, own); });
}

/// The reports as arrays.
nb::object batch_arrays(const MeshArgument& p, const MeshArgument& q, const Rows<4>& quaternions,
                        const BatchOptions& options) {
  const std::vector<PoseReport> reports = batch(p, q, rotations_of(quaternions), options);
  std::vector<std::uint64_t> facets;
  std::vector<double> volume, support, depth, direction;
  std::vector<std::uint8_t> inside;
  for (const PoseReport& r : reports) {
    facets.push_back(r.facets);
    volume.push_back(r.volume);
    support.insert(support.end(), {r.support.x, r.support.y, r.support.z});
    depth.push_back(r.depth.depth);
    inside.push_back(r.depth.inside);
    direction.insert(direction.end(), {r.depth.direction.x, r.depth.direction.y, r.depth.direction.z});
  }
  return nb::module_::import_("dymsum._values")
      .attr("PoseReports")(array_of(std::move(facets)).object, array_of(std::move(volume)).object,
                           array_of(std::move(support), 3).object, array_of(std::move(depth)).object,
                           array_of(std::move(direction), 3).object, truths_of(std::move(inside)).object);
}

void bind_batch(nb::module_& m) {
  Record<PoseReport>(m, "PoseReport", "What a batch reports for one pose of P.")
      .field("facets", &PoseReport::facets)
      .field("volume", &PoseReport::volume)
      .field("support", &PoseReport::support)
      .field("depth", &PoseReport::depth);
  Record<BatchOptions> options(m, "BatchOptions", "Options of pose_batch.");
  options.def(
      "__init__",
      [](BatchOptions* self, const Point3& direction, const Point3& point, Progress progress, int threads) {
        new (self) BatchOptions{direction, point, std::move(progress), threads};
      },
      "support_direction"_a = nb::make_tuple(0.0, 0.0, 1.0), "depth_point"_a = nb::make_tuple(0.0, 0.0, 0.0),
      "progress"_a = nb::none(), "threads"_a = 0);
  options.option("support_direction", &BatchOptions::support_direction)
      .option("depth_point", &BatchOptions::depth_point)
      .option("progress", &BatchOptions::progress)
      .option("threads", &BatchOptions::threads);
  m.def("pose_batch", &batch, "p"_a, "q"_a, "poses"_a, "options"_a = BatchOptions(),
        "P (+) Q at many rotations of P, in parallel.");
  m.def(
      "pose_batch_arrays", &batch_arrays, "p"_a, "q"_a, "quaternions"_a, "options"_a = BatchOptions(),
      nb::sig("def pose_batch_arrays(p: dymsum.MeshLike, q: dymsum.MeshLike, quaternions: "
              "numpy.typing.ArrayLike, options: BatchOptions = ...) -> dymsum.PoseReports"),
      R"doc(The same for quaternions (w, x, y, z), shape (n, 4), each taken as Rotation.nearest: arrays facets (n), volume (n),
support (n, 3), depth (n), direction (n, 3), inside (n).

>>> import numpy
>>> from dymsum import pose_batch_arrays, solids
>>> turns = numpy.array([[1, 0, 0, 0], [1, 0, 0, 1]], dtype=float)
>>> pose_batch_arrays(solids.box(0, 0, 0, 1, 2, 3), solids.box(0, 0, 0, 1, 1, 1), turns).volume
array([24., 24.])
)doc");
}

void bind_convex_functions(nb::module_& m) {
  m.def(
      "penetration_depth",
      [](const MeshArgument& p, const MeshArgument& q, const SolidPose& p_pose, const SolidPose& q_pose,
         const Point3& moved) {
        return take(without_gil([&] { return penetration_depth(*p, *q, p_pose, q_pose, moved); }));
      },
      "p"_a, "q"_a, "p_pose"_a = SolidPose(), "q_pose"_a = SolidPose(), "q_moved_by"_a = nb::make_tuple(0.0, 0.0, 0.0),
      R"doc(The shortest translation of Q that separates two convex solids. Raises Error: not_convex, no_area, not_finite.

>>> from dymsum import penetration_depth, solids
>>> box = solids.box(0, 0, 0, 2, 2, 2)
>>> penetration_depth(box, box, q_moved_by=(1.5, 0, 0)).depth_squared
Fraction(1, 4)
)doc");
  m.def(
      "convex_sum_within",
      [](const MeshArgument& p, const MeshArgument& q, std::uint64_t memory) {
        return Convex{p.object, q.object, take(without_gil([&] { return convex_sum_within(*p, *q, memory); }))};
      },
      "p"_a, "q"_a, "memory"_a,
      "ConvexSum that holds at most `memory` bytes; 0: no limit. Raises Error also: out_of_memory.");
  m.def(
      "convex_sum_within",
      [](nb::handle_t<SpatialSum> p, const MeshArgument& q, std::uint64_t memory) {
        const SpatialSum& first = *nb::inst_ptr<SpatialSum>(p);
        return Convex{nb::borrow(p), q.object, take(without_gil([&] { return convex_sum_within(first, *q, memory); }))};
      },
      "p"_a, "q"_a, "memory"_a);
}

}  // namespace

void bind_convex_sum(nb::module_& m) {
  bind_convex_results(m);
  bind_convex_sum_class(m);
  bind_batch(m);
  bind_convex_functions(m);
}

}  // namespace dymsum::python
