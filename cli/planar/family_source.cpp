#include "planar/family_source.h"

#include <optional>
#include <utility>

#include "dymsum/family_file.h"
#include "memory_limit.h"
#include "options.h"
#include "progress_bar.h"
#include "solid/solid_limits.h"
#include "solid/solid_operands.h"
#include "verbs/scale_command.h"

namespace dymsum::cli {
namespace {

FamilyOptions options_of(const FamilyInput& input) {
  FamilyOptions options;
  options.moving = named<MovingOperand>(input.scaled);
  options.reflect_q = input.robot;
  options.semantics = named<Semantics>(input.semantics);
  options.memory = memory_bytes(input.memory_mb);
  return options;
}

FamilySource made_family(const FamilyInput& input, std::size_t repeat) {
  const auto [low, high] = read_interval(input.scale, "--scale");
  const Scale ratio = input.ratio.empty() ? Scale() : read_scale(input.ratio, "--ratio");
  std::vector<Input> inputs = read_inputs(input.operands, input.input);
  std::optional<ProgressBar> bar(std::in_place);
  FamilyOptions options = options_of(input);
  options.progress = bar->callback();
  auto [family, timing] = timed(repeat, [&, low = low, high = high] {
    return require_of(inputs, ScalingFamily::create(inputs[0].region, inputs[1].region, low, high, ratio, options));
  });
  return {std::move(inputs), std::move(family), timing};
}

}  // namespace

bool is_family_file(const std::string& file) { return file.ends_with(".family") || file.ends_with(".family.gz"); }

std::array<Scale, 2> read_interval(const std::string& text, const std::string& option) {
  const std::vector<std::string> ends = split(text, ':');
  if (ends.size() != 2) throw Stop(kUsage, option + " wants A:B, such as 1:3/2, not '" + text + "'");
  const Scale low = read_scale(ends[0], option), high = read_scale(ends[1], option);
  if (low.exact() > high.exact()) throw Stop(kUsage, option + " begins after its end: " + text);
  return {low, high};
}

void add_family_input(CLI::App& verb, FamilyInput& input) {
  const char* const file = "a file, FILE#NAME for one shape of several, or - for standard input";
  verb.add_option("P", input.operands[0],
                  std::string("The region that scales, unless --scaled q: ") + file +
                      "; or without Q a .family file that was written before")
      ->type_name("");
  verb.add_option("Q", input.operands[1], std::string("The other one: ") + file)->type_name("");
  verb.add_option("--scale", input.scale, "The scales of the family, exact: 1/10:10")->type_name("A:B");
  verb.add_option("--ratio", input.ratio, "y scales by R times as much as x, diag(s, R s); exact")->type_name("R");
  verb.add_flag("--robot", input.robot, "Q is a robot and P an obstacle: sums with -Q");
  one_of<MovingOperand>(verb.add_option("--scaled", input.scaled, "Which operand scales"))->capture_default_str();
  one_of<Semantics>(verb.add_option("--semantics", input.semantics, "closed, open or regular"))->capture_default_str();
  add_memory_limit(verb, input.memory_mb);
  add_input_options(verb, input.input);
}

void check_family_input(const CLI::App& verb, const FamilyInput& input) {
  const std::string& first = input.operands[0];
  if (first.empty() || (input.reads() && first != "-" && !is_family_file(first)))
    throw Stop(kUsage, "family wants P, Q and --scale A:B, or one file that it wrote: FILE.family");
  if (input.reads()) {
    refuse_options(verb,
                   {"--scale", "--ratio", "--robot", "--scaled", "--semantics", "--repair", "--fill", "--join",
                    "--snap", "--curve-error", "--curve-bound", "--drop-z", "--from"},
                   "is for making a family, not for one that is read");
    return;
  }
  for (const std::string& operand : input.operands)
    if (is_family_file(operand))
      throw Stop(kUsage, operand + " is a family, which stands alone: give no other operand");
  if (input.scale.empty()) throw Stop(kUsage, "family wants --scale A:B, the scales of the family: --scale 1/10:10");
  require_planar("family", input.operands);
}

FamilySource family_of(const FamilyInput& input, std::size_t repeat) {
  if (!input.reads()) return made_family(input, repeat);
  const std::string& file = input.operands[0];
  auto [family, timing] = timed(repeat, [&] {
    return require(file == "-" ? parse_family(standard_input(), shown_file(file)) : read_family(file));
  });
  std::vector<Input> inputs{{file + "#p", family.p()}, {file + "#q", family.q()}};
  return {std::move(inputs), std::move(family), timing};
}

}  // namespace dymsum::cli
