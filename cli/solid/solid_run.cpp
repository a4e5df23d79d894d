#include "solid/solid_run.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <utility>

#include "outputs.h"
#include "progress_bar.h"
#include "solid/solid_limits.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

/// The tier that solid_tier has; 0 where nothing was computed on a grid.
int grid_tier(const SpatialSum& sum) {
  return sum.is_convex() ? sum.stats.bits : sum.stats.cells == 0 ? 0 : solid_tier(sum.stats.bits);
}

bool is_tight(const SpatialSum& sum) {
  return !sum.tight_faces.empty() || !sum.tight_segments.empty() || !sum.tight_points.empty();
}

void print_text(std::ostream& out, const SolidRun& run, const SolidOutcome& outcome, const Timing& timing) {
  const SpatialSum& sum = outcome.solid;
  out << run.verb << " of ";
  for (std::size_t i = 0; i < run.inputs.size(); ++i)
    out << (i == 0 ? "" : i + 1 < run.inputs.size() ? ", " : " and ") << run.inputs[i].file;
  out << "\n  " << counted(sum.faces.size(), "face") << " on " << counted(sum.shells, "shell") << ", "
      << counted(sum.vertices.size(), "vertex", "vertices") << "\n  volume " << shown(volume_of(sum)) << ", area "
      << shown(surface_of(sum)) << "\n";
  if (is_tight(sum)) {
    out << "  tight: " << counted(sum.tight_faces.size(), "face") << ", "
        << counted(sum.tight_segments.size(), "segment") << ", " << counted(sum.tight_points.size(), "point") << "\n";
  }
  if (!outcome.text.empty()) out << "  " << outcome.text << "\n";
  out << "  " << sum.stats.face_vertex << " face + vertex and " << sum.stats.edge_edge << " edge + edge facets, "
      << shown(timing) << ", " << tier_name(grid_tier(sum)) << " coordinates\n";
}

/// Pictures of the stages have more of them than the computation holds at once.
void check_stage_memory(const SpatialSum& sum, std::uint64_t memory) {
  const std::uint64_t bytes = sum.trace ? stage_mesh_bytes(*sum.trace) : 0;
  if (memory == 0 || bytes <= memory) return;
  const auto megabytes = [](std::uint64_t b) { return std::to_string((b + 999999) / 1000000) + " MB"; };
  stop_with({ErrorCode::out_of_memory,
             "drawing the stages takes about " + megabytes(bytes) + " of memory, the limit is " + megabytes(memory),
             {}});
}

/// Names the operand at fault; of limits of memory, which are of a sum, the verb that is made of sums.
Error reported(Error error, const SolidRun& run) {
  const bool is_sum = run.verb == "sum" || run.verb == "nfp";
  if (error.code == ErrorCode::out_of_memory && !is_sum) error.message = "in this " + run.verb + ", " + error.message;
  return in_solid_operand(std::move(error), run.inputs);
}

bool is_no(const SolidRun& run, const SpatialSum& sum) {
  return run.empty_is_no && sum.faces.empty() && (run.of_open_sets || !is_tight(sum));
}

/// What the pages are to show: the result as it is written to .off; empty where there are none, or the answer is no.
std::string shown_text(const SolidRun& run, const SpatialSum& sum) {
  if (!run.pages.any() || is_no(run, sum)) return "";
  if (sum.faces.empty()) run.pages.stop_with_nothing_to_show();
  return mesh_of_sum(sum, MeshFormat::off, run.pages.file(), run.how).text;
}

void write_pages(const SolidRun& run, std::string text) {
  if (!run.pages.any()) return;
  if (!text.empty())
    return run.pages.write({run.verb + " of " + shape_name(run.inputs[0].file) + ".off", std::move(text)});
  std::cerr << run.pages.file() << ": nothing is left to show, and no page is written\n";
}

}  // namespace

ExitCode run_solid(const SolidRun& run, const std::function<Result<SolidOutcome>(const SpatialOptions&)>& compute) {
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  SpatialOptions options;
  options.semantics = named<Semantics>(run.semantics);
  options.memory = memory_bytes(run.memory_mb);
  options.engine = named<SpatialEngine>(run.engine);
  options.progress = bar->callback();
  options.trace = std::any_of(run.files.begin(), run.files.end(), is_stage_mesh);
  const auto [outcome, timing] = timed(run.report.repeat, [&] {
    Result<SolidOutcome> made = compute(options);
    throw_if_interrupted();
    if (!made) stop_with(reported(made.error(), run));
    return *std::move(made);
  });
  bar.reset();
  const SpatialSum& sum = outcome.solid;
  check_stage_memory(sum, options.memory);
  std::vector<std::string> texts;
  Json rounding;
  for (const std::string& file : run.files) {
    WrittenSolid written = written_solid(sum, file, run.how);
    texts.push_back(std::move(written.text));
    if (!written.rounding.is_null()) rounding = std::move(written.rounding);
  }
  std::string shown = shown_text(run, sum);
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(run.files[i], texts[i]);
  write_pages(run, std::move(shown));
  std::ostream& out = report_stream(run.files, run.report.json);
  if (run.report.json) {
    Json stages = Json::object();
    for (const SpatialStats::Stage& stage : sum.stats.stages) stages[std::string(stage.name)] = stage.ms;
    Json json = report_head(run.verb, solid_inputs_json(run.inputs), grid_tier(sum), timing, std::move(stages));
    json["engine"] = run.engine;
    json["semantics"] = run.semantics;
    json.update(solid_sum_json(sum, run.report.exact));
    json.update(outcome.more);
    if (!rounding.is_null()) json["rounding"] = std::move(rounding);
    print_report(json);
  } else {
    print_text(out, run, outcome, timing);
  }
  return is_no(run, sum) ? kNo : kDone;
}

}  // namespace dymsum::cli
