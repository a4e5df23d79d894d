// dymsum cspace ROBOT OBSTACLE
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <set>

#include "dymsum/obstacle_file.h"
#include "memory_limit.h"
#include "options.h"
#include "outputs.h"
#include "planar/cspace_outputs.h"
#include "planar/cspace_slabs.h"
#include "progress_bar.h"
#include "record_json.h"
#include "report.h"
#include "solid/solid_limits.h"
#include "solid/solid_operands.h"
#include "verbs/commands.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

struct CspaceCommand {
  const CLI::App* parser = nullptr;  ///< which options were given
  std::vector<std::string> operands{"", ""}, files;
  double tolerance = 1e-3;
  std::size_t slices = 12;
  bool open = false;
  std::size_t slabs = 0;  ///< 0: the obstacle instead
  double resolution = 0;  ///< of the maps of slabs; 0: chosen by their extent
  double memory_mb = 0;   ///< 0: no limit
  ReportOptions report;
  InputOptions input;
};

constexpr double kSlabTolerance = 0.01;  // if none is given

bool is_glb(const std::string& file) { return file.ends_with(".glb"); }

bool is_strip(const std::string& file) { return file.ends_with(".svg"); }

void check(const CspaceCommand& command) {
  require_planar("cspace", command.operands);
  if (command.slabs > 0) {
    refuse_options(*command.parser, {"--open", "--slices"}, "does not apply to --slabs");
    if (command.files.size() != 1 || !command.files[0].ends_with('/'))
      throw Stop(kUsage, "--slabs writes many files: give one folder, -o slabs/");
    return;
  }
  refuse_options(*command.parser, {"--resolution"}, "belongs to --slabs");
  for (const std::string& file : command.files)
    if (!is_glb(file) && !is_strip(file) && !file.ends_with(".json") && !file.ends_with(".obstacle"))
      throw Stop(kUsage,
                 "-o writes .glb (boundary), .svg (film strip of slices), .json (patches) or .obstacle (all, to be "
                 "asked again): " +
                     file);
  const auto written = [&](bool (*kind)(const std::string&)) {
    return std::any_of(command.files.begin(), command.files.end(), kind);
  };
  if (!written(is_glb)) refuse_options(*command.parser, {"--tolerance", "--open"}, "belongs to -o FILE.glb");
  if (!written(is_strip)) refuse_options(*command.parser, {"--slices"}, "belongs to -o FILE.svg");
}

struct CspaceReport {
  const std::vector<Input>& inputs;
  const CspaceObstacle& obstacle;
  const std::optional<ObstacleMesh>& mesh;
  Timing timing;
};

std::size_t free_components(const CspaceObstacle& obstacle) {
  std::set<std::uint32_t> components;
  for (const FreeCell& cell : obstacle.free_cells()) components.insert(cell.component);
  return components.size();
}

/// The number tier of a slice: that of the operands, turned.
int tier_bits_of(const CspaceObstacle& obstacle) { return require(obstacle.slice(obstacle.inside(0))).stats.tier_bits; }

Json events_json(const ObstacleWork& work) {
  return {{"alignment", work.alignments},
          {"vertex_on_segment", work.vertex_events},
          {"three_segments", work.triple_events},
          {"tight", work.tight_events}};
}

/// What stands elsewhere in the report is left out.
Json work_json(const ObstacleWork& work) {
  return json_without(work, {"surfaces", "alignments", "vertex_events", "triple_events", "tight_events", "ms"});
}

void print_json(const CspaceReport& report) {
  const CspaceObstacle& obstacle = report.obstacle;
  Json json = report_head("cspace", inputs_json(report.inputs), tier_bits_of(obstacle), report.timing,
                          {{"obstacle", report.timing.median_ms}});
  json.update({{"patches_before_trim", obstacle.work().surfaces},
               {"patches", obstacle.patches().size()},
               {"shells", shells_json(obstacle)},
               {"angles", obstacle.angles().size()},
               {"events", events_json(obstacle.work())},
               {"free_components", free_components(obstacle)},
               {"work", work_json(obstacle.work())}});
  if (report.mesh) json["mesh"] = mesh_json(*report.mesh);
  print_report(json);
}

void print_text(const CspaceReport& report) {
  const CspaceObstacle& obstacle = report.obstacle;
  const ObstacleWork& work = obstacle.work();
  const auto& shells = obstacle.shells();
  const auto outer = std::count_if(shells.begin(), shells.end(), [](const Shell& s) { return s.outer; });
  std::cout << "obstacle of robot " << report.inputs[0].file << " ("
            << counted(report.inputs[0].region.vertex_count(), "vertex", "vertices") << ") at " << report.inputs[1].file
            << " (" << counted(report.inputs[1].region.vertex_count(), "vertex", "vertices") << ")\n  "
            << counted(obstacle.patches().size(), "patch", "patches") << " on " << counted(work.surfaces, "surface")
            << ", " << counted(static_cast<std::size_t>(outer), "outer shell") << ", "
            << counted(shells.size() - static_cast<std::size_t>(outer), "cavity", "cavities") << "\n  "
            << counted(obstacle.angles().size(), "event angle") << "; events: " << counted(work.alignments, "alignment")
            << ", " << work.vertex_events << " of a vertex on a segment, " << work.triple_events
            << " of three segments, " << work.tight_events << " tight\n  free space has "
            << counted(free_components(obstacle), "component") << "\n";
  print_times(std::cout, report.timing);
  if (!report.mesh) return;
  const MeshClosure closed = closure(*report.mesh);
  std::cout << "  mesh of " << counted(report.mesh->triangles.size(), "triangle") << " within "
            << report.mesh->tolerance << (closed.watertight() ? ", watertight" : ", not watertight") << "\n";
}

std::vector<std::string> output_texts(const CspaceCommand& command, const CspaceReport& report,
                                      const Progress& progress) {
  std::vector<std::string> texts;
  for (const std::string& file : command.files) {
    if (is_glb(file))
      texts.push_back(obstacle_glb(report.obstacle, *report.mesh, command.open ? Ends::open : Ends::capped));
    else if (file.ends_with(".obstacle")) texts.push_back(format_obstacle(report.obstacle));
    else if (is_strip(file)) texts.push_back(slice_strip(report.obstacle, command.slices, progress));
    else texts.push_back(obstacle_json(report.obstacle).dump(1) + "\n");
  }
  return texts;
}

ExitCode run_cspace(const CspaceCommand& command) {
  check(command);
  limit_memory(command.memory_mb);
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  if (command.slabs > 0) {
    const auto [maps, timing] = timed(command.report.repeat, [&] {
      const double tolerance = command.parser->count("--tolerance") > 0 ? command.tolerance : kSlabTolerance;
      return slab_maps(inputs, {command.slabs, tolerance, command.resolution, bar->callback()}, command.files[0]);
    });
    bar.reset();
    throw_if_interrupted();
    write_slab_maps(maps);
    if (command.report.json) print_report(slab_json(maps, inputs, timing));
    else print_slabs(std::cout, maps);
    return kDone;
  }
  ObstacleOptions options;
  options.progress = bar->callback();
  options.memory = memory_bytes(command.memory_mb);
  const auto [obstacle, timing] = timed(command.report.repeat, [&] {
    return require_of(inputs, CspaceObstacle::create(inputs[0].region, inputs[1].region, options));
  });
  std::optional<ObstacleMesh> mesh;
  if (std::any_of(command.files.begin(), command.files.end(), is_glb))
    mesh = require(obstacle_mesh(obstacle, {command.tolerance, options.progress}));
  const CspaceReport report{inputs, obstacle, mesh, timing};
  const std::vector<std::string> texts = output_texts(command, report, options.progress);
  bar.reset();
  throw_if_interrupted();
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(command.files[i], texts[i]);
  if (command.report.json) print_json(report);
  else print_text(report);
  return kDone;
}

}  // namespace

void add_cspace(CLI::App& app, Action& action) {
  auto command = std::make_shared<CspaceCommand>();
  CLI::App& verb = *app.add_subcommand(
      "cspace", "The obstacle (x, y, theta) of a robot that moves and turns: where ROBOT overlaps OBSTACLE");
  command->parser = &verb;
  add_operands(verb, kRobot, kObstacle, command->operands);
  verb.add_option("-o", command->files,
                  "Write .glb (the boundary as a closed mesh), .svg (a film strip of exact slices), .json (patches "
                  "with their exact angles) or .obstacle (for --obstacle of clearance and path) or .html (the viewer); "
                  "repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  whole_within(verb.add_option("--slabs", command->slabs,
                               "Instead of the obstacle: N maps of equal ranges of headings, each blocked wherever the "
                               "robot hits something at some heading of the range; -o names a folder, for a PGM and a "
                               "YAML file each, as navigation stacks read them, and the set itself as WKT"),
               2, 3600)
      ->type_name("N");
  within(verb.add_option("--resolution", command->resolution,
                         "With --slabs: the size of a cell; a 256th of the longer side if not given"),
         1e-300, 1e300)
      ->type_name("SIZE");
  within(verb.add_option(
             "--tolerance", command->tolerance,
             "Largest error of the mesh, or with --slabs of the sets (0.01 then), as a fraction of the extent"),
         1e-6, 1)
      ->type_name("T")
      ->capture_default_str();
  verb.add_flag("--open", command->open,
                "Leave the mesh open at -pi and pi, where the surface goes on; otherwise the slice there caps it");
  whole_within(verb.add_option("--slices", command->slices, "Slices of the film strip"), 1, 1000)
      ->type_name("N")
      ->capture_default_str();
  add_memory_limit(verb, command->memory_mb);
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time");
  add_input_options(verb, command->input);
  verb.footer(
      "Example: dymsum cspace peg.wkt slot.wkt -o obstacle.glb -o slices.svg --json\n"
      "Example: dymsum cspace peg.wkt slot.wkt --slabs 16 -o slabs/");
  verb.callback([command, &action] {
    action = [command] {
      return run_with_pages({command->parser, "obstacle", ""}, command->operands, command->input, command->files,
                            [command] { return run_cspace(*command); });
    };
  });
}

}  // namespace dymsum::cli
