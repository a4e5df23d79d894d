// dymsum nfp-table INSTANCE.json
#include "dymsum/nfp_table.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

#include "line_file.h"
#include "options.h"
#include "outputs.h"
#include "planar/table_options.h"
#include "planar/tier.h"
#include "progress_bar.h"
#include "report.h"
#include "timing.h"
#include "verbs/commands.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

struct TableCommand {
  const CLI::App* parser = nullptr;
  std::string instance, orientations, cache, shard;
  bool merge = false;
  std::size_t threads = 0;
  double spacing = 0, margin = 0;
  double error = 1e-9, pair_time = std::numeric_limits<double>::infinity(), time = pair_time;
  std::vector<std::string> outputs;
  ReportOptions report;
  InputOptions input;
};

struct RowCounts {
  std::size_t all = 0, done = 0, refused = 0, timed_out = 0, missing = 0;
};

RowCounts counts_of(const NfpTable& table, const TableResult& result) {
  RowCounts counts;
  counts.all = table.rows().size();
  for (const TableRow& row : table.rows()) {
    const std::optional<TableAnswer>& answer = result.answers[row.answer];
    if (!answer) ++counts.missing;
    else if (answer->status == TableAnswer::Status::done) ++counts.done;
    else if (answer->status == TableAnswer::Status::refused) ++counts.refused;
    else ++counts.timed_out;
  }
  return counts;
}

bool writes_rows(const std::string& file) { return file == "-" || file.ends_with(".jsonl"); }
bool writes_geometry(const std::string& file) { return file.ends_with(".wkb"); }
bool writes_manifest(const std::string& file) { return file.ends_with(".json"); }

void check_table_outputs(const TableCommand& command) {
  for (const std::string& file : command.outputs)
    if (!writes_rows(file) && !writes_geometry(file) && !writes_manifest(file))
      throw Stop(kUsage, "-o " + file + ": a table is written as .jsonl (rows), .wkb (geometry) and .json (manifest)" +
                             (is_page(file) ? "; the viewer shows no table: nfp shows a pair of items" : ""));
  const CLI::App& parser = *command.parser;
  if (!command.cache.empty()) refuse_options(parser, {"--repeat"}, "would measure how fast --cache is read");
  if (command.cache.empty()) refuse_options(parser, {"--shard", "--merge"}, "wants --cache, the folder of all shards");
  if (!command.shard.empty())
    refuse_options(parser, {"--merge", "-o"}, "is not for one shard: --merge writes the table when all are there");
  if (command.merge)
    refuse_options(parser, {"--threads", "--time", "--pair-time"}, "is for computing, not for --merge");
}

TableOptions options_of(const TableCommand& command) {
  TableOptions options;
  options.threads = static_cast<int>(command.threads);
  options.pair_seconds = command.pair_time;
  options.all_seconds = command.time;
  options.store = command.cache;
  options.compute = !command.merge;
  if (command.shard.empty()) return options;
  const ShardOption shard = shard_in(command.shard);
  options.shard = shard.shard;
  options.shards = shard.shards;
  return options;
}

/// Rows and geometry are made where an output, or the manifest, wants them.
void write_table(const TableCommand& command, const NfpTable& table, const TableResult& result) {
  const auto wants = [&](const auto& kind) {
    return std::any_of(command.outputs.begin(), command.outputs.end(), kind);
  };
  const bool geometry_apart = wants(writes_geometry), manifest = wants(writes_manifest);
  std::string rows, geometry;
  if (manifest || wants(writes_rows)) rows = table_rows(table, result, !geometry_apart);
  if (manifest || geometry_apart) geometry = table_geometry(table, result);
  for (const std::string& file : command.outputs)
    write_text(file, writes_rows(file)       ? rows
                     : writes_geometry(file) ? geometry
                                             : table_manifest(table, result, rows, geometry));
}

Json table_json(const TableCommand& command, const NfpTable& table, const TableResult& result, const Timing& timing) {
  std::vector<Input> inputs;
  int tier = 29;
  for (const TableItem& item : table.input().items) {
    inputs.push_back({command.instance + "#" + item.name, item.shape});
    const int bits = tier_of(item.shape);
    tier = tier == 0 || bits == 0 ? 0 : std::max(tier, bits);
  }
  const RowCounts counts = counts_of(table, result);
  Json refused = Json::array();
  for (const RefusedFile& file : result.work.refused_files) refused.push_back({{"file", file.file}, {"why", file.why}});
  Json json = report_head("nfp-table", inputs_json(inputs), tier, timing);
  json.update({{"bins", table.input().bins.size()},
               {"rows",
                {{"all", counts.all},
                 {"done", counts.done},
                 {"refused", counts.refused},
                 {"timed_out", counts.timed_out},
                 {"missing", counts.missing}}},
               {"tasks", result.work.tasks},
               {"computed", result.work.computed},
               {"timed_out", result.work.timed_out},
               {"cache", {{"files", result.work.store_files}, {"refused_files", refused}}}});
  return json;
}

std::string work_text(const TableCommand& command, const TableWork& work) {
  if (command.merge) return "read from " + counted(work.store_files, "file") + " of the cache";
  std::string text = counted(work.tasks, "task") + ": " + std::to_string(work.computed) + " computed";
  const std::uint64_t taken = work.tasks - work.computed - work.timed_out;
  if (taken > 0) text += ", " + std::to_string(taken) + " taken from the cache";
  if (work.timed_out > 0) text += ", " + std::to_string(work.timed_out) + " given up";
  return text;
}

void print_table(std::ostream& out, const TableCommand& command, const NfpTable& table, const TableResult& result,
                 const Timing& timing) {
  const RowCounts counts = counts_of(table, result);
  out << counted(table.input().items.size(), "item") << ", " << counted(counts.all, "row")
      << (command.shard.empty() ? ": " : " of all shards: ") << counts.done << " done, " << counts.refused
      << " refused, " << counts.timed_out << " timed out";
  if (counts.missing > 0) out << ", " << counts.missing << " not there yet";
  out << "\n" << work_text(command, result.work) << "\n";
  print_times(out, timing);
}

void warn_of_cache(const TableResult& result) {
  for (const RefusedFile& file : result.work.refused_files)
    std::cerr << file.file << ": not believed: " << file.why << "; what is missing is computed again\n";
}

void require_all(const TableCommand& command, const NfpTable& table, const TableResult& result) {
  const RowCounts counts = counts_of(table, result);
  if (counts.missing == 0) return;
  throw Stop(kBadInput, command.cache + ": " + std::to_string(counts.missing) + " of " + std::to_string(counts.all) +
                            " rows are missing: not all shards have been computed to their ends");
}

/// Lists the rows, which takes long where there are very many, and takes the time for that off options.all_seconds.
NfpTable planned(const TableCommand& command, TableInput input, TableOptions& options) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [start = Clock::now()] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  bool late = false;
  const auto go_on = [&](std::string_view stage, double fraction) {
    late = seconds() > options.all_seconds;
    return !late && options.progress(stage, fraction);
  };
  Result<NfpTable> table = NfpTable::create(std::move(input), go_on);
  if (late)
    throw Stop(kUndecided, "the limit of --time was reached while the rows were being listed: there is no table");
  if (!table) {
    Error error = table.error();
    error.evidence.file = shown_file(command.instance);
    stop_with(error);
  }
  // Past the limit every row is given up.
  options.all_seconds = std::max(options.all_seconds - seconds(), std::numeric_limits<double>::min());
  return std::move(table).value();
}

ExitCode run_nfp_table(const TableCommand& command) {
  check_table_outputs(command);
  std::ostream& out = report_stream(command.outputs, command.report.json);
  TableOptions options = options_of(command);
  const std::vector<Rational> degrees =
      command.orientations.empty() ? std::vector<Rational>{} : orientations_in(command.orientations);
  NestingInstance instance = require(parse_nesting_instance(file_text(command.instance), shown_file(command.instance)));
  TableInput input =
      table_input(shown_file(command.instance), std::move(instance), degrees, command.error, command.input);
  input.spacing = command.spacing, input.margin = command.margin;
  const InterruptGuard guard;
  std::optional<ProgressBar> bar(std::in_place);
  options.progress = bar->callback();
  const NfpTable table = planned(command, std::move(input), options);
  const auto [result, timing] = timed(command.report.repeat, [&] { return require(compute_table(table, options)); });
  bar.reset();
  warn_of_cache(result);
  if (command.merge) require_all(command, table, result);
  write_table(command, table, result);
  if (command.report.json) print_report(table_json(command, table, result, timing));
  else print_table(out, command, table, result, timing);
  // What other shards gave up is not this one's failure.
  const std::size_t given_up = command.merge ? counts_of(table, result).timed_out : result.work.timed_out;
  return given_up > 0 ? kUndecided : kDone;
}

void add_limits(CLI::App& verb, TableCommand& command) {
  whole_within(verb.add_option("--threads", command.threads, "Threads [as many as there are cores]"), 1, 4096)
      ->type_name("N");
  // Zero seconds are no limit that anything meets.
  within(verb.add_option("--pair-time", command.pair_time, "Seconds after which a pair is given up"), 1e-9)
      ->type_name("S");
  within(verb.add_option("--time", command.time, "Seconds after which all that is not done is given up"), 1e-9)
      ->type_name("S");
}

void add_cache_options(CLI::App& verb, TableCommand& command) {
  verb.add_option("--cache", command.cache,
                  "A folder that answers are taken from and added to as they come, for any instance; what a killed run "
                  "has finished is in it")
      ->type_name("DIR");
  verb.add_option("--shard", command.shard, "Compute the i-th of N parts of the work into --cache")->type_name("i/N");
  verb.add_flag("--merge", command.merge, "Compute nothing: write the table of what all shards left in --cache");
}

}  // namespace

void add_nfp_table(CLI::App& app, Action& action) {
  auto command = std::make_shared<TableCommand>();
  CLI::App& verb = *app.add_subcommand(
      "nfp-table",
      "All no-fit polygons of pairs of items of a nesting instance, and the inner fits of its bins and strip");
  command->parser = &verb;
  verb.add_option("INSTANCE", command->instance, "The instance: a .json file with items, or - for standard input")
      ->required()
      ->type_name("");
  verb.add_option(
          "--orientations", command->orientations,
          "Orientations of all items instead of those that the instance allows: how many equally spaced ones, or "
          "degrees as 0deg,90deg")
      ->type_name("N|LIST");
  within(verb.add_option("--error", command->error, "Largest error of angles other than quarter turns, in radians"),
         0x1p-49)
      ->type_name("E")
      ->capture_default_str();
  within(verb.add_option("--spacing", command->spacing,
                         "The least distance of two items, in each other's holes too: never less, at most 1 % more"),
         0)
      ->type_name("D");
  within(
      verb.add_option("--margin", command->margin,
                      "The least distance of an item from the outside and the holes of its bin, and from the strip's"),
      0)
      ->type_name("M");
  verb.add_option(
          "-o", command->outputs,
          "Write the table; repeatable; .jsonl rows, with their geometry unless there is a .wkb; .wkb geometry; "
          ".json manifest; - rows on standard output")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_cache_options(verb, *command);
  add_limits(verb, *command);
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time");
  add_repair_option(verb, command->input, OperandKind::planar);
  verb.footer(
      "Exit code 5 when pairs were given up.\n"
      "Example: dymsum nfp-table swim.json --repair --orientations 8 -o rows.jsonl -o rows.wkb -o manifest.json\n"
      "Example: dymsum nfp-table sheet.json --spacing 2.5 --margin 5 -o rows.jsonl");
  verb.callback([command, &action] { action = [command] { return run_nfp_table(*command); }; });
}

}  // namespace dymsum::cli
