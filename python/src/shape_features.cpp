// What a growing disc sees of a region, and pieces cut at its pockets.
#include "dymsum/shape_features.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/decomposition.h"
#include "enumeration.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_feature_options(nb::module_& m) {
  enumeration<Concavity>(
      m, "Concavity", "How deep a vertex lies in the pocket of a bridge.",
      {"its distance to the line of the bridge", "the length of the shortest path to the bridge in the pocket",
       "shortest_path where the pocket runs backwards, else straight_line",
       "straight_line where that exceeds hybrid_tolerance, else shortest_path"});
  Record<FeatureOptions> options(m, "FeatureOptions", "Options of ShapeFeatures.");
  options.def(
      "__init__",
      [](FeatureOptions* self, Concavity concavity, double hybrid_tolerance, int threads, Progress progress) {
        new (self) FeatureOptions{concavity, hybrid_tolerance, threads, std::move(progress)};
      },
      "concavity"_a = Concavity::straight_line, "hybrid_tolerance"_a = 0.0, "threads"_a = 0, "progress"_a = nb::none());
  options.option("concavity", &FeatureOptions::concavity)
      .option("hybrid_tolerance", &FeatureOptions::hybrid_tolerance, "of hybrid2, in the unit of the coordinates")
      .option("threads", &FeatureOptions::threads, "0: as many as there are cores")
      .option("progress", &FeatureOptions::progress, "called with the stage and its share in [0, 1]; False stops");
}

void bind_feature_bar(nb::module_& m) {
  Record<FeatureBar> bar(m, "FeatureBar", "The life of a corner of the sum with a growing disc, from birth to death.");
  enumeration<FeatureBar::Birth>(
      bar, "Birth", "Where a bar begins.",
      {"at diameter 0, at a reflex vertex of the region", "one of two, between places opposite each other"});
  enumeration<FeatureBar::Death>(
      bar, "Death", "Why a bar ends.",
      {"into another bar, `parent`", "the pocket or hole is full", "it goes on to an edge of the convex hull"});
  bar.listed();
}

void bind_alpha_bridge(nb::module_& m) {
  Record<BridgeContact>(m, "BridgeContact", "Where a disc touches the region.").listed();
  Record<AlphaBridge>(m, "AlphaBridge", "The segment between the two contacts of a disc, the pocket on its left.")
      .listed();
}

ShapeFeatures features_of(const RegionArgument& region, const FeatureOptions& options) {
  return run_with(options, [&](const FeatureOptions& own) { return ShapeFeatures::create(*region, own); });
}

void require_event(const ShapeFeatures& features, std::uint32_t event) {
  if (event >= features.event_count()) throw nb::index_error("no such event");
}

nb::object picture_of(const char* maker, nb::handle of) {
  return nb::module_::import_("dymsum._shape_pictures").attr(maker)(of);
}

void bind_feature_questions(nb::class_<ShapeFeatures>& type) {
  constexpr auto here = nb::rv_policy::reference_internal;
  type.def("region", &ShapeFeatures::region, here)
      .def("options", &ShapeFeatures::options, here)
      .def("bars", &ShapeFeatures::bars, here, "In the order of their births: a new list, O(bars).")
      .def("event_count", &ShapeFeatures::event_count)
      .def(
          "event_alpha",
          [](const ShapeFeatures& self, std::uint32_t event) {
            require_event(self, event);
            return self.event_alpha(event);
          },
          "event"_a, "The diameter of an event, the nearest double.")
      .def(
          "event_text",
          [](const ShapeFeatures& self, std::uint32_t event) {
            require_event(self, event);
            return without_gil([&] { return self.event_text(event); });
          },
          "event"_a, "The diameter as a formula of integers, + - * / and sqrt().")
      .def(
          "bridges",
          [](const ShapeFeatures& self, const Rational& alpha) {
            return take(without_gil([&] { return self.bridges(alpha); }));
          },
          "alpha"_a,
          "The bridges of discs of diameter `alpha`, at an event those that end there, or go on, and those that are "
          "born there. Those of diameter 0 are the reflex vertices; above all events, the edges of the convex hull "
          "that "
          "are not in the boundary. Raises Error: out_of_range for a negative diameter.")
      .def(
          "lasting",
          [](const ShapeFeatures& self, const Rational& life, const Rational& from, const std::optional<Rational>& to) {
            return without_gil([&] { return self.lasting(life, from, to); });
          },
          "life"_a, "from_"_a = 0, "to"_a = nb::none(),
          "Indices of the bars that last at least `life` between the diameters `from_` and `to` (None: infinity), the "
          "longest first; of equally long ones the deeper first, then the earlier. Decided exactly.")
      .def(
          "significant",
          [](const ShapeFeatures& self, const Rational& significance, const Rational& from,
             const std::optional<Rational>& to) {
            return without_gil([&] { return self.significant(significance, from, to); });
          },
          "significance"_a, "from_"_a = 0, "to"_a = nb::none(),
          "As lasting(), but by significance: the lesser of how deep a pocket is and how long it lasts, counted from "
          "the "
          "bar's `counts_from`, so that a dent takes nothing from a deep pocket that it meets. Gaps count with their "
          "lives.");
}

void bind_shape_features_class(nb::module_& m) {
  nb::class_<ShapeFeatures> type(
      m, "ShapeFeatures",
      R"doc(What a growing disc sees of a region: bridges and pockets, and how long they last.

Births, deaths and their order are exact; diameters are in the unit of the coordinates. Made without the GIL. May be
shared by threads.

>>> from dymsum import ShapeFeatures, shapes
>>> features = ShapeFeatures(shapes.letter_l(3, 3, 1))
>>> bar, = features.bars()
>>> bar.born, bar.died, bar.minimum
(Birth.corner, Death.never, 3)
>>> [(bridge.from_.at, bridge.to.at) for bridge in features.bridges(1000)]
[(Point(x=3.0, y=1.0), Point(x=1.0, y=3.0))]
>>> features.lasting(100), features.significant(100), features.significant(1)
([0], [], [0])
)doc");
  type.def(
          "__init__",
          [](ShapeFeatures* self, const RegionArgument& region, const FeatureOptions& options) {
            new (self) ShapeFeatures(features_of(region, options));
          },
          "region"_a, "options"_a = FeatureOptions(),
          "Raises Error: unsupported_operand where polylines cross or run along each other, or the region is empty; "
          "out_of_range for coordinates beyond 2^1000 and a tolerance that is negative or no number; cancelled where "
          "the "
          "options' progress stops it.")
      .def_static("create", &features_of, "region"_a, "options"_a = FeatureOptions())
      .def("__repr__",
           [](const ShapeFeatures& self) {
             return "<ShapeFeatures: " + std::to_string(self.bars().size()) + " bars, " +
                    std::to_string(self.event_count()) + " events>";
           })
      .def("__reduce__",
           [](nb::handle_t<ShapeFeatures> self) {
             const auto* own = nb::inst_ptr<ShapeFeatures>(self);
             return nb::make_tuple(self.type(), nb::make_tuple(own->region(), own->options()));
           })
      .def("_repr_svg_", [](nb::handle_t<ShapeFeatures> self) { return picture_of("bars_svg", self); });
  bind_feature_questions(type);
}

void bind_cuts(nb::module_& m) {
  Record<DecomposeOptions> options(m, "DecomposeOptions", "Options of decompose; diameters and lives are exact.");
  options.def(
      "__init__",
      [](DecomposeOptions* self, const Rational& persistence, const Rational& from, const std::optional<Rational>& to,
         Progress progress) {
        new (self) DecomposeOptions{persistence, from, to, std::move(progress)};
      },
      "persistence"_a = 0, "alpha_from"_a = 0, "alpha_to"_a = nb::none(), "progress"_a = nb::none());
  options.option("persistence", &DecomposeOptions::persistence, "bars that last at least this long are cut at; 0: all")
      .option("alpha_from", &DecomposeOptions::alpha_from, "lives are counted between these diameters")
      .option("alpha_to", &DecomposeOptions::alpha_to, "None: infinity")
      .option("progress", &DecomposeOptions::progress);
  Record<Cut> cut(m, "Cut", "A segment from a reflex vertex to the boundary or to an earlier cut of the same part.");
  enumeration<Cut::End>(cut, "End", "What a cut ends at.");
  cut.listed();
}

/// One of the pieces, rounded.
nb::object shapely_piece(const Region& piece) { return nb::cast(piece).attr("to_shapely")(); }

void bind_pieces(nb::module_& m) {
  Record<Piece>(m, "Piece", "A connected piece with exact vertices: outer ring counter-clockwise, holes clockwise.")
      .listed()
      .def(
          "to_shapely",
          [](const Piece& self) {
            return shapely_piece(take(rounded(Decomposition{{}, {self}})).front());
          },
          "The piece rounded to doubles as a shapely polygon (needs shapely 2). Raises Error: "
          "rounding_changed_topology.");
  Record<Decomposition>(m, "Decomposition", "Cuts, and the pieces between them.")
      .listed()
      .def(
          "to_shapely",
          [](const Decomposition& self) {
            nb::list polygons;
            for (const Region& piece : take(without_gil([&] { return rounded(self); }))) {
              polygons.append(shapely_piece(piece));
            }
            return polygons;
          },
          nb::sig("def to_shapely(self) -> list[typing.Any]"),
          "rounded() as a list of shapely polygons (needs shapely 2).")
      .def("_repr_svg_", [](nb::handle_t<Decomposition> self) { return picture_of("pieces_svg", self); });
}

void bind_decompose(nb::module_& m) {
  m.def(
      "decompose",
      [](const ShapeFeatures& features, const DecomposeOptions& options) {
        return run_with(options, [&](const DecomposeOptions& own) { return decompose(features, own); });
      },
      "features"_a, "options"_a = DecomposeOptions(),
      R"doc(Cuts at the pocket minima of lasting bars, the longest first: nearly convex pieces, with exact vertices.

A cut ends at a vertex or at the exact foot of a perpendicular, and separates two pieces: one that alone opens a hole gets
a partner. With a larger persistence the cuts are the first ones of
those with a smaller. Raises Error: unsupported_operand for a region with polylines or points, or whose rings touch;
out_of_range for a negative persistence and alpha_to < alpha_from; cancelled.

>>> from dymsum import ShapeFeatures, decompose, shapes, twice_area
>>> made = decompose(ShapeFeatures(shapes.letter_l(3, 3, 1)))
>>> [twice_area(piece.outer) / 2 for piece in made.pieces]
[Fraction(3, 1), Fraction(2, 1)]
)doc");
  m.def(
      "piece_colours",
      [](const Decomposition& decomposition) { return without_gil([&] { return piece_colours(decomposition); }); },
      "decomposition"_a,
      "A number for each piece from 0 on, for pictures: pieces with an edge in common have different ones. Those of "
      "decompose get at most six numbers.");
  m.def(
      "twice_area", [](const RationalRing& ring) { return twice_area(ring); }, "ring"_a,
      "Twice the exact area of a ring of points, positive counter-clockwise.");
  m.def(
      "rounded",
      [](const Decomposition& decomposition) { return take(without_gil([&] { return rounded(decomposition); })); },
      "decomposition"_a,
      "The pieces with every coordinate rounded to the nearest double. Raises Error: rounding_changed_topology where a "
      "piece is no valid region then.");
  m.def(
      "rounded_with_repair",
      [](const Decomposition& decomposition) {
        return take(without_gil([&] { return rounded_with_repair(decomposition); }));
      },
      "decomposition"_a,
      "As rounded(), but of a piece that is no valid region then colliding vertices are merged, and rings that "
      "collapse "
      "are dropped; its region may be empty. The reports say what was done. Raises Error: rounding_changed_topology "
      "where edges of a piece cross.");
}

}  // namespace

void bind_shape_features(nb::module_& m) {
  bind_feature_options(m);
  bind_feature_bar(m);
  bind_alpha_bridge(m);
  bind_shape_features_class(m);
  bind_cuts(m);
  bind_pieces(m);
  bind_decompose(m);
}

}  // namespace dymsum::python
