// The sum of two regions and what it is made of.
#include "dymsum/planar_sum.h"

#include <algorithm>
#include <functional>

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/area_text.h"
#include "dymsum/region_io.h"
#include "dymsum/snap_rounding.h"
#include "dymsum/sum_io.h"
#include "enumeration.h"
#include "extent.h"
#include "file_content.h"
#include "paths.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_sum_options(nb::module_& m) {
  enumeration<Engine>(m, "Engine", "How the boundary is found; all give the same result.");
  enumeration<Semantics>(m, "Semantics",
                         "closed: sums of closed sets; open: touching is allowed; regular: closure of the interior.");
  Record<SumOptions> options(m, "SumOptions", "Options of planar sums.");
  options.def(
      "__init__",
      [](SumOptions* self, Engine engine, Semantics semantics, Progress progress, bool trace, std::uint64_t memory) {
        new (self) SumOptions{engine, semantics, std::move(progress), trace, memory, {}};
      },
      "engine"_a = Engine::fast, "semantics"_a = Semantics::closed, "progress"_a = nb::none(), "trace"_a = false,
      "memory"_a = 0);
  options.option("engine", &SumOptions::engine)
      .option("semantics", &SumOptions::semantics)
      .option("progress", &SumOptions::progress, "called with the stage and its share in [0, 1]; False stops")
      .option("trace", &SumOptions::trace, "record the stages in PlanarSum.trace")
      .option("memory", &SumOptions::memory,
              "bytes that arrays which grow faster than the operands may hold; 0: no limit");
}

void bind_contact(nb::module_& m) {
  Record<Contact> contact(m, "Contact",
                          "A segment of the convolution: an edge of one operand added to a vertex of the other.");
  enumeration<Contact::Kind>(contact, "Kind", "Whose edge it is.",
                             {"edge p of P + vertex q of Q", "vertex p of P + edge q of Q"});
  contact.constructible().listed();
  Record<SumVertex>(m, "SumVertex", "A vertex of the result: the common point of two segments of the convolution.")
      .field("at", &SumVertex::at, "position within PlanarSum.at_error")
      .field("in_", &SumVertex::in, "the edge that arrives")
      .field("out", &SumVertex::out, "the edge that leaves")
      .field("corner_p", &SumVertex::corner_p, "vertex of P, or kNone at a crossing")
      .field("corner_q", &SumVertex::corner_q, "vertex of Q, or kNone at a crossing")
      .attr("kNone") = SumVertex::kNone;
}

/// Positions of vertices, where they are.
PointsView positions_of(const std::vector<SumVertex>& vertices, nb::handle owner) {
  return view_of<2>(std::span<const SumVertex>(vertices), owner);
}

void bind_planar_parts(nb::module_& m) {
  Record<SumRing> ring(m, "SumRing", "A boundary ring, its interior on the left.");
  ring.field("vertices", &SumRing::vertices)
      .def_prop_ro(
          "at", [](nb::handle_t<SumRing> self) { return positions_of(nb::inst_ptr<SumRing>(self)->vertices, self); },
          "Positions of the vertices: a view of shape (n, 2), within PlanarSum.at_error.")
      .def("__len__", [](const SumRing& self) { return self.vertices.size(); });
  Record<SumPart>(m, "SumPart", "A connected piece.").field("outer", &SumPart::outer).field("holes", &SumPart::holes);
  Record<SumSegment>(m, "SumSegment", "A maximal segment of a tight feature or of a piece without area.")
      .field("from_", &SumSegment::from)
      .field("to", &SumSegment::to);
  Record<ConvolutionSizes>(m, "ConvolutionSizes", "Sizes of the three convolutions.").listed();
}

void bind_stats(nb::module_& m) {
  Record<SumStats> stats(m, "SumStats", "The work that was done.");
  Record<SumStats::Stage>(stats, "Stage", "Time of a stage.").listed();
  stats.listed();
}

void bind_planar_trace(nb::module_& m) {
  Record<PlanarTrace> trace(m, "PlanarTrace", "The stages of a sum as data, rounded.");
  Record<PlanarTrace::Segment>(trace, "Segment", "A segment of the convolution.")
      .field("from_", &PlanarTrace::Segment::from)
      .field("to", &PlanarTrace::Segment::to)
      .field("edge_of_p", &PlanarTrace::Segment::edge_of_p);
  Record<PlanarTrace::Cell>(trace, "Cell", "A run of grid cells.")
      .field("low", &PlanarTrace::Cell::low)
      .field("high", &PlanarTrace::Cell::high);
  trace.field("convolution", &PlanarTrace::convolution)
      .field("masked_cells", &PlanarTrace::masked_cells)
      .field("crossings", &PlanarTrace::crossings)
      .field("kept_loops", &PlanarTrace::kept_loops)
      .field("dropped_loops", &PlanarTrace::dropped_loops)
      .field("tight_points", &PlanarTrace::tight_points)
      .field("tight_segments", &PlanarTrace::tight_segments);
}

std::string repr_of(const PlanarSum& sum) {
  return "<PlanarSum: " + std::to_string(sum.parts.size()) + " parts, " + std::to_string(sum.hole_count()) +
         " holes, " + std::to_string(sum.vertex_count()) +
         " vertices, tight: " + std::to_string(sum.tight_points.size()) + " points, " +
         std::to_string(sum.tight_segments.size()) + " segments>";
}

bool same(const SumVertex& a, const SumVertex& b) {
  return a.at == b.at && a.in == b.in && a.out == b.out && a.corner_p == b.corner_p && a.corner_q == b.corner_q;
}

/// Whether one of the vertices is this one, by its position or as a copy.
bool holds(const std::vector<SumVertex>& vertices, const SumVertex& vertex) {
  const auto* first = vertices.data();
  if (std::less_equal<>()(first, &vertex) && std::less<>()(&vertex, first + vertices.size())) return true;
  return std::any_of(vertices.begin(), vertices.end(), [&](const SumVertex& one) { return same(one, vertex); });
}
bool holds(const std::vector<SumSegment>& segments, const SumVertex& vertex) {
  return std::any_of(segments.begin(), segments.end(),
                     [&](const SumSegment& one) { return same(one.from, vertex) || same(one.to, vertex); });
}
bool has_vertex(const PlanarSum& sum, const SumVertex& vertex) {
  for (const SumPart& part : sum.parts) {
    if (holds(part.outer.vertices, vertex)) return true;
    for (const SumRing& hole : part.holes) {
      if (holds(hole.vertices, vertex)) return true;
    }
  }
  return holds(sum.points, vertex) || holds(sum.tight_points, vertex) || holds(sum.segments, vertex) ||
         holds(sum.tight_segments, vertex);
}

/// add(vertex) for every vertex of the set; tight features lie in its parts.
template <class Add>
void each_vertex(const PlanarSum& sum, Add&& add) {
  for (const SumPart& part : sum.parts) std::for_each(part.outer.vertices.begin(), part.outer.vertices.end(), add);
  for (const SumSegment& segment : sum.segments) add(segment.from), add(segment.to);
  std::for_each(sum.points.begin(), sum.points.end(), add);
}

std::array<double, 4> bounds_of(const PlanarSum& sum) {
  return extent_of<2>(sum.at_error, [&](auto&& add) {
    each_vertex(sum, [&](const SumVertex& v) {
      add({v.at.x, v.at.y}, [&](std::size_t k) { return (k == 0 ? sum.exact(v).x : sum.exact(v).y).to_double(); });
    });
  });
}

nb::object geometry_of(const PlanarSum& sum) {
  return nb::cast(take(snap_rounded(sum)).region).attr("__geo_interface__");
}

void bind_planar_numbers(nb::class_<PlanarSum>& sum) {
  sum.def("hole_count", &PlanarSum::hole_count)
      .def("vertex_count", &PlanarSum::vertex_count, "Of all rings.")
      .def(
          "area_exact", [](const PlanarSum& self) { return without_gil([&] { return self.area_exact(); }); },
          "The area as one Fraction; expensive for thousands of crossings.")
      .def(
          "area_exact_within",
          [](const PlanarSum& self, std::size_t bits) {
            return without_gil([&] { return self.area_exact_within(bits); });
          },
          "bits"_a, "The same where its denominator has at most so many bits, else None.")
      .def(
          "area", [](const PlanarSum& self) { return without_gil([&] { return self.area(); }); },
          "The nearest double to the exact area.")
      .def(
          "bounds", [](const PlanarSum& self) { return without_gil([&] { return bounds_of(self); }); },
          "[min x, min y, max x, max y], each the nearest double to the exact one; zeros for the empty set.")
      .def(
          "exact",
          [](const PlanarSum& self, const SumVertex& vertex) {
            if (!has_vertex(self, vertex)) throw nb::value_error("a vertex of another sum");
            return self.exact(vertex);
          },
          "vertex"_a, R"doc(The exact position of a vertex of this sum. Raises ValueError for one of another sum.

>>> from dymsum import union_of
>>> sum = union_of([[(0, 0), (3, 0), (3, 1)], [(0, 1), (1, 0), (3, 1)]])
>>> [sum.exact(v).x for v in sum.parts[0].outer.vertices if sum.exact(v).x.denominator > 1]
[Fraction(3, 4)]
)doc")
      .def(
          "rounded", [](const PlanarSum& self) { return take(without_gil([&] { return self.rounded(); })); },
          R"doc(The set rounded to doubles, as a Region. Raises Error: rounding_changed_topology, with the position.

>>> from dymsum import nfp, shapes
>>> nfp(shapes.rectangle(0, 0, 3, 2), shapes.rectangle(0, 0, 1, 1)).rounded().wkt
'POLYGON ((-1 -1,3 -1,3 2,-1 2,-1 -1))'
)doc")
      .def(
          "rounded_with_repair",
          [](const PlanarSum& self) { return take(without_gil([&] { return self.rounded_with_repair(); })); },
          "The same; vertices that collide are merged, rings that collapse dropped, and the report says how many.");
}

void bind_snap_rounding(nb::module_& m) {
  Record<Rounding>(m, "Rounding", "What became of an exact set in doubles.")
      .listed()
      .def("to_string", &Rounding::to_string);
  Record<SnapRounded>(m, "SnapRounded", "A set in doubles and what rounding did.")
      .field("region", &SnapRounded::region)
      .field("rounding", &SnapRounded::rounding);
  m.def(
      "snap_rounded", [](const PlanarSum& sum) { return take(without_gil([&] { return snap_rounded(sum); })); },
      "sum"_a,
      R"doc(The set of a sum in doubles: rounded() where that has an answer, else by snap rounding, which bends edges and
merges what collides, and reports how far that moved the set. Raises Error only past the double range.

>>> from dymsum import nfp, shapes, snap_rounded
>>> snap_rounded(nfp(shapes.rectangle(0, 0, 3, 2), shapes.rectangle(0, 0, 1, 1))).rounding.nearest
True
)doc");
}

void bind_planar_sum_class(nb::module_& m) {
  nb::class_<PlanarSum> sum(m, "PlanarSum", nb::dynamic_attr(),
                            R"doc(The exact sum of two regions. Equal sets compare equal.

>>> from dymsum import nfp, shapes
>>> sum = nfp(shapes.letter_u(4, 4, 1), shapes.rectangle(0, 0, 2, 1))
>>> sum.area_exact()
Fraction(30, 1)
>>> [(way.from_.at, way.to.at) for way in sum.tight_segments]
[(Point(x=1.0, y=1.0), Point(x=1.0, y=4.0))]
>>> sum.parts[0].outer.at.shape
(4, 2)
)doc");
  sum.def_ro("parts", &PlanarSum::parts, "The closure of the interior: SumPart by SumPart.")
      .def_ro("segments", &PlanarSum::segments, "One-dimensional pieces of the set.")
      .def_ro("points", &PlanarSum::points, "Isolated points of the set.")
      .def_ro("tight_segments", &PlanarSum::tight_segments,
              "Touching without overlap only exactly here: cracks in the open sum.")
      .def_ro("tight_points", &PlanarSum::tight_points, "The same: punctures of the open sum.")
      .def_ro("at_error", &PlanarSum::at_error, "|at - exact| is at most this in each coordinate.")
      .def_ro("stats", &PlanarSum::stats)
      .def_ro("trace", &PlanarSum::trace)
      .def(
          "__eq__", [](const PlanarSum& a, const PlanarSum& b) { return without_gil([&] { return a == b; }); },
          nb::is_operator(), "Same set and same tight features, exactly.")
      .def("__repr__", &repr_of)
      .def("__reduce__", [](nb::handle_t<PlanarSum> self) { return made_again(self); })
      .def(
          "to_json", [](const PlanarSum& self) { return sum_to_json(self); }, "As sum_to_json.")
      .def(
          "to_shapely",
          [](const PlanarSum& self) { return nb::cast(take(snap_rounded(self)).region).attr("to_shapely")(); },
          "The region of snap_rounded() as a shapely geometry (needs shapely 2).")
      .def_prop_ro("__geo_interface__", &geometry_of, "The region of snap_rounded() as a GeoJSON geometry.")
      .def("_repr_svg_", [](const PlanarSum& self) { return draw_section(self); });
  sum.attr("__hash__") = nb::none();
  bind_planar_numbers(sum);
}

void bind_writers(nb::module_& m) {
  Record<SumNames>(m, "SumNames", "What a picture calls operands and result.")
      .constructible()
      .field("p", &SumNames::p)
      .field("q", &SumNames::q)
      .field("sum", &SumNames::sum);
  m.def(
      "parse_sum",
      [](const std::string& text, const std::string& name_for_errors) {
        return remembered(take(without_gil([&] { return parse_sum(text, name_for_errors); })), "parse_sum", text,
                          name_for_errors);
      },
      "text"_a, "name_for_errors"_a = "text",
      R"doc(The exact set that to_json has written, as an operand. Raises Error: malformed; unsupported_operand; truncated.

>>> from dymsum import parse_sum, union_of
>>> sum = union_of([[(0, 0), (3, 0), (3, 1)], [(0, 1), (1, 0), (3, 1)]])
>>> parse_sum(sum.to_json()) == sum
True
)doc");
  m.def(
      "read_sum",
      [](const PathArgument& path) {
        PlanarSum sum = take(without_gil([&] { return read_sum(path.text); }));
        std::string own = sum_to_json(sum);
        return remembered(std::move(sum), "parse_sum", std::move(own), path.text);
      },
      "path"_a, "The same of a file. Raises Error: cannot_open; as parse_sum.");
  m.def(
      "begins_like_sum", [](const std::string& text) { return begins_like_sum(text); }, "text"_a,
      "Whether a text begins as what to_json writes.");
  m.def(
      "names_sum", [](const PathArgument& path) { return names_sum(path.text); }, "path"_a,
      "Whether a path ends in .json or .json.gz and names a file that begins so.");
  m.def(
      "format_sum",
      [](const PlanarSum& sum, const RegionArgument& rounded, RegionFormat format) {
        return content_of(format_sum(sum, *rounded, format), format);
      },
      "sum"_a, "rounded"_a, "format"_a, "The sum with its tight features as text of a format; in gpkg as bytes.");
  m.def(
      "draw_sum",
      [](const RegionArgument& p, const RegionArgument& q, const PlanarSum& sum, const SumNames& names) {
        return draw_sum(*p, *q, sum, names);
      },
      "p"_a, "q"_a, "sum"_a, "names"_a = SumNames(), "P, Q and the sum with tight features, as SVG text.");
  m.def("draw_section", &draw_section, "sum"_a, "touching"_a = std::vector<SumPart>(), "A set alone, as SVG text.");
  m.def(
      "draw_trace",
      [](const RegionArgument& p, const RegionArgument& q, const PlanarSum& sum) { return draw_trace(*p, *q, sum); },
      "p"_a, "q"_a, "sum"_a, "The stages side by side, as SVG text; of a sum with a trace.");
  m.def("sum_to_json", &sum_to_json, "sum"_a, "Rings with rounded and exact coordinates and provenance, as JSON text.");
  m.def(
      "area_text", [](const PlanarSum& sum) { return area_text(sum); }, "sum"_a);
}

}  // namespace

void bind_planar_sum(nb::module_& m) {
  bind_sum_options(m);
  bind_contact(m);
  bind_planar_parts(m);
  bind_stats(m);
  bind_planar_trace(m);
  bind_planar_sum_class(m);
  bind_snap_rounding(m);
  bind_writers(m);
}

}  // namespace dymsum::python
