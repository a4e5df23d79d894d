// dymsum scale P Q --copies FILE
#include <iostream>
#include <optional>

#include "outputs.h"
#include "pictures/copies_picture.h"
#include "planar/copies_file.h"
#include "progress_bar.h"
#include "report.h"
#include "timing.h"
#include "verbs/scale_command.h"

namespace dymsum::cli {
namespace {

void check(const ScaleCommand& command) {
  if (!command.sweep.empty() || !command.at.empty()) throw Stop(kUsage, "give one of --sweep, --at and --copies");
  if (command.scaled != "p") throw Stop(kUsage, "--copies scales P, the first operand: --scaled q does not apply");
  refuse_options(*command.parser, {"--ratio"}, "belongs to --sweep and --at");
  refuse_options(*command.parser, {"--threads"}, "does not apply to --copies, whose windows are planned");
  if (command.events) throw Stop(kUsage, "--events belongs to --sweep and --at");
  for (const std::string& file : command.files)
    if (!file.ends_with(".svg"))
      throw Stop(kUsage, "-o with --copies writes .svg (a picture of the environment): " + file);
}

Json copies_json(const std::vector<ScaledCopy>& copies, const std::vector<CopySum>& sums, bool exact) {
  Json list = Json::array();
  for (std::size_t i = 0; i < sums.size(); ++i) {
    Json copy = {{"s", copies[i].scale.exact().to_string()}, {"at", {sums[i].at.x, sums[i].at.y}}};
    copy.update(size_json(sums[i].sum, exact));
    copy["update_ms"] = sums[i].work.ms;
    list.push_back(std::move(copy));
  }
  return list;
}

struct CopiesWork {
  int tier = 0;
  std::size_t windows = 0, rebuilt = 0, vertices = 0;
};

CopiesWork work_of(const std::vector<CopySum>& sums) {
  CopiesWork work;
  for (const CopySum& copy : sums) {
    work.tier = std::max(work.tier, copy.sum.stats.tier_bits);
    work.windows += copy.work.new_window;
    work.rebuilt += copy.work.rebuilt;
    work.vertices += copy.sum.vertex_count();
  }
  return work;
}

}  // namespace

ExitCode run_copies(const ScaleCommand& command) {
  check(command);
  const std::vector<ScaledCopy> copies = read_copies(command.copies);
  const std::vector<Input> inputs = read_inputs(command.operands, command.input);
  const Region &master = inputs[0].region, &q = inputs[1].region;
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  MovingOptions options = scaling_options(command), fresh = options;
  options.progress = fresh.progress = bar->callback();
  fresh.mode = FrameMode::rebuild;
  const auto [sums, timing] =
      timed(command.report.repeat, [&] { return require(scaled_copies(master, q, copies, options)); });
  const Timing scratch =
      timed(command.report.repeat, [&] { return require(scaled_copies(master, q, copies, fresh)); }).second;
  bar.reset();
  const CopiesWork work = work_of(sums);
  for (const std::string& file : command.files)
    write_text(file, copies_picture(master, command.robot ? q : negated(q), copies, sums));
  if (command.report.json) {
    Json json = report_head("scale", inputs_json(inputs), work.tier, timing, {{"copies", timing.median_ms}});
    json.update({{"semantics", command.semantics},
                 {"scaled", command.scaled},
                 {"robot", command.robot},
                 {"copies", copies_json(copies, sums, command.report.exact)},
                 {"static_ms", scratch.median_ms},
                 {"update_ms", timing.median_ms},
                 {"work", {{"windows", work.windows}, {"rebuilt", work.rebuilt}}}});
    print_report(json);
  } else {
    std::cout << counted(copies.size(), "copy", "copies") << " of " << inputs[0].file
              << (command.robot ? " for robot " : " summed with ") << inputs[1].file << "\n  all " << timing.median_ms
              << " ms (least " << timing.min_ms << " ms), each from scratch " << scratch.median_ms << " ms\n  "
              << counted(work.windows, "window") << ", " << counted(work.rebuilt, "sum") << " from scratch; "
              << counted(work.vertices, "vertex", "vertices") << " in all\n";
  }
  return kDone;
}

}  // namespace dymsum::cli
