#include "planar/excess.h"

#include <cmath>
#include <ostream>
#include <sstream>

#include "inputs.h"
#include "report.h"
#include "solid/solid_json.h"

namespace dymsum::cli {

Json distance_json(double distance) { return std::isfinite(distance) ? Json(distance) : Json("inf"); }

namespace {

Json position_json(const RationalPoint& p) { return {p.x.to_double(), p.y.to_double()}; }
Json position_json(const RationalPoint3& p) { return {p.x.to_double(), p.y.to_double(), p.z.to_double()}; }
Json exact_json(const RationalPoint& p) { return {p.x.to_string(), p.y.to_string()}; }
Json exact_json(const RationalPoint3& p) { return {p.x.to_string(), p.y.to_string(), p.z.to_string()}; }

template <class Excess>
Json with_distances(Json json, const Excess& excess) {
  const bool finite = excess.distance > 0 && std::isfinite(excess.distance);
  json["distance"] = distance_json(excess.distance);
  json["at_most"] = distance_json(excess.at_most);
  json["squared_exact"] = finite ? Json(excess.squared.to_string()) : Json();
  json["at"] = excess.distance > 0 ? position_json(excess.at) : Json();
  json["at_exact"] = excess.distance > 0 ? exact_json(excess.at) : Json();
  json["nearest"] = finite ? position_json(excess.nearest) : Json();
  return json;
}

}  // namespace

Json excess_json(const PlanarExcess& excess, bool exact) {
  const Json size = size_json(excess.set, exact);
  return with_distances(
      {{"parts", excess.set.parts.size()}, {"area", size["area"]}, {"area_exact", size["area_exact"]}}, excess);
}

Json excess_json(const SolidExcess& excess, bool exact) {
  const Json size = solid_sum_json(excess.set, exact);
  return with_distances(
      {{"shells", excess.set.shells}, {"volume", size["volume"]}, {"volume_exact", size["volume_exact"]}}, excess);
}

std::string shown_distance(double distance, double at_most, bool exact) {
  std::ostringstream text;
  text.precision(9);
  if (!std::isfinite(distance)) return "infinitely far";
  if (exact || at_most <= distance * (1 + 1e-9)) text << distance;
  else text << "between " << distance << " and " << at_most;
  return text.str();
}

void print_excess(std::ostream& out, const PlanarExcess& excess, const std::string& what, const std::string& there) {
  if (!(excess.distance > 0)) return;
  std::ostringstream text;
  text.precision(9);
  text << "  " << what << ": area " << excess.set.area() << " in " << counted(excess.set.parts.size(), "part");
  text << ", up to " << shown_distance(excess.distance, excess.at_most, excess.exact) << " from " << there << ", at ("
       << excess.at.x.to_double() << ", " << excess.at.y.to_double() << ")\n";
  out << text.str();
}

void print_excess(std::ostream& out, const SolidExcess& excess, const std::string& what, const std::string& there) {
  if (!(excess.distance > 0)) return;
  std::ostringstream text;
  text.precision(9);
  text << "  " << what << ": volume " << excess.set.volume() << " in " << counted(excess.set.shells, "shell")
       << ", up to " << shown_distance(excess.distance, excess.at_most, excess.exact) << " from " << there << ", at ("
       << excess.at.x.to_double() << ", " << excess.at.y.to_double() << ", " << excess.at.z.to_double() << ")\n";
  out << text.str();
}

ExitCode exit_code_of(CheckVerdict verdict) {
  return verdict == CheckVerdict::right ? kDone : verdict == CheckVerdict::wrong ? kNo : kUndecided;
}

Rational read_tolerance(const std::string& text, const std::string& option) {
  Rational value = require_option(Rational::parse(text), option);
  if (value.sign() < 0) throw Stop(kUsage, option + " wants a number of at least 0, not '" + text + "'");
  return value;
}

}  // namespace dymsum::cli
