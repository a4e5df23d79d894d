#include "cspace/slices.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "dymsum/cspace_obstacle.h"
#include "versus/cgal.h"

namespace dymsum::bench {
namespace {

constexpr int kSlices = 360, kFine = 3600, kSample = 36;
constexpr double kFineLimitMs = 20e3, kCgalLimitMs = 30e3;
/// CGAL's area of a larger sum is added up in doubles, so ours is compared in doubles as well.
constexpr std::size_t kExactAreaVertices = 1500;
/// How often CGAL's vertical decomposition is queried a pair, and for how long each time.
constexpr std::size_t kWitnesses = 3;
constexpr double kWitnessSeconds = 5;

Orientation orientation(int k, int of) { return Orientation::nearest(2 * std::numbers::pi * k / of, 1e-6).value(); }

double static_ms(const TurningPair& pair, int slices) {
  double ms = 0;
  for (int k = 0; k < slices; ++k) {
    const Orientation theta = orientation(k, slices);
    const double start = cpu_ms();
    const PlanarSum slice = cspace_slice(pair.robot, pair.obstacle, theta).value();
    ms += cpu_ms() - start;
  }
  return ms;
}

/// What both sides are compared by.
struct Described {
  std::size_t vertices = 0, holes = 0, parts = 0;
  double area = 0;
  std::string exact;  ///< empty for large sums
};

Described described(const PlanarSum& sum) {
  Described d{sum.vertex_count(), sum.hole_count(), sum.parts.size(), 0, {}};
  const Rational area = sum.area_exact();
  d.area = area.to_double();
  if (d.vertices <= kExactAreaVertices) d.exact = area.to_string();
  return d;
}

bool same_area(const Described& ours, const RivalAnswer& theirs) {
  if (!ours.exact.empty() && !theirs.area_exact.empty()) return ours.exact == theirs.area_exact;
  return std::abs(ours.area - theirs.area) <= 1e-12 * std::abs(ours.area);
}

bool same(const Described& ours, const RivalAnswer& theirs) {
  return theirs.finished && ours.parts == theirs.outer && ours.vertices == theirs.vertices &&
         ours.holes == theirs.holes && same_area(ours, theirs);
}

std::string difference(int degrees, const Described& ours, const RivalAnswer& theirs) {
  std::ostringstream text;
  text.precision(15);
  text << degrees << " degrees: ours " << ours.vertices << " vertices, " << ours.holes << " holes, area " << ours.area
       << "; CGAL " << theirs.vertices << ", " << theirs.holes << ", " << theirs.area;
  return text.str();
}

void compare(int degrees, const Described& ours, const RivalAnswer& theirs, const CgalOperands& operands,
             SlicesRow& row) {
  ++row.compared;
  row.exact_areas += !ours.exact.empty() && !theirs.area_exact.empty();
  row.vertices_differ += ours.vertices != theirs.vertices;
  row.holes_differ += ours.holes != theirs.holes;
  row.area_differs += !same_area(ours, theirs);
  if (same(ours, theirs)) return;
  ++row.any_differs;
  if (row.queried == kWitnesses) return;
  ++row.queried;
  const RivalAnswer witness = operands.sum_in_child(CgalMethod::vertical_decomposition, Repeats{}, kWitnessSeconds);
  const bool agrees = same(ours, witness);
  row.confirmed += agrees;
  row.remarks.push_back(difference(degrees, ours, theirs) + "; its vertical decomposition " +
                        (agrees             ? "says what we say"
                         : witness.finished ? "says neither"
                                            : witness.why_not));
}

/// CGAL's slice at some degrees, compared with ours; the time of the sum alone.
double cgal_slice(const TurningPair& pair, int degrees, SlicesRow& row) {
  const Orientation theta = orientation(degrees, kSlices);
  const CgalOperands operands(pair.obstacle.data(), pair.robot.data(), theta);
  const RivalAnswer theirs = operands.sum(CgalMethod::reduced_convolution, Repeats{});
  if (!theirs.finished) {
    ++row.unfinished;
    row.remarks.push_back(std::to_string(degrees) + " degrees: CGAL " + theirs.why_not);
    return 0;
  }
  compare(degrees, described(cspace_slice(pair.robot, pair.obstacle, theta).value()), theirs, operands, row);
  return theirs.median_ms;
}

void measure_cgal(const TurningPair& pair, SlicesRow& row) {
  constexpr int kStep = kSlices / kSample;
  double ms = 0;
  for (int k = 0; k < kSlices; k += kStep) ms += cgal_slice(pair, k, row);
  row.cgal_measured = kSample;
  row.cgal_ms = kStep * ms;
  if (row.cgal_ms > kCgalLimitMs) return;
  for (int k = 0; k < kSlices; ++k)
    if (k % kStep != 0) ms += cgal_slice(pair, k, row);
  row.cgal_measured = kSlices;
  row.cgal_ms = ms;
}

}  // namespace

SlicesRow measure_slices(const TurningPair& pair) {
  SlicesRow row;
  row.name = pair.name;
  row.ours_ms = static_ms(pair, kSlices);
  row.fine_measured = row.ours_ms * (kFine / kSlices) < kFineLimitMs;
  row.fine_ms = row.fine_measured ? static_ms(pair, kFine) : row.ours_ms * (kFine / kSlices);
  measure_cgal(pair, row);
  return row;
}

}  // namespace dymsum::bench
