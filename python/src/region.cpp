// Planar regions.
#include "dymsum/region.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/area_text.h"
#include "dymsum/grown_region.h"
#include "dymsum/region_io.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

std::vector<Point> points_of(const Rows<2>& rows) {
  static_assert(sizeof(Point) == 2 * sizeof(double));
  const auto* first = reinterpret_cast<const Point*>(rows.data);
  return {first, first + rows.size};
}

PointsView ring_view(const std::vector<Point>& points, nb::handle owner) {
  return view_of<2>(std::span<const Point>(points), owner);
}

std::vector<PointsView> views(const std::vector<std::vector<Point>>& lists, nb::handle owner) {
  std::vector<PointsView> all;
  for (const auto& list : lists) all.push_back(ring_view(list, owner));
  return all;
}

Part part_of(const Rows<2>& outer, const std::vector<Rows<2>>& holes) {
  Part part{points_of(outer), {}};
  for (const auto& hole : holes) part.holes.push_back(points_of(hole));
  return part;
}

RegionData region_data_of(const std::vector<Part>& parts, const std::vector<Rows<2>>& polylines,
                          const Rows<2>& points) {
  RegionData data{parts, {}, points_of(points)};
  for (const auto& line : polylines) data.polylines.push_back(points_of(line));
  return data;
}

template <class T>
const T& self_of(nb::handle self) {
  return *nb::inst_ptr<T>(self);
}

void bind_part(nb::module_& m) {
  nb::class_<Part> part(m, "Part", "A connected piece of the plane: inside `outer`, outside every hole.");
  part.def(
          "__init__",
          [](Part* self, const Rows<2>& outer, const std::vector<Rows<2>>& holes) {
            new (self) Part(part_of(outer, holes));
          },
          "outer"_a, "holes"_a = nb::list(), "From arrays of shape (n, 2).")
      .def_prop_ro(
          "outer", [](nb::handle_t<Part> self) { return ring_view(self_of<Part>(self).outer, self); },
          "The outer ring, counter-clockwise: a view of shape (n, 2); the first vertex is not repeated.")
      .def_prop_ro(
          "holes", [](nb::handle_t<Part> self) { return views(self_of<Part>(self).holes, self); },
          "The holes, clockwise: views of shape (n, 2).")
      .def(
          "__eq__", [](const Part& a, const Part& b) { return a == b; }, nb::is_operator())
      .def("__repr__",
           [](const Part& part) {
             return "Part(" + std::to_string(part.outer.size()) + " vertices, " + std::to_string(part.holes.size()) +
                    " holes)";
           })
      .def("__reduce__", [](nb::handle_t<Part> self) {
        return nb::make_tuple(self.type(), nb::make_tuple(self.attr("outer"), self.attr("holes")));
      });
  part.attr("__hash__") = nb::none();
}

/// What RegionData and Region show alike.
template <class T, class DataOf>
void bind_lists(nb::class_<T>& type, DataOf data) {
  type.def_prop_ro(
          "parts", [data](const T& self) -> const std::vector<Part>& { return data(self).parts; },
          nb::rv_policy::reference_internal, "The connected pieces with area.")
      .def_prop_ro(
          "polylines", [data](nb::handle_t<T> self) { return views(data(self_of<T>(self)).polylines, self); },
          "Open chains of segments: views of shape (n, 2).")
      .def_prop_ro(
          "points", [data](nb::handle_t<T> self) { return ring_view(data(self_of<T>(self)).points, self); },
          "Isolated points: a view of shape (n, 2).")
      .def("__reduce__", [](nb::handle_t<T> self) {
        const nb::object rebuild = nb::module_::import_("dymsum._core").attr("_region_data");
        const nb::tuple lists = nb::make_tuple(self.attr("parts"), self.attr("polylines"), self.attr("points"));
        if constexpr (std::is_same_v<T, RegionData>) return nb::make_tuple(rebuild, lists);
        return nb::make_tuple(nb::module_::import_("dymsum._core").attr("_region_of_lists"), lists);
      });
}

void bind_region_data(nb::module_& m) {
  nb::class_<RegionData> data(m, "RegionData", "The plain lists that a region is made from, not yet validated.");
  data.def(
      "__init__",
      [](RegionData* self, const std::vector<Part>& parts, const std::vector<Rows<2>>& polylines,
         const Rows<2>& points) { new (self) RegionData(region_data_of(parts, polylines, points)); },
      "parts"_a = nb::list(), "polylines"_a = nb::list(), "points"_a = nb::list());
  bind_lists(data, [](const RegionData& of) -> const RegionData& { return of; });
  data.def(
      "__eq__", [](const RegionData& a, const RegionData& b) { return a == b; }, nb::is_operator());
  data.attr("__hash__") = nb::none();
  m.def("_region_data", &region_data_of);
  m.def("_region_of_lists",
        [](const std::vector<Part>& parts, const std::vector<Rows<2>>& polylines, const Rows<2>& points) {
          return take(Region::create(region_data_of(parts, polylines, points)));
        });
}

void bind_region_class(nb::module_& m) {
  nb::class_<Region> region(m, "Region", nb::dynamic_attr(),
                            R"doc(A valid planar region: parts with holes, polylines, points; perhaps empty.

Coordinates are doubles taken at face value. A region is made from

* an array or a sequence of points, shape (n, 2): one ring, counter-clockwise; the first point may be repeated as last;
* a sequence of rings: the outer one, then holes, clockwise;
* a sequence of such sequences: several parts;
* WKT text; a shapely geometry; a GeoJSON mapping or anything with `__geo_interface__`, whose rings may run either way;
* RegionData.

Raises Error: not_finite, too_few_vertices, repeated_vertex, no_area, wrong_orientation, self_crossing, rings_cross,
hole_outside, parts_overlap, with part, ring, vertex and a position; malformed for text. `repair` mends what it can.

>>> from dymsum import Region, area
>>> area(Region([(0, 0), (4, 0), (0, 3)]))
6.0
>>> Region("POLYGON((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 2 2, 2 1, 1 1))").hole_count()
1
>>> Region([(0, 0), (1, 1), (1, 0), (0, 1)])
Traceback (most recent call last):
...
dymsum.Error: part 0, ring 0, vertex 0: a ring crosses itself or runs along itself (the other: part 0, ring 0, vertex 2) at (0.5, 0.5)
)doc");
  region
      .def(
          "__init__", [](Region* self, const RegionArgument& source) { new (self) Region(*source); }, "source"_a)
      .def(nb::init<>())
      .def_static(
          "create", [](RegionData data) { return take(Region::create(std::move(data))); }, "data"_a,
          "Validates `data`. Raises Error as the constructor.")
      .def_prop_ro("data", &Region::data, nb::rv_policy::reference_internal)
      .def_prop_ro("touching_points", &Region::touching_points,
                   "Points at which rings touch themselves or each other, sorted; usually none.")
      .def("empty", &Region::empty)
      .def(
          "area", [](const Region& self) { return area(self); }, "As the function of this name.")
      .def(
          "bounds", [](const Region& self) { return bounds(self); }, "As the function of this name.")
      .def("vertex_count", &Region::vertex_count)
      .def("hole_count", &Region::hole_count)
      .def("canonical", &Region::canonical, "The same set written in the one canonical way.")
      .def(
          "__eq__", [](const Region& a, const Region& b) { return a == b; }, nb::is_operator(),
          "Equality of canonical forms.")
      .def("__bool__", [](const Region& self) { return !self.empty(); })
      .def("__repr__",
           [](const Region& self) {
             return "<Region: " + std::to_string(self.parts().size()) + " parts, " + std::to_string(self.hole_count()) +
                    " holes, " + std::to_string(self.vertex_count()) + " vertices>";
           })
      .def("_repr_svg_", [](const Region& self) { return draw_region(self); })
      .def_prop_ro(
          "wkt",
          [](const Region& self) {
            std::string text = format_region(self, RegionFormat::wkt);
            while (text.ends_with('\n')) text.pop_back();
            return text;
          },
          "The region as WKT text, coordinates with the fewest digits that read back.")
      .def_prop_ro(
          "__geo_interface__",
          [](const Region& self) {
            const std::string text = format_region(self, RegionFormat::geojson);
            return nb::module_::import_("dymsum._convert").attr("geo_interface")(text);
          },
          "The region as a GeoJSON geometry.")
      .def(
          "to_shapely",
          [](nb::handle_t<Region> self) { return nb::module_::import_("dymsum._convert").attr("to_shapely")(self); },
          "The region as a shapely geometry (needs shapely 2).");
  region.attr("__hash__") = nb::none();
  bind_lists(region, [](const Region& of) -> const RegionData& { return of.data(); });
}

void bind_region_repair(nb::module_& m) {
  Record<RepairReport>(m, "RepairReport", "What repair changed, as counts.")
      .field("duplicate_vertices", &RepairReport::duplicate_vertices)
      .field("collinear_vertices", &RepairReport::collinear_vertices)
      .field("reversed_rings", &RepairReport::reversed_rings)
      .field("dropped_rings", &RepairReport::dropped_rings)
      .field("polylines_to_points", &RepairReport::polylines_to_points)
      .def("changed", &RepairReport::changed)
      .def("to_string", &RepairReport::to_string);
  Record<Repaired>(m, "Repaired", "A repaired region and what was changed.")
      .field("region", &Repaired::region)
      .field("report", &Repaired::report);
  m.def(
      "repair", [](const RegionDataArgument& data) { return take(repair(*data)); }, "data"_a,
      R"(The named repair: merges duplicate vertices, drops collinear ones, spikes and empty rings, orients rings, and
reports what it changed. Crossings are not repaired: they raise Error. Takes RegionData and all that Region takes.

>>> from dymsum import repair
>>> mended = repair([(0, 0), (0, 3), (4, 0), (4, 0)])
>>> mended.report.reversed_rings, mended.report.duplicate_vertices
(1, 1)
)");
}

void bind_region_functions(nb::module_& m) {
  m.def(
      "area", [](const RegionArgument& region) { return area(*region); }, "region"_a,
      R"doc(The area, rounded once; see area_text beyond the range of doubles.

>>> from dymsum import area
>>> area([[(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (1, 2), (2, 2), (2, 1)]])
15.0
)doc");
  m.def(
      "area_text", [](const RegionArgument& region) { return area_text(*region); }, "region"_a,
      "The exact area to 17 digits, at any size.");
  m.def(
      "radius_of_gyration", [](const RegionArgument& region) { return radius_of_gyration(*region); }, "region"_a,
      "The root of the mean square distance from the origin: the natural length per radian.");
  m.def(
      "bounds", [](const RegionArgument& region) { return bounds(*region); }, "region"_a,
      R"doc([min x, min y, max x, max y]; zeros for the empty region.

>>> from dymsum import bounds
>>> bounds([(0, 0), (4, 0), (0, 3)])
[0.0, 0.0, 4.0, 3.0]
)doc");
  m.def(
      "negated", [](const RegionArgument& region) { return negated(*region); }, "region"_a,
      R"doc(-region. Exact.

>>> from dymsum import bounds, negated
>>> bounds(negated([(0, 0), (4, 0), (0, 3)]))
[-4.0, -3.0, 0.0, 0.0]
)doc");
  m.def(
      "translated",
      [](const RegionArgument& region, double dx, double dy) { return take(translated(*region, dx, dy)); }, "region"_a,
      "dx"_a, "dy"_a, R"doc(region + (dx, dy), each coordinate rounded once.

>>> from dymsum import translated
>>> translated([(0, 0), (4, 0), (0, 3)], 1, -2).wkt
'POLYGON ((1 -2,5 -2,1 1,1 -2))'
)doc");
  m.def(
      "scaled", [](const RegionArgument& region, double sx, double sy) { return take(scaled(*region, sx, sy)); },
      "region"_a, "sx"_a, "sy"_a,
      R"doc(diag(sx, sy) region, each coordinate rounded once. Raises Error: unsupported_operand.

>>> from dymsum import scaled
>>> scaled([(0, 0), (4, 0), (0, 3)], 0.5, 2).bounds()
[0.0, 0.0, 2.0, 6.0]
)doc");
  Record<GrownRegion>(m, "GrownRegion", "A region with a margin around it.")
      .field("region", &GrownRegion::region)
      .field("margin", &GrownRegion::margin, "every point within this distance of the given region lies inside")
      .field("at_most", &GrownRegion::at_most, "no point is farther from the given region than this");
  m.def(
      "grown",
      [](const RegionArgument& region, double margin, int sides) {
        return take(without_gil([&] { return grown(*region, margin, sides); }));
      },
      "region"_a, "margin"_a, "sides"_a = 16,
      R"doc(The sum with a regular polygon around the disc of radius `margin`, rounded outwards. Raises Error: out_of_range,
rounding_changed_topology.

>>> from dymsum import area, grown, shapes
>>> wide = grown(shapes.rectangle(0, 0, 1, 1), 0.5)
>>> wide.margin <= 0.5 <= wide.at_most, 3.78 < area(wide.region) < 3.85
(True, True)
)doc");
}

}  // namespace

void bind_region(nb::module_& m) {
  bind_part(m);
  bind_region_data(m);
  bind_region_class(m);
  bind_region_repair(m);
  bind_region_functions(m);
}

}  // namespace dymsum::python
