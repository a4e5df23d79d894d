#include "verbs/features_command.h"

#include <map>

#include "inputs.h"

namespace dymsum::cli {
namespace {

const std::map<std::string, Concavity> kConcavities{{"straight", Concavity::straight_line},
                                                    {"shortest", Concavity::shortest_path},
                                                    {"hybrid1", Concavity::hybrid1},
                                                    {"hybrid2", Concavity::hybrid2}};

}  // namespace

Rational read_number(const std::string& text, const std::string& option) {
  Rational value = require_option(Rational::parse(text), option);
  if (value.sign() < 0) throw Stop(kUsage, option + " wants a number of at least 0, not '" + text + "'");
  return value;
}

Selection selection_of(const FeaturesCommand& command) {
  Selection s{read_number(command.tau, "--tau"), read_number(command.from, "--alpha-from"), std::nullopt};
  if (!command.to.empty()) s.to = read_number(command.to, "--alpha-to");
  if (s.to && *s.to < s.from) throw Stop(kUsage, "--alpha-to is below --alpha-from");
  if (command.hybrid_tolerance && command.concavity != "hybrid2")
    throw Stop(kUsage, "--hybrid-tolerance is for --concavity hybrid2");
  return s;
}

FeatureOptions options_of(const FeaturesCommand& command) {
  FeatureOptions options;
  options.concavity = kConcavities.at(command.concavity);
  options.hybrid_tolerance = command.hybrid_tolerance.value_or(0);
  return options;
}

void add_shared_options(CLI::App& verb, FeaturesCommand& command, const std::string& least) {
  verb.add_option("P", command.operand, "The region: a file, or - for standard input")->required()->type_name("");
  verb.add_option("--tau", command.tau, least)->type_name("T");
  verb.add_option("--alpha-from", command.from, "Count lives from this diameter on")->type_name("A");
  verb.add_option("--alpha-to", command.to, "Count lives up to this diameter")->type_name("B");
  verb.add_option("--concavity", command.concavity, "How the deepest vertex of a pocket is found")
      ->check(CLI::IsMember({"straight", "shortest", "hybrid1", "hybrid2"}))
      ->capture_default_str();
  within(verb.add_option("--hybrid-tolerance", command.hybrid_tolerance,
                         "Of hybrid2: pockets no deeper than this are measured by shortest paths"),
         0)
      ->type_name("D");
  add_report_options(verb, command.report, "Compute N times and report the median and minimum time");
  add_input_options(verb, command.input);
}

}  // namespace dymsum::cli
