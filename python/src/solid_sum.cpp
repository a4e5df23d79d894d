// The sum of two convex solids.
#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/convex_sum.h"
#include "dymsum/volume_text.h"
#include "extent.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_solid_parts(nb::module_& m) {
  Record<SolidFeature> feature(m, "SolidFeature", "A feature of an operand, by indices into its mesh.");
  nb::enum_<SolidFeature::Kind>(feature, "Kind", "What a feature is.")
      .value("vertex", SolidFeature::Kind::vertex)
      .value("edge", SolidFeature::Kind::edge)
      .value("face", SolidFeature::Kind::face);
  feature.field("kind", &SolidFeature::kind).field("a", &SolidFeature::a).field("b", &SolidFeature::b);
  Record<SolidFacet>(m, "SolidFacet", "A facet of a sum.")
      .field("vertices", &SolidFacet::vertices)
      .field("p", &SolidFacet::p)
      .field("q", &SolidFacet::q)
      .field("changed", &SolidFacet::changed, "not there before the last move");
  nb::enum_<ConvexEngine>(m, "ConvexEngine", "How a sum of convex solids is found.")
      .value("walk", ConvexEngine::walk)
      .value("brute", ConvexEngine::brute);
}

std::array<double, 6> bounds_of(const SolidSum& sum) {
  return extent_of<3>(0, [&](auto&& add) {
    for (const Point3& at : sum.at) {
      const std::array<double, 3> x{at.x, at.y, at.z};
      add(x, [&](std::size_t k) { return x[k]; });
    }
  });
}

void bind_solid_numbers(nb::class_<SolidSum>& sum) {
  sum.def(
         "exact",
         [](const SolidSum& self, std::size_t vertex) {
           if (vertex >= self.vertices.size()) throw nb::index_error("no such vertex");
           return self.exact(vertex);
         },
         "vertex"_a, "The exact position of a vertex.")
      .def(
          "rounded", [](const SolidSum& self) { return self.rounded(); }, "MeshData with rounded positions.")
      .def(
          "rounded_mesh", [](const SolidSum& self, Precision precision) { return take(self.rounded_mesh(precision)); },
          "precision"_a = Precision::doubles,
          "A valid convex mesh. Raises Error: rounding_changed_topology, not_finite.")
      .def(
          "rounded_hull", [](const SolidSum& self, Precision precision) { return take(self.rounded_hull(precision)); },
          "precision"_a = Precision::doubles)
      .def("edge_count", &SolidSum::edge_count)
      .def("volume", &SolidSum::volume, "Nearest to the exact one.")
      .def("volume_exact", &SolidSum::volume_exact)
      .def("bounds", &bounds_of,
           "[min x, min y, min z, max x, max y, max z], each the nearest double to the exact one.")
      .def("area", &SolidSum::area, "The nearest double to that of the exact facets.");
}

void bind_solid_sum_class(nb::module_& m) {
  nb::class_<SolidSum> sum(m, "SolidSum", nb::dynamic_attr(), "The exact sum of two convex solids.");
  Record<SolidSum::Vertex>(sum, "Vertex", "A vertex of P plus a vertex of Q.")
      .field("p", &SolidSum::Vertex::p)
      .field("q", &SolidSum::Vertex::q);
  sum.def_ro("vertices", &SolidSum::vertices)
      .def_prop_ro(
          "at",
          [](nb::handle_t<SolidSum> self) {
            return view_of<3>(std::span<const Point3>(nb::inst_ptr<SolidSum>(self)->at), self);
          },
          "Positions, nearest to the exact ones: a view of shape (n, 3).")
      .def_ro("facets", &SolidSum::facets)
      .def_ro("p_pose", &SolidSum::p_pose)
      .def_ro("q_pose", &SolidSum::q_pose)
      .def(
          "__eq__", [](const SolidSum& a, const SolidSum& b) { return a == b; }, nb::is_operator())
      .def("__repr__",
           [](const SolidSum& self) {
             return "<SolidSum: " + std::to_string(self.vertices.size()) + " vertices, " +
                    std::to_string(self.facets.size()) + " facets>";
           })
      .def(
          "to_glb",
          [](nb::handle_t<SolidSum> self) { return nb::module_::import_("dymsum._display").attr("solid_glb")(self); },
          nb::sig("def to_glb(self) -> bytes"), "The bytes of a .glb file, rounded.")
      .def("_repr_svg_",
           [](nb::handle_t<SolidSum> self) { return nb::module_::import_("dymsum._display").attr("solid_svg")(self); })
      .def("__reduce__", [](nb::handle_t<SolidSum> self) { return made_again(self); })
      .def(
          "to_trimesh",
          [](const SolidSum& self) {
            const nb::object mesh = nb::cast(take(self.rounded_mesh()));
            return nb::module_::import_("dymsum._convert").attr("to_trimesh")(mesh);
          },
          "rounded_mesh() as a trimesh object (needs trimesh).");
  sum.attr("__hash__") = nb::none();
  bind_solid_numbers(sum);
}

void bind_convex_sums(nb::module_& m) {
  m.def(
      "convex_sum",
      [](const MeshArgument& p, const MeshArgument& q, const SolidPose& p_pose, const SolidPose& q_pose,
         ConvexEngine engine) {
        SolidSum sum = take(without_gil([&] { return convex_sum(*p, *q, p_pose, q_pose, engine); }));
        return remembered(std::move(sum), "convex_sum", p.object, q.object, p_pose, q_pose);
      },
      "p"_a, "q"_a, "p_pose"_a = SolidPose(), "q_pose"_a = SolidPose(), "engine"_a = ConvexEngine::walk,
      R"doc(P (+) Q for convex solids. Raises Error: not_convex with the reflex edge; no_area for an empty operand.

>>> from dymsum import convex_sum, solids
>>> convex_sum(solids.box(0, 0, 0, 1, 1, 1), solids.box(0, 0, 0, 1, 2, 3)).volume_exact()
Fraction(24, 1)
)doc");
  m.def(
      "convex_sum",
      [](const Many<Mesh>& solids) {
        std::vector<Mesh> all;
        nb::list kept;
        for (const MeshArgument& one : solids.items) {
          all.push_back(*one);
          kept.append(one.object);
        }
        SolidSum sum = take(without_gil([&] { return convex_sum(std::span<const Mesh>(all)); }));
        return remembered(std::move(sum), "convex_sum_of", kept);
      },
      "solids"_a, "The sum of two or more solids, added from the first one on.");
  m.def(
      "volume_text", [](const SolidSum& sum) { return volume_text(sum); }, "sum"_a);
  m.def(
      "surface_text", [](const SolidSum& sum) { return surface_text(sum); }, "sum"_a);
}

}  // namespace

void bind_solid_sum(nb::module_& m) {
  bind_solid_parts(m);
  bind_solid_sum_class(m);
  bind_convex_sums(m);
}

}  // namespace dymsum::python
