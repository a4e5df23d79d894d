// ShapeFeatures and pieces.
#include "dymsum/shape_features.h"

#include "arrays.h"
#include "dymsum/decomposition.h"
#include "options.h"
#include "plain.h"
#include "region.h"

namespace dymsum::web {
namespace {

std::shared_ptr<ShapeFeatures> created(const Region& region, const val& options) {
  FeatureOptions how;
  how.concavity = enumerator(member(options, "concavity"), Concavity::straight_line);
  how.hybrid_tolerance = member_or(options, "hybridTolerance", 0.0);
  how.threads = 1;
  how.progress = progress_in(member(options, "progress"));
  return shared(got(ShapeFeatures::create(region, how)));
}

val bridge_end(const BridgeContact& contact) {
  val v = plain(contact.at);
  v.set("atVertex", contact.at_vertex);
  v.set("index", contact.index);
  return v;
}

val bridge_data(const AlphaBridge& bridge) {
  val v = plain(bridge);
  v.set("from", bridge_end(bridge.from));
  v.set("to", bridge_end(bridge.to));
  return v;
}

val bars_of(const ShapeFeatures& features) { return plain(features.bars()); }
double alpha_of(const ShapeFeatures& features, double event) { return features.event_alpha(index_in(event)); }
std::string text_of(const ShapeFeatures& features, double event) { return features.event_text(index_in(event)); }
val bridges_of(const ShapeFeatures& features, const val& alpha) {
  return list_of(got(features.bridges(rational_in(alpha))), bridge_data);
}
Rational rational_or_0(const val& v) { return is_none(v) ? Rational() : rational_in(v); }
val lasting_of(const ShapeFeatures& features, const val& life, const val& from, const val& to) {
  return array_of(features.lasting(rational_in(life), rational_or_0(from), optional_rational(to)));
}
val significant_of(const ShapeFeatures& features, const val& significance, const val& from, const val& to) {
  return array_of(features.significant(rational_in(significance), rational_or_0(from), optional_rational(to)));
}

Point approx(const RationalPoint& at) { return {at.x.to_double(), at.y.to_double()}; }

val cut_data(const Cut& cut) {
  val v = val::object();
  v.set("vertex", cut.vertex);
  v.set("end", plain(cut.end));
  v.set("index", cut.index);
  v.set("from", plain(approx(cut.from)));
  v.set("to", plain(approx(cut.to)));
  v.set("exactFrom", plain(cut.from));
  v.set("exactTo", plain(cut.to));
  v.set("bar", cut.bar);
  v.set("partner", cut.partner);
  std::vector<double> runs;
  for (const RationalSegment& run : cut.runs)
    for (const RationalPoint& end : run) add(runs, approx(end));
  v.set("runs", array_of(runs));
  return v;
}

Ring approx(const RationalRing& ring) {
  Ring made;
  for (const RationalPoint& at : ring) made.push_back(approx(at));
  return made;
}

val decomposed(const ShapeFeatures& features, const val& options) {
  DecomposeOptions how;
  how.persistence = rational_or_0(member(options, "persistence"));
  how.alpha_from = rational_or_0(member(options, "alphaFrom"));
  how.alpha_to = optional_rational(member(options, "alphaTo"));
  how.progress = progress_in(member(options, "progress"));
  const Decomposition made = got(decompose(features, how));
  RegionData pieces;
  std::vector<double> areas;
  for (const Piece& piece : made.pieces) {
    Part& part = pieces.parts.emplace_back();
    part.outer = approx(piece.outer);
    Rational twice = twice_area(piece.outer);
    for (const RationalRing& hole : piece.holes) {
      part.holes.push_back(approx(hole));
      twice += twice_area(hole);
    }
    areas.push_back(twice.to_double() / 2);
  }
  val v = val::object();
  v.set("cuts", list_of(made.cuts, cut_data));
  v.set("pieces", region_shape(pieces));
  v.set("colours", plain(piece_colours(made)));
  v.set("areas", plain(areas));
  return v;
}

double event_count(const ShapeFeatures& features) { return features.event_count(); }

EMSCRIPTEN_BINDINGS(shape_features) {
  handle<ShapeFeatures>("ShapeFeatures")
      .class_function("create", guarded<&created>)
      .property("eventCount", &event_count)
      .function("bars", guarded<&bars_of>)
      .function("eventAlpha", guarded<&alpha_of>)
      .function("eventText", guarded<&text_of>)
      .function("bridges", guarded<&bridges_of>)
      .function("lasting", guarded<&lasting_of>)
      .function("significant", guarded<&significant_of>)
      .function("decompose", guarded<&decomposed>);
}

}  // namespace
}  // namespace dymsum::web
