// Sums of a region with exact discs: sets whose boundaries are segments and true arcs.
#include "dymsum/growing_disc.h"

#include <algorithm>

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/region_io.h"
#include "enumeration.h"
#include "record.h"

namespace dymsum::python {

/// A DiscRadius, or a number that is taken exactly.
struct RadiusArgument {
  Result<DiscRadius> given = DiscRadius(Rational());
  /// Raises what is wrong with the number.
  DiscRadius value() const { return take(Result<DiscRadius>(given)); }
};

}  // namespace dymsum::python

namespace nanobind::detail {

template <>
struct type_caster<dymsum::python::RadiusArgument> {
  NB_TYPE_CASTER(dymsum::python::RadiusArgument, const_name("DiscRadius | fractions.Fraction | float"))
  bool from_python(handle src, uint32_t, cleanup_list*) {
    if (isinstance<dymsum::DiscRadius>(src)) {
      value.given = *inst_ptr<dymsum::DiscRadius>(src);
      return true;
    }
    dymsum::Result<dymsum::Rational> number = dymsum::Rational();
    if (!dymsum::python::read_rational(src, number)) return false;
    value.given = number ? dymsum::Result<dymsum::DiscRadius>(*number) : number.error();
    return true;
  }
};

}  // namespace nanobind::detail

namespace dymsum::python {
namespace {

using namespace nb::literals;

/// A set, with the region it comes from: its picture shows both.
struct DiscSetOf : DiscSet {
  Region region;
};

/// A member of DiscSet as one of DiscSetOf.
template <class M>
constexpr M DiscSetOf::*of_set(M DiscSet::*member) {
  return member;
}

void bind_disc_radius(nb::module_& m) {
  enumeration<DiscSide>(m, "DiscSide", "Where discs grow.",
                        {"outside of the region: sum, closing", "inside: erosion, opening"});
  enumeration<DiscBound>(m, "DiscBound", "Where polygons that stand for a set lie.",
                         {"in it", "around it", "with all vertices on its boundary"});
  nb::class_<DiscRadius> radius(m, "DiscRadius",
                                "A radius: an exact number, or exactly that of an event, which need not be rational.");
  radius
      .def(
          "__init__", [](DiscRadius* self, const RadiusArgument& value) { new (self) DiscRadius(value.value()); },
          "value"_a, "Raises Error: not_finite.")
      .def_static("at_event", &DiscRadius::at_event, "index"_a,
                  "The radius of that event of GrowingDisc.events of the side at hand.")
      .def_prop_ro(
          "value", [](const DiscRadius& self) { return self.value; }, "Where no event is named.")
      .def_prop_ro("event", [](const DiscRadius& self) { return self.event; })
      .def(
          "__eq__", [](const DiscRadius& a, const DiscRadius& b) { return a == b; }, nb::is_operator())
      .def("__repr__",
           [](const DiscRadius& self) {
             return self.event ? "DiscRadius.at_event(" + std::to_string(*self.event) + ")"
                               : "DiscRadius(" + nb::cast<std::string>(nb::repr(nb::cast(self.value))) + ")";
           })
      .def("__reduce__", [](nb::handle_t<DiscRadius> self) {
        const auto* own = nb::inst_ptr<DiscRadius>(self);
        if (own->event) return nb::make_tuple(self.type().attr("at_event"), nb::make_tuple(*own->event));
        return nb::make_tuple(self.type(), nb::make_tuple(own->value));
      });
  radius.attr("__hash__") = nb::none();
  Record<DiscEvent>(m, "DiscEvent", "A radius at which the pieces of the boundary change.").listed();
}

void bind_disc_corner(nb::module_& m) {
  Record<CornerDisc>(m, "CornerDisc", "A disc that touches the region twice: on an edge of the complex or at a node.")
      .field("at_node", &CornerDisc::at_node)
      .field("index", &CornerDisc::index, "of the edge or of the node");
  Record<DiscCorner> corner(m, "DiscCorner", "Where two pieces of a boundary meet.");
  enumeration<DiscCorner::Kind>(
      corner, "Kind", "What is there.",
      {"a whole circle starts nowhere in particular", "over a vertex of the region, or that vertex",
       "the centre of `disc`: a corner", "where `disc` touches the region", "of the arcs about `disc` and `other`"});
  corner.field("kind", &DiscCorner::kind)
      .field("vertex", &DiscCorner::vertex)
      .field("disc", &DiscCorner::disc)
      .field("other", &DiscCorner::other)
      .field("at", &DiscCorner::at, "within DiscSet.at_error");
}

/// The points at which the pieces of a ring begin, viewed in the memory that keeps them.
PointsView corners_of(const DiscRing& ring, nb::handle owner) {
  static_assert(sizeof(DiscPiece) % sizeof(double) == 0);
  static const Point kNothing;
  const std::size_t shape[] = {ring.pieces.size(), 2};
  const std::int64_t strides[] = {sizeof(DiscPiece) / sizeof(double), 1};
  return {ring.pieces.empty() ? &kNothing.x : &ring.pieces[0].from.at.x, 2, shape, owner, strides};
}

void bind_disc_pieces(nb::module_& m) {
  Record<DiscPiece> piece(m, "DiscPiece", "A segment or an arc; it ends where the next one of its ring begins.");
  enumeration<DiscPiece::Of>(piece, "Of", "What a piece comes from.",
                             {"a segment: a part of edge `index` of the region, moved or in place",
                              "an arc about vertex `index` of the region", "an arc of the boundary of `disc`"});
  piece.field("of", &DiscPiece::of)
      .field("index", &DiscPiece::index)
      .field("disc", &DiscPiece::disc)
      .field("centre", &DiscPiece::centre, "of an arc")
      .field("from_angle", &DiscPiece::from_angle, "of an arc: the direction from its centre to its start, in radians")
      .field("sweep", &DiscPiece::sweep, "of an arc: the angle it covers, positive counter-clockwise")
      .field("heading", &DiscPiece::heading, "of a segment: its direction, in radians")
      .field("from_", &DiscPiece::from);
  Record<DiscRing>(m, "DiscRing", "A boundary ring, the set on its left.")
      .field("pieces", &DiscRing::pieces)
      .def_prop_ro(
          "at", [](nb::handle_t<DiscRing> self) { return corners_of(*nb::inst_ptr<DiscRing>(self), self); },
          "Where the pieces begin: a view of shape (n, 2), within DiscSet.at_error.")
      .def("__len__", [](const DiscRing& self) { return self.pieces.size(); });
  Record<DiscPart>(m, "DiscPart", "A connected piece.")
      .field("outer", &DiscPart::outer)
      .field("holes", &DiscPart::holes);
  Record<DiscSegment>(m, "DiscSegment", "A piece of a set without area about it, or a tight one.")
      .field("from_", &DiscSegment::from)
      .field("to", &DiscSegment::to);
}

DiscPolygons polygons_of(const DiscSetOf& set, double error, DiscBound bound) {
  return take(without_gil([&] { return to_region(set, error, bound); }));
}

/// How near to_shapely comes where nothing is said.
double fine_error(const DiscSetOf& set) { return set.radius > 0 ? std::max(set.radius / 1000, 8 * set.at_error) : 1; }

nb::object shapely_of(const DiscSetOf& set, std::optional<double> error, DiscBound bound) {
  return nb::cast(polygons_of(set, error.value_or(fine_error(set)), bound).region).attr("to_shapely")();
}

nb::object geo_interface_of(const DiscSetOf& set) {
  return nb::cast(polygons_of(set, fine_error(set), DiscBound::inside).region).attr("__geo_interface__");
}

std::string short_text(const DiscSetOf& set) {
  return "<DiscSet: radius " + set.radius_exact + ", " + std::to_string(set.parts.size()) + " parts, " +
         std::to_string(set.hole_count()) + " holes, " + std::to_string(set.piece_count()) +
         " pieces, tight: " + std::to_string(set.tight_points.size()) + " points, " +
         std::to_string(set.tight_segments.size()) + " segments>";
}

void bind_disc_set(nb::module_& m) {
  Record<DiscPolygons>(m, "DiscPolygons", "Polygons in place of a set with arcs.")
      .field("region", &DiscPolygons::region)
      .field("error", &DiscPolygons::error,
             "no boundary point of either is further than this from the other's boundary")
      .field("rounded", &DiscPolygons::rounded, "how far rounding moved a vertex at most: a part of `error`")
      .field("chords", &DiscPolygons::chords, "segments that stand for arcs")
      .field("collapsed", &DiscPolygons::collapsed,
             "nearest: where two sides of the boundary are nearer to each other than positions are known: points and "
             "polylines of the region, or closed");
  Record<MeasuredText>(m, "MeasuredText", "A number and how far it may be from the exact one, as decimal numbers.")
      .field("value", &MeasuredText::value)
      .field("error", &MeasuredText::error);
  Record<Measured>(m, "Measured", "A double and how far it may be from the exact number.").listed();
  Record<DiscSetOf> set(m, "DiscSet",
                        R"doc(A set whose boundary is made of segments and arcs.

Which pieces there are and how they follow each other is exact; positions are doubles within at_error.

>>> from dymsum import GrowingDisc, shapes
>>> grown = GrowingDisc(shapes.rectangle(0, 0, 2, 1)).sum_at(1)
>>> len(grown.parts), grown.piece_count(), grown.radius_exact
(1, 8, '1')
>>> grown.parts[0].outer.at.shape
(8, 2)
)doc");
  set.field("parts", of_set(&DiscSet::parts), "closures of the connected interiors")
      .field("segments", of_set(&DiscSet::segments), "pieces of the set without area")
      .field("points", of_set(&DiscSet::points), "the same")
      .field("tight_segments", of_set(&DiscSet::tight_segments), "where a disc fits without room to move sideways")
      .field("tight_points", of_set(&DiscSet::tight_points), "where it fits without any room")
      .field("radius", of_set(&DiscSet::radius), "the nearest double")
      .field("radius_exact", of_set(&DiscSet::radius_exact), "\"3/2\", or a formula of roots at an event")
      .field("at_error", of_set(&DiscSet::at_error), "positions are within this in each coordinate")
      .field("region", &DiscSetOf::region, "what the set was made from")
      .def("hole_count", [](const DiscSetOf& self) { return self.hole_count(); })
      .def(
          "piece_count", [](const DiscSetOf& self) { return self.piece_count(); }, "Of all rings.")
      .def(
          "to_json", [](const DiscSetOf& self) { return disc_set_to_json(self); }, "As disc_set_to_json.")
      .def("to_shapely", &shapely_of, "error"_a = nb::none(), "bound"_a = DiscBound::inside,
           "to_region as a shapely geometry (needs shapely 2); without `error` within a 1000th of the radius.")
      .def(
          "area", [](const DiscSetOf& self) { return area(self).value; },
          "A double: see the function area for its error.")
      .def(
          "bounds", [](const DiscSetOf& self) { return bounds(self); }, "As the function of this name.")
      .def_prop_ro(
          "__geo_interface__", [](const DiscSetOf& self) { return geo_interface_of(self); },
          "to_region as to_shapely does, as GeoJSON.")
      .def("_repr_svg_", [](const DiscSetOf& self) { return draw_disc_set(self.region, self); });
  set.def(
      "__eq__", [](const DiscSetOf& a, const DiscSetOf& b) { return disc_set_to_json(a) == disc_set_to_json(b); },
      nb::is_operator(), "The same pieces, in the same order, at the same positions.");
  set.attr("__hash__") = nb::none();
  // Not piece by piece, as records are.
  set.attr("__repr__") = nb::cpp_function(&short_text, nb::is_method());
}

void bind_disc_set_functions(nb::module_& m) {
  m.def(
      "area", [](const DiscSetOf& set) { return area(set); }, "set"_a, "The area with its error.");
  m.def(
      "area_text", [](const DiscSetOf& set) { return area_text(set); }, "set"_a,
      "The area and its error as decimal numbers with exponents of any size.");
  m.def(
      "perimeter", [](const DiscSetOf& set) { return perimeter(set); }, "set"_a,
      R"doc(The length of all boundary rings with its error; pieces without area do not count.

>>> from dymsum import GrowingDisc, perimeter, shapes
>>> round(perimeter(GrowingDisc(shapes.rectangle(0, 0, 2, 1)).sum_at(1)).value, 6)
12.283185
)doc");
  m.def(
      "bounds", [](const DiscSetOf& set) { return bounds(set); }, "set"_a,
      "[min x, min y, max x, max y] within at_error; zeros for the empty set.");
  m.def("to_region", &polygons_of, "set"_a, "error"_a, "bound"_a = DiscBound::inside,
        R"doc(Chords in place of arcs, by at most `error`, in the unit of the coordinates.

inside: the polygon lies in the set; outside: the set in the polygon; both before vertices are rounded to doubles.
nearest: vertices lie on the boundary, each rounded to the nearest doubles.
Raises Error: out_of_range where `error` is not positive or below what doubles keep; rounding_changed_topology where
polygons of that error cross: a smaller one may do.

>>> from dymsum import DiscBound, GrowingDisc, area, shapes, to_region
>>> grown = GrowingDisc(shapes.rectangle(0, 0, 2, 1)).sum_at(1)
>>> inner, outer = to_region(grown, 0.01), to_region(grown, 0.01, DiscBound.outside)
>>> area(inner.region) < area(grown).value < area(outer.region)
True
)doc");
  m.def(
      "disc_set_to_json", [](const DiscSetOf& set) { return disc_set_to_json(set); }, "set"_a,
      "Every ring with its pieces by name, as JSON text.");
  m.def(
      "draw_disc_set", [](const RegionArgument& p, const DiscSetOf& set) { return draw_disc_set(*p, set); }, "p"_a,
      "set"_a, "The set over the region it comes from, with true arcs, as SVG text.");
}

/// A disc with the options that it is made of again.
struct GrowingDiscObject {
  GrowingDisc disc;
  GrowingDiscOptions options;
};

using SetAt = Result<DiscSet> (GrowingDisc::*)(const DiscRadius&, Semantics, const Progress&) const;

void bind_set_at(nb::class_<GrowingDiscObject>& type, const char* name, SetAt made, const char* doc) {
  type.def(
      name,
      [made](const GrowingDiscObject& self, const RadiusArgument& r, Semantics semantics, const Progress& progress) {
        const DiscRadius radius = r.value();
        return DiscSetOf{run(progress, [&](Progress own) { return (self.disc.*made)(radius, semantics, own); }),
                         self.disc.region()};
      },
      "r"_a, "semantics"_a = Semantics::closed, "progress"_a = nb::none(), doc);
}

void bind_sets_at(nb::class_<GrowingDiscObject>& type) {
  bind_set_at(
      type, "sum_at", &GrowingDisc::sum_at,
      "All points at most `r` from the region. open: with the tight features, where a disc that stays clear of the "
      "region touches it on all sides. Radius 0 gives "
      "the region. Raises Error: out_of_range for a negative radius and an event that there is not.");
  bind_set_at(
      type, "eroded_at", &GrowingDisc::eroded_at,
      "The centres of discs that lie in the region. Positions without room to move are `segments` and `points`, "
      "and tight; regular drops them, open only lists them as tight. Raises Error: as sum_at; "
      "unsupported_operand for polylines and points.");
  bind_set_at(type, "opened_at", &GrowingDisc::opened_at,
              "What discs that lie in the region cover. closed and open: with those that fit exactly; regular: the "
              "closure of what the others cover. Raises Error: as eroded_at.");
  bind_set_at(type, "closed_at", &GrowingDisc::closed_at,
              "The region with all that no disc outside of it reaches. closed and regular: discs without room to move "
              "do not reach; open: they do. Raises Error: as eroded_at.");
}

void bind_growing_disc_class(nb::module_& m) {
  Record<GrowingDiscOptions> options(m, "GrowingDiscOptions", "Options of GrowingDisc.");
  options.def(
      "__init__", [](GrowingDiscOptions* self, bool brute) { new (self) GrowingDiscOptions{brute}; },
      "brute"_a = false);
  options.option("brute", &GrowingDiscOptions::brute, "compare all with all; the same result, for tests");
  nb::class_<GrowingDiscObject> type(m, "GrowingDisc",
                                     R"doc(All discs of a region at once: its sum, erosion, opening and closing.

What belongs to all radii is made when first asked for, without the GIL; a radius then costs one pass over it. Radii are
exact numbers in the unit of the coordinates, or DiscRadius.at_event(index). May be shared by threads.

>>> from dymsum import DiscRadius, DiscSide, GrowingDisc, Semantics, shapes
>>> disc = GrowingDisc(shapes.letter_u(4, 4, 1))
>>> [event.radius for event in disc.events(DiscSide.outside)]
[1.0]
>>> [len(disc.sum_at(r, Semantics.open).tight_segments) for r in (0.5, DiscRadius.at_event(0))]
[0, 1]
>>> disc.eroded_at(0.25)
<DiscSet: radius 1/4, 1 parts, 0 holes, 10 pieces, tight: 0 points, 0 segments>
)doc");
  type.def(
          "__init__",
          [](GrowingDiscObject* self, const RegionArgument& region, const GrowingDiscOptions& options) {
            new (self) GrowingDiscObject{GrowingDisc(*region, options), options};
          },
          "region"_a, "options"_a = GrowingDiscOptions())
      .def("region", [](const GrowingDiscObject& self) { return self.disc.region(); })
      .def(
          "events",
          [](const GrowingDiscObject& self, DiscSide side, const Progress& progress) {
            return run(progress, [&](Progress own) { return self.disc.events(side, own); });
          },
          "side"_a, "progress"_a = nb::none(),
          "Radii at which the pieces of the boundary change, positive and ascending.")
      .def("__repr__",
           [](const GrowingDiscObject& self) {
             return "<GrowingDisc of " + nb::cast<std::string>(nb::repr(nb::cast(self.disc.region()))) + ">";
           })
      .def("__reduce__", [](nb::handle_t<GrowingDiscObject> self) {
        const auto* own = nb::inst_ptr<GrowingDiscObject>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(own->disc.region(), own->options));
      });
  bind_sets_at(type);
}

}  // namespace

void bind_growing_disc(nb::module_& m) {
  bind_disc_radius(m);
  bind_disc_corner(m);
  bind_disc_pieces(m);
  bind_disc_set(m);
  bind_disc_set_functions(m);
  bind_growing_disc_class(m);
}

}  // namespace dymsum::python
