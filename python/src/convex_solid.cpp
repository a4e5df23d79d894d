// The finished solid of a convex sum in motion.
#include "dymsum/convex_solid.h"

#include "arguments.h"
#include "bind.h"
#include "enumeration.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_solid_changes(nb::module_& m) {
  Record<IndexRange>(m, "IndexRange", "A run of indices.")
      .field("first", &IndexRange::first)
      .field("count", &IndexRange::count);
  Record<FacetChange> change(m, "FacetChange", "What happened to a facet from one solid to the next.");
  enumeration<FacetChange::Kind>(change, "Kind", "What happened to a facet.");
  change.field("kind", &FacetChange::kind)
      .field("facet", &FacetChange::facet)
      .field("vertices_appeared", &FacetChange::vertices_appeared)
      .field("vertices_disappeared", &FacetChange::vertices_disappeared);
  Record<SolidChanges>(m, "SolidChanges", "From one solid to the next.")
      .field("facets", &SolidChanges::facets)
      .field("vertices_appeared", &SolidChanges::vertices_appeared)
      .field("vertices_disappeared", &SolidChanges::vertices_disappeared)
      .field("moved", &SolidChanges::moved)
      .field("triangles", &SolidChanges::triangles);
}

/// A copy: the next write may move the buffer.
template <class T>
Array<T> copied(const std::vector<T>& numbers) {
  return array_of(std::vector<T>(numbers), 3);
}

void bind_buffers(nb::module_& m) {
  nb::class_<SolidBuffers>(m, "SolidBuffers",
                           "Positions and triangles as renderers take them, kept from solid to solid.")
      .def(nb::init<>())
      .def_prop_ro(
          "positions", [](const SolidBuffers& self) { return copied(self.positions); }, "A copy, shape (n, 3).")
      .def_prop_ro(
          "triangles", [](const SolidBuffers& self) { return copied(self.triangles); }, "A copy, shape (m, 3).")
      .def_prop_ro("positions_changed", [](const SolidBuffers& self) { return self.positions_changed; })
      .def_prop_ro("triangles_changed", [](const SolidBuffers& self) { return self.triangles_changed; })
      .def_ro("frame", &SolidBuffers::frame);
}

void bind_convex_solid_class(nb::module_& m) {
  Record<ConvexSolid> solid(m, "ConvexSolid", "The exact sum at one pose, in an order that stays.");
  Record<ConvexSolid::Facet>(solid, "Facet", "A facet, by a run of corners.")
      .field("first", &ConvexSolid::Facet::first)
      .field("count", &ConvexSolid::Facet::count)
      .field("first_triangle", &ConvexSolid::Facet::first_triangle)
      .field("p", &ConvexSolid::Facet::p)
      .field("q", &ConvexSolid::Facet::q);
  solid.field("vertices", &ConvexSolid::vertices)
      .field("at", &ConvexSolid::at)
      .field("facets", &ConvexSolid::facets)
      .field("corners", &ConvexSolid::corners)
      .field("vertex_count", &ConvexSolid::vertex_count)
      .field("facet_count", &ConvexSolid::facet_count)
      .field("triangle_slots", &ConvexSolid::triangle_slots)
      .field("p_pose", &ConvexSolid::p_pose)
      .field("q_pose", &ConvexSolid::q_pose)
      .field("changes", &ConvexSolid::changes)
      .field("frame", &ConvexSolid::frame);
  solid.attr("kFree") = ConvexSolid::kFree;
  solid
      .def(
          "corners_of",
          [](const ConvexSolid& self, std::size_t facet) {
            if (facet >= self.facets.size()) throw nb::index_error("no such facet");
            const auto corners = self.corners_of(facet);
            return std::vector<std::uint32_t>(corners.begin(), corners.end());
          },
          "facet"_a)
      .def_prop_ro(
          "positions",
          [](nb::handle_t<ConvexSolid> self) {
            return view_of<3>(std::span<const Point3>(nb::inst_ptr<ConvexSolid>(self)->at), self);
          },
          "at as a view of shape (n, 3).")
      .def("write", &ConvexSolid::write, "buffers"_a, "Brings buffers up to date.");
}

}  // namespace

void bind_convex_solid(nb::module_& m) {
  bind_solid_changes(m);
  bind_buffers(m);
  bind_convex_solid_class(m);
}

}  // namespace dymsum::python
