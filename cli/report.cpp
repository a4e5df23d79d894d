#include "report.h"
#include "record_json.h"

#include <cmath>
#include <ostream>
#include <sstream>

#include "dymsum/area_text.h"
#include "dymsum/volume_text.h"

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

/// What stands elsewhere in a report is left out.
Json work_json(const SumStats& stats) {
  return json_without(stats, {"tier_bits", "reduced_segments", "crossings", "stages"});
}

double area_of(const PlanarSum& sum) { return sum.area(); }
double area_of(const Region& region) { return area(region); }
bool has_area(const PlanarSum& sum) { return !sum.parts.empty(); }
bool has_area(const Region& region) { return !region.parts().empty(); }

template <class Set>
Measure any_area(const Set& set) {
  if (const double area = area_of(set); std::isnormal(area) || !has_area(set)) return area;
  return area_text(set);
}

std::string milliseconds(double ms) {
  std::ostringstream text;
  text.precision(ms < 100 ? 3 : 6);
  text << ms << " ms";
  return text.str();
}

}  // namespace

int solid_tier(int bits) {
  for (const int width : {26, 61, 72, 124, 250})
    if (bits <= width) return width;
  return 0;
}

std::string tier_name(int bits) { return bits == 0 ? "arbitrary precision" : std::to_string(bits) + "-bit"; }

std::string shown(const Rational& value) { return value.is_integer() ? value.numerator() : value.to_string(); }

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
    list.back().update(input.notes);
  }
  return list;
}

void print_notes(std::ostream& out, const ReadingNotes& notes) {
  if (notes.contains("unit")) out << "\n  in " << notes["unit"].get<std::string>();
  if (notes.contains("curves")) out << "\n  chords stand for " << counted(notes["curves"].get<std::size_t>(), "curve");
}

Json orientation_json(const Orientation& orientation) {
  const std::string tangent = orientation.is_half_turn() ? "inf" : orientation.tan_half().to_string();
  return {{"tan_half", tangent}, {"theta", orientation.radians()}};
}

std::string shown(const Measure& measure) {
  std::ostringstream text;
  text.precision(17);
  std::visit([&](const auto& m) { text << m; }, measure);
  return text.str();
}

Json measure_json(const Measure& measure) {
  return std::visit([](const auto& m) { return Json(m); }, measure);
}

Measure volume_of(const Mesh& mesh) {
  if (const double v = volume(mesh); std::isnormal(v) || mesh.empty()) return v;
  return volume_text(mesh);
}
Measure volume_of(const SpatialSum& sum) {
  if (const double v = sum.volume(); std::isnormal(v) || sum.faces.empty()) return v;
  return volume_text(sum);
}
Measure surface_of(const SpatialSum& sum) {
  if (const double v = sum.area(); std::isnormal(v) || sum.faces.empty()) return v;
  return surface_text(sum);
}
Measure surface_of(const Mesh& mesh) {
  if (const double v = surface_area(mesh); std::isnormal(v) || mesh.empty()) return v;
  return surface_text(mesh);
}

Json area_json(const Region& region) { return measure_json(any_area(region)); }

std::string shown_area(const PlanarSum& sum) { return shown(any_area(sum)); }

std::string shown_area(const Region& region) { return shown(any_area(region)); }

Json size_json(const PlanarSum& sum, bool exact) {
  constexpr std::size_t kMostVertices = 10000, kMostBits = 16384;
  std::optional<Rational> area;
  if (exact) area = sum.area_exact();
  else if (sum.vertex_count() <= kMostVertices) area = sum.area_exact_within(kMostBits);
  return {{"outer", sum.parts.size()},
          {"holes", sum.hole_count()},
          {"vertices", sum.vertex_count()},
          {"area", measure_json(any_area(sum))},
          {"area_exact", area ? Json(area->to_string()) : Json()},
          {"tight", {{"points", sum.tight_points.size()}, {"segments", sum.tight_segments.size()}}}};
}

std::string shown(const Timing& timing) {
  const std::string median = milliseconds(timing.median_ms);
  if (timing.repeats == 1) return median;
  return median + " (median of " + std::to_string(timing.repeats) + ", minimum " + milliseconds(timing.min_ms) + ")";
}

void print_times(std::ostream& out, const Timing& timing) {
  if (timing.repeats > 1) out << "  " << shown(timing) << "\n";
}

Json sum_json(const SumReport& report) {
  const PlanarSum& sum = *report.sum;
  Json json =
      report_head(report.verb, inputs_json(report.inputs), sum.stats.tier_bits, report.timing, stages_json(sum.stats));
  if (!report.engine.empty()) json["engine"] = report.engine;
  json["semantics"] = report.semantics;
  json.update(size_json(sum, report.exact));
  json.update({{"segments", sum.segments.size()},
               {"points", sum.points.size()},
               {"crossings", sum.stats.crossings},
               {"work", work_json(sum.stats)}});
  if (const auto& sizes = report.convolution)
    json["convolution"] = {{"full", sizes->full}, {"kinetic", sizes->kinetic}, {"reduced", sizes->reduced}};
  if (report.orientation) json["orientation"] = orientation_json(*report.orientation);
  if (report.rounding) json["rounding"] = json_of(*report.rounding);
  return json;
}

void print_sum(std::ostream& out, const SumReport& report) {
  const PlanarSum& sum = *report.sum;
  out << report.verb << " of";
  for (std::size_t i = 0; i < report.inputs.size(); ++i) {
    const Input& input = report.inputs[i];
    out << (i == 0                         ? " "
            : i + 1 < report.inputs.size() ? ", "
                                           : " and ")
        << input.file << " (" << counted(input.region.vertex_count(), "vertex", "vertices") << ")";
  }
  if (report.orientation) {
    const Orientation& theta = *report.orientation;
    out << " at tan(theta / 2) = " << (theta.is_half_turn() ? "inf" : shown(theta.tan_half()))
        << ", theta = " << theta.radians();
  }
  out << "\n  " << counted(sum.parts.size(), "part") << ", " << counted(sum.hole_count(), "hole") << ", "
      << counted(sum.vertex_count(), "vertex", "vertices");
  if (!sum.segments.empty() || !sum.points.empty()) {
    out << ", " << counted(sum.segments.size(), "segment") << ", " << counted(sum.points.size(), "isolated point");
  }
  out << "\n  area " << shown_area(sum) << "\n  tight features: " << counted(sum.tight_points.size(), "point") << ", "
      << counted(sum.tight_segments.size(), "segment") << "\n  ";
  if (const auto& sizes = report.convolution)
    out << "convolution: full " << sizes->full << ", kinetic " << sizes->kinetic << ", reduced " << sizes->reduced
        << "; ";
  out << counted(sum.stats.crossings, "crossing") << "\n  " << tier_name(sum.stats.tier_bits) << " integers, "
      << (report.engine.empty() ? "" : "engine " + report.engine + ", ") << report.semantics << ", "
      << shown(report.timing);
  out << "\n";
}

}  // namespace dymsum::cli
