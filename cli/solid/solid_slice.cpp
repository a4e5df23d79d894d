#include "solid/solid_slice.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>
#include <utility>

#include "dymsum/solid_slice.h"
#include "progress_bar.h"
#include "record_json.h"
#include "report.h"
#include "solid/solid_limits.h"
#include "solid/solid_outputs.h"
#include "solid/solid_results.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

Json index_json(std::uint32_t index) { return index == SumVertex::kNone ? Json() : Json(index); }

class SliceJson {
 public:
  explicit SliceJson(const SolidSlice& slice) : slice_(slice) {}

  Json run() const {
    Json contacts = Json::array();
    for (const SolidContact& c : slice_.contacts)
      contacts.push_back({{"p", feature_json(c.p)}, {"q", feature_json(c.q)}});
    return {{"z", slice_.z},
            {"parts", parts(slice_.section.parts)},
            {"segments", segments(slice_.section.segments)},
            {"points", points(slice_.section.points)},
            {"touching", parts(slice_.touching)},
            {"tight_segments", segments(slice_.section.tight_segments)},
            {"tight_points", points(slice_.section.tight_points)},
            {"contacts", std::move(contacts)}};
  }

 private:
  Json vertex(const SumVertex& v) const {
    const RationalPoint at = slice_.section.exact(v);
    return {{"at", {at.x.to_double(), at.y.to_double()}},
            {"exact", {at.x.to_string(), at.y.to_string()}},
            {"in", index_json(v.in.p)},
            {"out", index_json(v.out.p)}};
  }
  Json points(const std::vector<SumVertex>& vertices) const {
    Json list = Json::array();
    for (const SumVertex& v : vertices) list.push_back(vertex(v));
    return list;
  }
  Json segments(const std::vector<SumSegment>& segments) const {
    Json list = Json::array();
    for (const SumSegment& s : segments) list.push_back({{"from", vertex(s.from)}, {"to", vertex(s.to)}});
    return list;
  }
  Json parts(const std::vector<SumPart>& parts) const {
    Json list = Json::array();
    for (const SumPart& part : parts) {
      Json holes = Json::array();
      for (const SumRing& hole : part.holes) holes.push_back(points(hole.vertices));
      list.push_back({{"outer", points(part.outer.vertices)}, {"holes", std::move(holes)}});
    }
    return list;
  }

  const SolidSlice& slice_;
};

std::string output(const SolidSlice& slice, RoundedSum& rounded, const std::string& file,
                   const OutputOptions& options) {
  const RegionFormat format = output_format(file, options);
  if (format == RegionFormat::json) return SliceJson(slice).run().dump(1) + "\n";
  if (format == RegionFormat::svg) return draw_section(slice.section, slice.touching);
  return format_sum(slice.section, rounded.region(), format);
}

void print_text(std::ostream& out, const std::vector<SolidInput>& inputs, const SolidSlice& slice,
                const Timing& timing) {
  const PlanarSum& section = slice.section;
  out << "slice of " << inputs[0].file << " and " << inputs[1].file << " at z = " << slice.z << "\n  "
      << counted(section.parts.size(), "part") << ", " << counted(section.hole_count(), "hole") << ", "
      << counted(section.vertex_count(), "vertex", "vertices");
  if (!section.segments.empty() || !section.points.empty())
    out << ", " << counted(section.segments.size(), "segment") << ", "
        << counted(section.points.size(), "isolated point");
  out << "\n  area " << shown_area(section);
  if (!slice.touching.empty()) out << ", " << counted(slice.touching.size(), "part") << " of it touching only";
  out << "\n  tight features: " << counted(section.tight_points.size(), "point") << ", "
      << counted(section.tight_segments.size(), "segment") << "\n  " << slice.stats.crossed << " of "
      << slice.stats.facets << " facets at this height, " << shown(timing) << ", "
      << tier_name(solid_tier(slice.stats.bits)) << " coordinates\n";
}

SolidInput negated_input(SolidInput input) {
  input.mesh = negated(input.mesh);
  if (input.result) input.result = negated(*input.result);
  return input;
}

}  // namespace

ExitCode run_solid_slice(const SumCommand& command, double z, bool reflected) {
  refuse_options(*command.parser, {"--engine", "--semantics"}, "of slice is for planar operands");
  if (!writes_to_stdout(command.output.files)) refuse_options(*command.parser, {"--to"}, "is the format of -o -");
  for (const std::string& file : command.output.files)
    if (is_stage_picture(file)) throw Stop(kUsage, file + ": stages are drawn of planar operands");
  std::ostream& out = report_stream(command.output.files, command.report.json);
  check_outputs(command.output);
  if (!writes_rounded(command.output))
    refuse_options(*command.parser, {"--round-repair"}, "belongs to -o FILE.wkt, .poly or .geojson");
  const std::vector<SolidInput> inputs = read_solids_and_results(command.operands, command.input);
  report_left_out(inputs, command.input.quiet);
  const SolidInput q = reflected ? negated_input(inputs[1]) : inputs[1];
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  SpatialOptions options;
  options.progress = bar->callback();
  options.memory = memory_bytes(command.memory_mb);
  const auto [slice, timing] = timed(command.report.repeat, [&] {
    Result<SolidSlice> made = slice_of_sum(inputs[0].operand(), q.operand(), z, options);
    throw_if_interrupted();
    if (!made) stop_with(in_solid_operand(made.error(), inputs));
    return *std::move(made);
  });
  bar.reset();
  RoundedSum rounded(slice.section, command.output.round_repair);
  std::vector<std::string> texts;
  for (const std::string& file : command.output.files) texts.push_back(output(slice, rounded, file, command.output));
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(command.output.files[i], texts[i]);
  if (command.report.json) {
    Json json = report_head("slice", solid_inputs_json(inputs), solid_tier(slice.stats.bits), timing);
    json["z"] = slice.z;
    json.update(size_json(slice.section, command.report.exact));
    json.update({{"segments", slice.section.segments.size()},
                 {"points", slice.section.points.size()},
                 {"touching", slice.touching.size()},
                 {"facets", slice.stats.facets},
                 {"crossed", slice.stats.crossed},
                 {"cells", slice.stats.cells},
                 {"collision_tests", slice.stats.collision_tests}});
    if (rounded.rounding()) json["rounding"] = json_of(*rounded.rounding());
    print_report(json);
  } else {
    print_text(out, inputs, slice, timing);
  }
  return kDone;
}

}  // namespace dymsum::cli
