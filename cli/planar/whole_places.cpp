#include "planar/whole_places.h"

#include <cmath>
#include <optional>
#include <utility>

namespace dymsum::cli {
namespace {

std::optional<double> double_of(const Rational& v) {
  const double nearest = v.to_double();
  const Result<Rational> back = Rational::of(nearest);
  return back && *back == v ? std::optional(nearest) : std::nullopt;
}

/// Nothing where a coordinate is no double then.
std::optional<Region> enlarged(const Region& region, const Rational& times) {
  RegionData data = region.data();
  bool all = true;
  const auto grow = [&](std::vector<Point>& points) {
    for (Point& p : points)
      for (double* c : {&p.x, &p.y}) {
        const std::optional<double> v = double_of(Rational::of(*c).value() * times);
        all = all && v;
        *c = v.value_or(0);
      }
  };
  for (Part& part : data.parts) {
    grow(part.outer);
    for (Ring& hole : part.holes) grow(hole);
  }
  for (Polyline& line : data.polylines) grow(line);
  grow(data.points);
  if (!all) return std::nullopt;
  return require(Region::create(std::move(data)));
}

}  // namespace

Rational times_for(const std::vector<RationalPoint>& positions) {
  Rational times = 1;
  for (const RationalPoint& position : positions)
    for (const Rational* c : {&position.x, &position.y}) {
      Rational odd = require(Rational::parse((*c * times).denominator()));
      for (Rational half = odd / 2; half.is_integer(); half = odd / 2) odd = half;
      times *= odd;
    }
  for (const RationalPoint& position : positions)
    for (const Rational* c : {&position.x, &position.y})
      if (!double_of(*c * times))
        throw Stop(kBadInput, "a place: " + c->to_string() + " times " + times.numerator() +
                                  ", the common denominator of all places, is no double");
  return times;
}

void enlarge(ObstacleSource& source, const Rational& times) {
  if (times == Rational(1)) return;
  source.read.reset();
  for (Input& input : source.inputs) {
    std::optional<Region> larger = enlarged(input.region, times);
    if (!larger)
      throw Stop(kBadInput, input.file + ": a coordinate times " + times.numerator() +
                                ", the common denominator of the places that are given in fractions, is no double");
    input.region = *std::move(larger);
  }
}

Point enlarged(const RationalPoint& position, const Rational& times) {
  return {(position.x * times).to_double(), (position.y * times).to_double()};
}

}  // namespace dymsum::cli
