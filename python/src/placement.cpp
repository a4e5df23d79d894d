// Placements and checks of layouts.
#include "dymsum/placement.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/layout_check.h"
#include "enumeration.h"
#include "paths.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_placement_records(nb::module_& m) {
  Record<PlacementOptions> options(m, "PlacementOptions", "Options of Placement.");
  options.def(
      "__init__",
      [](PlacementOptions* self, double spacing, double margin) {
        new (self) PlacementOptions{spacing, margin};
      },
      "spacing"_a = 0.0, "margin"_a = 0.0);
  options.option("spacing", &PlacementOptions::spacing, "The least distance of two parts: never less is left.")
      .option("margin", &PlacementOptions::margin, "That of a part and the outside of the container.");
  Record<PlacedPart>(m, "PlacedPart", "A placed part.")
      .field("part", &PlacedPart::part, "Its index.")
      .field("shape", &PlacedPart::shape, "Index of its shape.")
      .field("at", &PlacedPart::at, "Of the reference point, the origin of the shape's coordinates: exact.");
  Record<CandidatePosition> candidate(m, "CandidatePosition", "A position at which a part touches what is around it.");
  enumeration<CandidatePosition::Kind>(candidate, "Kind", "What it is of the feasible set.",
                                       {"a vertex of a part of the set", "the end of a segment: the part can slide",
                                        "the part fits exactly and cannot move"});
  candidate.def_ro_static("kContainer", &CandidatePosition::kContainer, "The container, in `touches`.");
  candidate.field("kind", &CandidatePosition::kind)
      .field("vertex", &CandidatePosition::vertex, "Of FeasiblePositions.set, whose `exact` has its position.")
      .field("touches", &CandidatePosition::touches, "Indices of parts, ascending, then kContainer.");
  Record<FeasiblePositions>(m, "FeasiblePositions", "Where a shape can be placed without overlap.")
      .field("set", &FeasiblePositions::set, "A PlanarSum: parts with holes, segments and points.")
      .field("candidates", &FeasiblePositions::candidates, "All its vertices once, by x, then y, exactly.");
}

nb::class_<Placement> bind_placement_class(nb::module_& m) {
  nb::class_<Placement> type(m, "Placement",
                             R"doc(Parts at exact positions in a container, and the positions left for the next.

Raises Error: unsupported_operand for an empty container; out_of_range.

>>> from dymsum import Placement, shapes
>>> placement = Placement(shapes.rectangle(0, 0, 10, 4))
>>> wide = placement.add_shape(shapes.rectangle(0, 0, 4, 4))
>>> peg = placement.add_shape(shapes.rectangle(0, 0, 2, 1))
>>> placement.add_part(wide, (0, 0)), placement.add_part(wide, (6, 0))
(0, 1)
>>> slot = placement.feasible(peg)
>>> slot.set.exact(slot.candidates[0].vertex)
RationalPoint(x=Fraction(4, 1), y=Fraction(0, 1))
>>> slot.candidates[0].kind.name, len(slot.set.parts), len(slot.set.segments)
('segment', 0, 1)
)doc");
  const auto made = [](const RegionArgument& container, const PlacementOptions& options) {
    return take(Placement::create(*container, options));
  };
  type.def(
          "__init__",
          [made](Placement* self, const RegionArgument& container, const PlacementOptions& options) {
            new (self) Placement(made(container, options));
          },
          "container"_a, "options"_a = PlacementOptions())
      .def_static("create", made, "container"_a, "options"_a = PlacementOptions())
      .def("__copy__", [](const Placement& self) { return Placement(self); })
      .def(
          "__deepcopy__", [](const Placement& self, const nb::object&) { return Placement(self); }, "memo"_a);
  return type;
}

void bind_placement_calls(nb::class_<Placement>& type) {
  type.def(
          "add_shape",
          [](Placement& self, const RegionArgument& shape, const Orientation& orientation) {
            return take(without_gil([&] { return self.add_shape(*shape, orientation); }));
          },
          "shape"_a, "orientation"_a = Orientation(), "A shape that parts may have; its index. Raises Error.")
      .def("shape_count", &Placement::shape_count)
      .def(
          "feasible",
          [](Placement& self, std::uint32_t shape) { return take(without_gil([&] { return self.feasible(shape); })); },
          "shape"_a,
          "The positions at which it lies in the container and overlaps no part. Only what changed since the last call "
          "is computed. Raises Error: bad_index.")
      .def(
          "is_free",
          [](Placement& self, std::uint32_t shape, const RationalPoint& at) { return take(self.is_free(shape, at)); },
          "shape"_a, "at"_a, "Whether it does so at one position, exactly.")
      .def(
          "free_beside",
          [](Placement& self, std::uint32_t shape, const RationalPoint& at, double grid) {
            return take(self.free_beside(shape, at, grid));
          },
          "shape"_a, "at"_a, "grid"_a,
          "A free position among the multiples of `grid`, a power of two, near that one; None where none is.")
      .def(
          "add_part",
          [](Placement& self, std::uint32_t shape, const RationalPoint& at) { return take(self.add_part(shape, at)); },
          "shape"_a, "at"_a, "The index of the part. It may overlap others.")
      .def(
          "move_part",
          [](Placement& self, std::uint32_t part, const RationalPoint& at) { take(self.move_part(part, at)); },
          "part"_a, "at"_a)
      .def(
          "remove_part", [](Placement& self, std::uint32_t part) { take(self.remove_part(part)); }, "part"_a)
      .def("parts", &Placement::parts, "Ascending.");
}

void bind_layouts(nb::module_& m) {
  Record<LayoutPart> part(m, "LayoutPart", "A part of a layout: a shape, turned about its origin, then moved.");
  part.def(
      "__init__",
      [](LayoutPart* self, std::uint32_t shape, const RationalPoint& at, const Orientation& orientation,
         std::string name) {
        new (self) LayoutPart{std::move(name), shape, orientation, at};
      },
      "shape"_a, "at"_a, "orientation"_a = Orientation(), "name"_a = "");
  part.field("name", &LayoutPart::name)
      .field("shape", &LayoutPart::shape, "Index into Layout.shapes.")
      .field("orientation", &LayoutPart::orientation)
      .field("at", &LayoutPart::at);
  Record<Layout> layout(m, "Layout", "Shapes, parts, and the container, if any.");
  layout.def(
      "__init__",
      [](Layout* self, const Many<Region>& shapes, std::vector<LayoutPart> parts,
         std::optional<RegionArgument> container) {
        new (self) Layout{};
        for (const RegionArgument& shape : shapes.items) self->shapes.push_back(*shape);
        self->parts = std::move(parts);
        if (container) self->container = **container;
      },
      "shapes"_a, "parts"_a, "container"_a = nb::none());
  layout.field("shapes", &Layout::shapes)
      .field("parts", &Layout::parts)
      .field("container", &Layout::container)
      .field("notes", &Layout::notes, "What was repaired.");
}

void bind_faults(nb::module_& m) {
  Record<LayoutFault> fault(m, "LayoutFault", "What is wrong with a layout.");
  enumeration<LayoutFault::Kind>(fault, "Kind", "What it is.",
                                 {"two parts overlap: `distance` is their penetration depth",
                                  "two parts, or one and the outside, are nearer than required: the distance",
                                  "a part is not in the container: the shortest move into it"});
  fault.def_ro_static("kContainer", &LayoutFault::kContainer, "`other` where that is the container.");
  fault.field("kind", &LayoutFault::kind)
      .field("part", &LayoutFault::part)
      .field("other", &LayoutFault::other, "The other part, with the smaller index, or kContainer.")
      .field("measured", &LayoutFault::measured, "False of overlaps beyond LayoutCheckOptions.measured.")
      .field("squared", &LayoutFault::squared, "The exact square of `distance`.")
      .field("distance", &LayoutFault::distance, "inf where the part fits nowhere.")
      .field("at_most", &LayoutFault::at_most, "`distance` is no more than this.")
      .field("move", &LayoutFault::move, "A shortest move of `part` to a touch.")
      .field("at", &LayoutFault::at, "Near the fault.");
  Record<LayoutCheck>(m, "LayoutCheck", "What check_layout found.")
      .field("faults", &LayoutCheck::faults, "By kind, then the worst first.")
      .field("pairs", &LayoutCheck::pairs, "Of parts that are near enough to be looked at.")
      .field("density", &LayoutCheck::density, "Area of all parts over that of the container.")
      .def("valid", &LayoutCheck::valid);
}

void bind_checks(nb::module_& m) {
  Record<LayoutCheckOptions> options(m, "LayoutCheckOptions", "Options of check_layout.");
  options.def(
      "__init__",
      [](LayoutCheckOptions* self, double spacing, double margin, std::size_t measured, Progress progress) {
        new (self) LayoutCheckOptions{spacing, margin, measured, std::move(progress)};
      },
      "spacing"_a = 0.0, "margin"_a = 0.0, "measured"_a = 100, "progress"_a = nb::none());
  options.option("spacing", &LayoutCheckOptions::spacing, "The required distance of two parts.")
      .option("margin", &LayoutCheckOptions::margin, "That of a part and the outside of the container.")
      .option("measured", &LayoutCheckOptions::measured, "Of how many overlaps the depth is measured: the deepest.")
      .option("progress", &LayoutCheckOptions::progress);
  m.def(
      "check_layout",
      [](const Layout& layout, const LayoutCheckOptions& options) {
        return run_with(options, [&](const LayoutCheckOptions& own) { return check_layout(layout, own); });
      },
      "layout"_a, "options"_a = LayoutCheckOptions(),
      R"doc(Whether a layout is right, exactly; touching is allowed. Raises Error: bad_index, out_of_range, cancelled.

>>> from dymsum import Layout, LayoutPart, check_layout, shapes
>>> parts = [LayoutPart(0, (0, 0)), LayoutPart(0, (1.75, 0.5))]
>>> check = check_layout(Layout([shapes.rectangle(0, 0, 2, 2)], parts, shapes.rectangle(0, 0, 4, 2)))
>>> [(fault.kind.name, fault.part, fault.squared) for fault in check.faults]
[('overlap', 1, Fraction(1, 16)), ('outside', 1, Fraction(1, 4))]
)doc");
  Record<LayoutReadOptions> reading(m, "LayoutReadOptions", "Options of read_layouts.");
  reading.def(
      "__init__",
      [](LayoutReadOptions* self, std::string container, bool repair) {
        new (self) LayoutReadOptions{std::move(container), repair};
      },
      "container"_a = "", "repair"_a = false);
  reading
      .option(
          "container", &LayoutReadOptions::container,
          "Of drawings: '' (class bin of SVG, else the largest ring), 'largest', 'none', a layer (DXF), an id (SVG).")
      .option("repair", &LayoutReadOptions::repair, "JSON: shapes are repaired, as rings that run the wrong way.");
  enumeration<LayoutFormat>(m, "LayoutFormat", "Formats of layouts.");
  m.def(
      "read_layouts",
      [](const PathArgument& path, const LayoutReadOptions& options) { return take(read_layouts(path.text, options)); },
      "path"_a, "options"_a = LayoutReadOptions(),
      "The layouts of a solution as jagua-rs and sparrow write it, or of a drawing: .dxf, .svg. Raises Error.");
  m.def("layout_to_json", &layout_to_json, "layout"_a,
        R"doc(A layout as JSON that read_layouts gives back exactly.

>>> from fractions import Fraction
>>> from dymsum import Layout, LayoutPart, layout_to_json, parse_layouts, shapes
>>> layout = Layout([shapes.rectangle(0, 0, 2, 2)], [LayoutPart(0, (Fraction(1, 3), 0))])
>>> parse_layouts(layout_to_json(layout), "ours")[0].parts[0].at.x
Fraction(1, 3)
)doc");
  m.def(
      "parse_layouts",
      [](const std::string& text, const std::string& name, const LayoutReadOptions& options, LayoutFormat format) {
        return take(parse_layouts(text, name, options, format));
      },
      "text"_a, "name_for_errors"_a = "text", "options"_a = LayoutReadOptions(), "format"_a = LayoutFormat::json,
      "The same from text.");
}

}  // namespace

void bind_placement(nb::module_& m) {
  bind_placement_records(m);
  nb::class_<Placement> type = bind_placement_class(m);
  bind_placement_calls(type);
  bind_layouts(m);
  bind_faults(m);
  bind_checks(m);
}

}  // namespace dymsum::python
