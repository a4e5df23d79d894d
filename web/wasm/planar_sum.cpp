// PlanarSum and the functions that make one.
#include "dymsum/planar_sum.h"

#include "arrays.h"
#include "dymsum/area_text.h"
#include "dymsum/cspace_obstacle.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/region_io.h"
#include "dymsum/snap_rounding.h"
#include "options.h"
#include "plain.h"
#include "planar_operand.h"
#include "planar_shape.h"
#include "region.h"

namespace dymsum::web {
namespace {

using emscripten::function;
using SharedSum = std::shared_ptr<PlanarSum>;

val stats_of(const PlanarSum& sum) { return plain(sum.stats); }

val loops(const std::vector<Ring>& rings) {
  std::vector<double> vertices;
  std::vector<std::uint32_t> starts{0};
  for (const Ring& ring : rings) {
    for (const Point at : ring) add(vertices, at);
    starts.push_back(static_cast<std::uint32_t>(vertices.size() / 2));
  }
  val v = val::object();
  v.set("vertices", array_of(vertices));
  v.set("starts", array_of(starts));
  return v;
}

val points_array(const std::vector<Point>& points) {
  std::vector<double> numbers;
  for (const Point at : points) add(numbers, at);
  return array_of(numbers);
}

val trace_of(const PlanarSum& sum) {
  if (!sum.trace) return val::null();
  const PlanarTrace& trace = *sum.trace;
  std::vector<Point> convolution, cells, tight;
  std::vector<std::uint8_t> of_p;
  for (const PlanarTrace::Segment& s : trace.convolution) {
    convolution.insert(convolution.end(), {s.from, s.to});
    of_p.push_back(s.edge_of_p ? 1 : 0);
  }
  for (const PlanarTrace::Cell& cell : trace.masked_cells) cells.insert(cells.end(), {cell.low, cell.high});
  for (const auto& segment : trace.tight_segments) tight.insert(tight.end(), segment.begin(), segment.end());
  val v = val::object();
  v.set("convolution", points_array(convolution));
  v.set("convolutionEdgeOfP", array_of(of_p));
  v.set("maskedCells", points_array(cells));
  v.set("crossings", points_array(trace.crossings));
  v.set("keptLoops", loops(trace.kept_loops));
  v.set("droppedLoops", loops(trace.dropped_loops));
  v.set("tightPoints", points_array(trace.tight_points));
  v.set("tightSegments", points_array(tight));
  return v;
}

val area_exact_of(const PlanarSum& sum, const val& bits) {
  const auto area = sum.area_exact_within(bits_in(bits));
  return area ? val(area->to_string()) : val::null();
}

std::shared_ptr<Region> rounded_of(const PlanarSum& sum, const val& options) {
  return shared(member_or(options, "repair", false) ? got(sum.rounded_with_repair()).region : got(sum.rounded()));
}

val snap_rounded_of(const PlanarSum& sum) {
  SnapRounded made = got(snap_rounded(sum));
  val v = val::object();
  v.set("region", shared(std::move(made.region)));
  v.set("rounding", plain(made.rounding));
  return v;
}

val shape_of(const PlanarSum& sum) { return sum_shape(sum); }
double area_of(const PlanarSum& sum) { return sum.area(); }
std::string area_text_of(const PlanarSum& sum) { return area_text(sum); }
val exact_of(const PlanarSum& sum, double vertex) { return plain(sum.exact(vertex_at(sum, index_in(vertex)))); }
bool equal(const PlanarSum& a, const PlanarSum& b) { return a == b; }
std::string formatted(const PlanarSum& sum, const std::string& format) {
  return format_sum(sum, got(snap_rounded(sum)).region, region_format_in(format));
}
std::string json_of(const PlanarSum& sum) { return sum_to_json(sum); }

SharedSum rotated(const Region& p, const Region& q, const val& angle, const val& options) {
  return shared(got(rotated_sum(p, q, orientation_in(angle), sum_options(options))));
}
SharedSum slice_at(const Region& robot, const Region& obstacle, const val& angle, const val& options) {
  return shared(got(cspace_slice(robot, obstacle, orientation_in(angle), sum_options(options))));
}
SharedSum union_of_regions(const val& regions, const val& options) {
  std::vector<Region> all;
  const auto n = regions["length"].as<unsigned>();
  for (unsigned k = 0; k < n; ++k) all.push_back(*regions[k].as<std::shared_ptr<Region>>());
  return shared(got(union_of(all, sum_options(options))));
}
bool set_contains(const val& p, const val& q, const val& z, const val& semantics) {
  return contains(TakenOperand(p), TakenOperand(q), point_in(z), semantics_in(semantics));
}
val sizes(const Region& p, const Region& q) { return plain(convolution_sizes(p, q)); }
std::string drawn_sum(const Region& p, const Region& q, const PlanarSum& sum, const val& given) {
  const SumNames usual;
  return draw_sum(
      p, q, sum,
      SumNames{member_or(given, "p", usual.p), member_or(given, "q", usual.q), member_or(given, "sum", usual.sum)});
}
std::string drawn_trace(const Region& p, const Region& q, const PlanarSum& sum) { return draw_trace(p, q, sum); }

double vertex_count(const PlanarSum& sum) { return static_cast<double>(sum.vertex_count()); }
double hole_count(const PlanarSum& sum) { return static_cast<double>(sum.hole_count()); }
double part_count(const PlanarSum& sum) { return static_cast<double>(sum.parts.size()); }

EMSCRIPTEN_BINDINGS(planar_sum) {
  handle<PlanarSum>("PlanarSum")
      .property("vertexCount", &vertex_count)
      .property("holeCount", &hole_count)
      .property("partCount", &part_count)
      .function("shape", guarded<&shape_of>)
      .function("stats", guarded<&stats_of>)
      .function("trace", guarded<&trace_of>)
      .function("area", guarded<&area_of>)
      .function("areaText", guarded<&area_text_of>)
      .function("areaExact", guarded<&area_exact_of>)
      .function("exact", guarded<&exact_of>)
      .function("rounded", guarded<&rounded_of>)
      .function("snapRounded", guarded<&snap_rounded_of>)
      .function("equals", guarded<&equal>)
      .function("format", guarded<&formatted>)
      .function("toJson", guarded<&json_of>);
  function("sumOfSets", guarded<&of_sets<&minkowski_sum>>);
  function("nfp", guarded<&of_sets<&nfp>>);
  function("erode", guarded<&of_sets<&erode>>);
  function("rotatedSum", guarded<&rotated>);
  function("cspaceSlice", guarded<&slice_at>);
  function("unionOf", guarded<&union_of_regions>);
  function("setContains", guarded<&set_contains>);
  function("convolutionSizes", guarded<&sizes>);
  function("drawSum", guarded<&drawn_sum>);
  function("drawTrace", guarded<&drawn_trace>);
}

}  // namespace
}  // namespace dymsum::web
