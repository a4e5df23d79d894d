// dymsum family P Q --scale A:B | FILE.family, with questions
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "dymsum/family_file.h"
#include "memory_limit.h"
#include "options.h"
#include "outputs.h"
#include "pictures/frame_pictures.h"
#include "pictures/lifetimes_picture.h"
#include "planar/family_answers.h"
#include "planar/family_source.h"
#include "progress_bar.h"
#include "report.h"
#include "verbs/commands.h"
#include "verbs/scale_command.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

struct FamilyCommand {
  const CLI::App* parser = nullptr;  ///< which options were given
  FamilyInput family;
  std::vector<std::string> at;
  std::string changes, outer, inner;
  bool lifetimes = false;
  OutputOptions output;
  ReportOptions report;
};

FamilyQuestions questions_of(const FamilyCommand& command) {
  FamilyQuestions questions;
  for (const std::string& s : listed(command.at)) questions.at.push_back(read_scale(s, "--at"));
  if (!command.changes.empty()) questions.changes = named<EventChange>(command.changes);
  questions.lifetimes = command.lifetimes;
  if (!command.outer.empty()) questions.outer = read_interval(command.outer, "--outer");
  if (!command.inner.empty()) questions.inner = read_interval(command.inner, "--inner");
  return questions;
}

bool is_svg(const std::string& file) { return file.ends_with(".svg"); }

std::size_t sum_count(const FamilyQuestions& questions) {
  return questions.at.size() + (questions.outer ? 1 : 0) + (questions.inner ? 1 : 0);
}

/// Whether a picture shows lifetimes: where no sum is requested.
bool pictures_lifetimes(const FamilyQuestions& questions) { return sum_count(questions) == 0; }

/// What the outputs would hold is clear, before any long work.
void check_outputs_of(const FamilyCommand& command, const FamilyQuestions& questions) {
  const std::size_t sums = sum_count(questions);
  for (const std::string& file : command.output.files) {
    if (is_family_file(file)) continue;
    if (is_page(file)) throw Stop(kUsage, file + ": the viewer shows no family: scale --sweep shows its sums");
    if (is_svg(file) && command.lifetimes && sums > 0)
      throw Stop(kUsage,
                 "-o " + file + " would show lifetimes or sums: give --lifetimes, or --at, --outer and --inner");
    if (is_svg(file) && !is_stage_picture(file)) continue;
    if (is_stage_picture(file)) throw Stop(kUsage, file + ": sums of a family have no stages to draw");
    output_format(file, command.output);
    if (sums != 1)
      throw Stop(kUsage, "-o " + file + " holds one sum: give one scale with --at, or one of --outer and --inner");
  }
}

std::string sums_picture(const FamilySource& source, const FamilyAnswers& answers, const OutputOptions& output) {
  const std::vector<const FamilySum*> sums = answers.sums();
  if (sums.size() == 1)
    return draw_sum(source.inputs[0].region, source.inputs[1].region, sums[0]->sum,
                    RoundedSum(sums[0]->sum, output.round_repair).region(),
                    {"P", "Q", "P ⊕ Q, " + caption_of(answers, *sums[0])});
  std::vector<PicturedFrame> frames;
  for (const FamilySum* sum : sums) frames.push_back({caption_of(answers, *sum), drawn(sum->sum)});
  return film_strip(frames, 8);
}

std::string title_of(const FamilySource& source) {
  const ScalingFamily& family = source.family;
  return source.inputs[0].file + " and " + source.inputs[1].file + ", s from " + shown(family.low().exact()) + " to " +
         shown(family.high().exact());
}

void write_outputs(const FamilyCommand& command, const FamilyQuestions& questions, const FamilySource& source,
                   const FamilyAnswers& answers) {
  std::vector<std::string> texts;
  OutputOptions sums = command.output;
  sums.files.clear();
  for (const std::string& file : command.output.files) {
    if (is_family_file(file)) texts.push_back(format_family(source.family));
    else if (!is_svg(file)) sums.files.push_back(file);
    else if (!pictures_lifetimes(questions)) texts.push_back(sums_picture(source, answers, command.output));
    else texts.push_back(lifetimes_picture(source.family, require(source.family.lifetimes()), title_of(source)));
  }
  throw_if_interrupted();
  if (!sums.files.empty())
    write_sum(source.inputs[0].region, source.inputs[1].region, answers.sums()[0]->sum, {}, sums);
  std::size_t next = 0;
  for (const std::string& file : command.output.files)
    if (is_family_file(file) || is_svg(file)) write_text(file, texts[next++]);
}

ExitCode run_family(const FamilyCommand& command) {
  check_family_input(*command.parser, command.family);
  const FamilyQuestions questions = questions_of(command);
  std::ostream& out = report_stream(command.output.files, command.report.json);
  check_outputs_of(command, questions);
  limit_memory(command.family.memory_mb);
  const InterruptGuard guard;
  const FamilySource source = family_of(command.family, command.report.repeat);
  const FamilyAnswers answers = answers_of(source.family, questions);
  write_outputs(command, questions, source, answers);
  if (command.report.json) print_report(family_json(source, answers, command.report.exact));
  else print_family(out, source, answers);
  return kDone;
}

void add_questions(CLI::App& verb, FamilyCommand& command) {
  verb.add_option("--at", command.at, "The sums at these scales between commas, exact: 3/2, 1.01; repeatable")
      ->type_name("S,S,...")
      ->allow_extra_args(false);
  one_of<EventChange>(
      verb.add_option("--changes", command.changes,
                      "List the exact scales at which the sum changes: all that are visible, or only the topology"))
      ->expected(0, 1)
      ->default_str("visible");
  verb.add_flag("--lifetimes", command.lifetimes, "List from where to where every vertex, edge and hole is there");
  verb.add_option("--outer", command.outer, "What lies in the sum at some scale of [A, B]")->type_name("A:B");
  verb.add_option("--inner", command.inner, "What lies in the sum at every scale of [A, B]")->type_name("A:B");
  verb.add_option(
          "-o", command.output.files,
          "Write .family (the family, to be queried again; .family.gz compressed), or one sum as .poly .wkt "
          ".geojson .dxf .gpkg (rounded) or .json (exact); .svg shows the sums that are requested, or without any "
          "the lifetimes; - is standard output (wkt); repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

}  // namespace

void add_family(CLI::App& app, Action& action) {
  auto command = std::make_shared<FamilyCommand>();
  CLI::App& verb =
      *app.add_subcommand("family",
                          "All sums s P (+) Q of an interval of scales: any of them, what changes, and what "
                          "holds for all scales or for some");
  command->parser = &verb;
  add_family_input(verb, command->family);
  add_questions(verb, *command);
  add_report_options(verb, command->report, "Make or read the family N times and report the median and minimum time");
  add_exact_option(verb, command->report, OperandKind::planar);
  verb.footer(
      "Examples: dymsum family plate.wkt star.wkt --scale 1/10:10 -o x.family -o lives.svg\n"
      "          dymsum family x.family --at 3/2,1.51 --changes topology --json\n"
      "          dymsum family wall.wkt peg.wkt --robot --scaled q --scale 0.9:1.1 --outer 0.99:1.01 -o blocked.wkt");
  verb.callback([command, &action] { action = [command] { return run_family(*command); }; });
}

}  // namespace dymsum::cli
