// Sums of convex polygons in motion.
#include "dymsum/convex_polygon_sum.h"

#include "arguments.h"
#include "bind.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_sum(nb::module_& m) {
  Record<PolygonSum> sum(m, "PolygonSum", "The exact sum of two convex polygons.");
  Record<PolygonSum::Vertex>(sum, "Vertex", "A vertex of P plus a vertex of Q.")
      .field("p", &PolygonSum::Vertex::p)
      .field("q", &PolygonSum::Vertex::q);
  sum.field("vertices", &PolygonSum::vertices)
      .field("exact", &PolygonSum::exact, "their positions")
      .def("area_exact", &PolygonSum::area_exact)
      .def(
          "rounded",
          [](const PolygonSum& self) {
            const std::vector<Point> points = self.rounded();
            const auto* first = reinterpret_cast<const double*>(points.data());
            return array_of(std::vector<double>(first, first + 2 * points.size()), 2);
          },
          "Shape (n, 2), each coordinate the nearest double.");
  Record<PolygonWork>(m, "PolygonWork", "The work of one move.")
      .field("vertex_checks", &PolygonWork::vertex_checks)
      .field("vertex_errors", &PolygonWork::vertex_errors)
      .field("steps", &PolygonWork::steps)
      .field("exact_signs", &PolygonWork::exact_signs);
}

/// With the operands that it is made of again.
struct ConvexPolygons {
  ConvexPolygons(const RegionArgument& p_of, const RegionArgument& q_of)
      : p(p_of.object), q(q_of.object), sum(take(ConvexPolygonSum::create(*p_of, *q_of))) {}
  nb::object p, q;
  ConvexPolygonSum sum;
};

void bind_convex_polygons(nb::module_& m) {
  nb::class_<ConvexPolygons>(m, "ConvexPolygonSum",
                             R"doc(P (+) Q of convex polygons that rotate and scale. One thread at a time.

>>> from dymsum import ConvexPolygonSum, Orientation, PlanarPose, shapes
>>> sum = ConvexPolygonSum(shapes.rectangle(0, 0, 2, 1), shapes.rectangle(0, 0, 1, 1))
>>> work = sum.set(PlanarPose(Orientation.nearest(0.5, 1e-3)))
>>> len(sum.sum().vertices)
8
)doc")
      .def(
          "__init__",
          [](ConvexPolygons* self, const RegionArgument& p, const RegionArgument& q) {
            new (self) ConvexPolygons(p, q);
          },
          "p"_a, "q"_a, "At the identity. Raises Error: unsupported_operand; not_convex with the reflex vertex.")
      .def_static(
          "create", [](const RegionArgument& p, const RegionArgument& q) { return ConvexPolygons(p, q); }, "p"_a, "q"_a)
      .def(
          "set", [](ConvexPolygons& self, const PlanarPose& p, const PlanarPose& q) { return self.sum.set(p, q); },
          "p"_a, "q"_a = PlanarPose())
      .def("rebuild", [](ConvexPolygons& self) { return self.sum.rebuild(); })
      .def("work", [](const ConvexPolygons& self) { return self.sum.work(); })
      .def("p_pose", [](const ConvexPolygons& self) { return self.sum.p_pose(); })
      .def("q_pose", [](const ConvexPolygons& self) { return self.sum.q_pose(); })
      .def(
          "sum", [](const ConvexPolygons& self) { return self.sum.sum(); }, "The sum at the current poses.")
      .def(
          "same_combinatorics",
          [](const ConvexPolygons& self, const ConvexPolygons& other) {
            return self.sum.same_combinatorics(other.sum);
          },
          "other"_a)
      .def("__copy__", [](const ConvexPolygons& self) { return ConvexPolygons(self); })
      .def("__reduce__", [](nb::handle_t<ConvexPolygons> self) {
        const auto* object = nb::inst_ptr<ConvexPolygons>(self);
        return nb::make_tuple(nb::module_::import_("dymsum._remake").attr("convex_polygons"),
                              nb::make_tuple(object->p, object->q, object->sum.p_pose(), object->sum.q_pose()));
      });
}

}  // namespace

void bind_convex_polygon(nb::module_& m) {
  bind_sum(m);
  bind_convex_polygons(m);
}

}  // namespace dymsum::python
