#include "report.h"

#include <ostream>
#include <sstream>

namespace dymsum::cli {
namespace {

Json stages_json(const SumStats& stats) {
  Json stages = Json::object();
  for (const SumStats::Stage& stage : stats.stages) {
    const std::string name(stage.name);
    stages[name] = stages.value(name, 0.0) + stage.ms;
  }
  return stages;
}

Json work_json(const SumStats& stats) {
  return {{"live_segments", stats.live_segments},
          {"cell_entries", stats.cell_entries},
          {"pair_tests", stats.pair_tests},
          {"degenerate_nodes", stats.degenerate_nodes},
          {"loops", stats.loops},
          {"collision_tests", stats.collision_tests},
          {"filtered_signs", stats.filtered_signs},
          {"exact_signs", stats.exact_signs},
          {"mask_grid", stats.mask_grid},
          {"peak_bytes", stats.peak_bytes}};
}

std::string milliseconds(double ms) {
  std::ostringstream text;
  text.precision(ms < 100 ? 3 : 6);
  text << ms << " ms";
  return text.str();
}

}  // namespace

std::string tier_name(int bits) { return bits == 0 ? "arbitrary precision" : std::to_string(bits) + "-bit"; }

std::string shown(const Rational& value) { return value.den == "1" ? value.num : value.to_string(); }

std::string counted(std::size_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many.empty() ? one + "s" : many);
}

Json inputs_json(const std::vector<Input>& inputs) {
  Json list = Json::array();
  for (const Input& input : inputs) {
    list.push_back({{"file", input.file},
                    {"vertices", input.region.vertex_count()},
                    {"holes", input.region.hole_count()},
                    {"parts", input.region.parts().size()}});
  }
  return list;
}

Json orientation_json(const Orientation& orientation) {
  const std::string tangent = orientation.is_half_turn() ? "inf" : orientation.tan_half().to_string();
  return {{"tan_half", tangent}, {"theta", orientation.radians()}};
}

Json sum_json(const SumReport& report) {
  const PlanarSum& sum = *report.sum;
  Json json =
      report_head(report.verb, inputs_json(report.inputs), sum.stats.tier_bits, report.timing, stages_json(sum.stats));
  json.update({{"engine", report.engine},
          {"semantics", report.semantics},
          {"outer", sum.parts.size()},
          {"holes", sum.hole_count()},
          {"vertices", sum.vertex_count()},
          {"area", sum.area()},
          {"area_exact", sum.area_exact().to_string()},
          {"segments", sum.segments.size()},
          {"points", sum.points.size()},
          {"tight", {{"points", sum.tight_points.size()}, {"segments", sum.tight_segments.size()}}},
          {"convolution",
           {{"full", report.convolution.full},
            {"kinetic", report.convolution.kinetic},
            {"reduced", report.convolution.reduced}}},
          {"crossings", sum.stats.crossings},
          {"work", work_json(sum.stats)}});
  if (report.orientation) json["orientation"] = orientation_json(*report.orientation);
  return json;
}

void print_sum(std::ostream& out, const SumReport& report) {
  const PlanarSum& sum = *report.sum;
  out << report.verb << " of";
  for (std::size_t i = 0; i < report.inputs.size(); ++i) {
    const Input& input = report.inputs[i];
    out << (i == 0 ? " " : " and ") << input.file << " ("
        << counted(input.region.vertex_count(), "vertex", "vertices") << ")";
  }
  if (report.orientation) {
    const Orientation& theta = *report.orientation;
    out << " at tan(theta / 2) = " << (theta.is_half_turn() ? "inf" : shown(theta.tan_half())) << ", theta = " << theta.radians();
  }
  out << "\n  " << counted(sum.parts.size(), "part") << ", " << counted(sum.hole_count(), "hole") << ", "
      << counted(sum.vertex_count(), "vertex", "vertices");
  if (!sum.segments.empty() || !sum.points.empty()) {
    out << ", " << counted(sum.segments.size(), "segment") << ", " << counted(sum.points.size(), "isolated point");
  }
  const auto precision = out.precision(17);
  out << "\n  area " << sum.area();
  out.precision(precision);
  out << "\n  tight features: " << counted(sum.tight_points.size(), "point") << ", "
      << counted(sum.tight_segments.size(), "segment") << "\n  convolution: full " << report.convolution.full
      << ", kinetic " << report.convolution.kinetic << ", reduced " << report.convolution.reduced << "; "
      << counted(sum.stats.crossings, "crossing") << "\n  " << tier_name(sum.stats.tier_bits) << " integers, engine "
      << report.engine << ", " << report.semantics << ", " << milliseconds(report.timing.median_ms);
  if (report.timing.repeats > 1) {
    out << " (median of " << report.timing.repeats << ", minimum " << milliseconds(report.timing.min_ms) << ")";
  }
  out << "\n";
}

}  // namespace dymsum::cli
