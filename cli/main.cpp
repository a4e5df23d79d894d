// dymsum VERB INPUTS [options]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <csignal>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "arguments.h"
#include "dymsum/version.h"
#include "exit_code.h"
#include "json_report.h"
#include "memory_limit.h"
#include "progress_bar.h"
#include "suggestion.h"
#include "verbs/commands.h"

namespace {

using namespace dymsum::cli;

constexpr const char* kFooter =
    "Files: planar .poly .wkt .geojson .svg .json (nesting instances) .dxf .gpkg, maps .yaml .map; FILE#NAME selects "
    "one "
    "shape of "
    "several; - is standard\n"
    "input or output; solid .off .obj .stl .ply .glb .3mf; any of them also compressed, .gz. Results go to standard "
    "output, messages to "
    "standard error.\n"
    "Exit: 0 done, 1 wrong usage, 2 bad input, 3 a defect of dymsum, 4 the answer is no, 5 undecided, 130 "
    "interrupted.\n"
    "Example: dymsum sum gear.poly disc.wkt --json -o sum.svg -o stages.svg";

struct Verb {
  const char* name;
  void (*add)(CLI::App&, Action&);
};

constexpr Verb kVerbs[] = {{"sum", add_sum},
                           {"nfp", add_nfp},
                           {"erode", add_erode},
                           {"union", add_union},
                           {"intersect", add_intersect},
                           {"subtract", add_subtract},
                           {"nfp-table", add_nfp_table},
                           {"disc", add_disc},
                           {"opening", add_opening},
                           {"closing", add_closing},
                           {"offset", add_offset},
                           {"scale", add_scale},
                           {"family", add_family},
                           {"edit", add_edit},
                           {"scale-range", add_scale_range},
                           {"rotate", add_rotate},
                           {"slice", add_slice},
                           {"cspace", add_cspace},
                           {"clearance", add_clearance},
                           {"angles", add_angles},
                           {"path", add_path},
                           {"depth", add_depth},
                           {"robustness", add_robustness},
                           {"stack", add_stack},
                           {"local-sum", add_local_sum},
                           {"contains", add_contains},
                           {"check", add_check},
                           {"check-sum", add_check_sum},
                           {"check-nfp", add_check_nfp},
                           {"check-fit", add_check_fit},
                           {"check-offset", add_check_offset},
                           {"check-mesh", add_check_mesh},
                           {"features", add_features},
                           {"decompose", add_decompose},
                           {"info", add_info},
                           {"convert", add_convert},
                           {"hull", add_hull},
                           {"view", add_view}};

/// Adds the verb of that name, or all of them where none has it: to describe all options of all verbs takes a
/// millisecond.
void add_verbs(CLI::App& app, const std::string& name, Action& action) {
  const auto one =
      std::find_if(std::begin(kVerbs), std::end(kVerbs), [&](const Verb& verb) { return verb.name == name; });
  if (one != std::end(kVerbs)) return one->add(app, action);
  for (const Verb& verb : kVerbs) verb.add(app, action);
}

/// The verb of a command line, known or not; empty where it begins with an option or with nothing.
std::string verb_of(int argc, char** argv) { return argc < 2 || argv[1][0] == '-' ? "" : argv[1]; }

/// The option that a word gives: "--name" of "--name=value", "-o" of "-ofile"; empty where it gives none.
std::string option_in(const std::string& word) {
  if (word.starts_with("--")) return word.substr(0, word.find('='));
  const bool is_short = word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
  return is_short ? word.substr(0, 2) : "";
}

bool wants_json(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](const std::string& word) { return option_in(word) == "--json"; });
}

/// Refuses a verb that is none of ours: the error gives its name, and what may be meant.
void check_verb(const std::string& verb) {
  std::vector<std::string> names;
  for (const Verb& known : kVerbs) names.push_back(known.name);
  if (verb.empty() || std::find(names.begin(), names.end(), verb) != names.end()) return;
  std::string all;
  for (const std::string& name : names) all += " " + name;
  throw Stop(kUsage, "unknown verb '" + verb + "'" + did_you_mean(verb, names) + "\nThe verbs are" + all);
}

/// Whether a verb has neither outputs nor a page of its own making, as view has.
bool writes_nothing(const CLI::App& verb) {
  return verb.get_option_no_throw("-o") == nullptr && verb.get_option_no_throw("OUT") == nullptr &&
         verb.get_name() != "view";
}

/// The first option that the verb does not have, with what may be meant.
std::string unknown_option(const CLI::App& verb, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  for (int i = 2; i < argc; ++i) {
    if (std::string(argv[i]).starts_with("-#"))
      return std::string(argv[i]) + ": a shape is selected from a file, as FILE#NAME, not from standard input";
    const std::string option = option_in(argv[i]);
    if (option == "-o" && writes_nothing(verb))
      return verb.get_name() + " has no option -o: it prints its answer, and writes neither files nor pages";
    if (option.empty() || std::find(names.begin(), names.end(), option) != names.end()) continue;
    const std::string meant = option.starts_with("--") ? did_you_mean(option, names) : "";
    return verb.get_name() + " has no option " + option + meant;
  }
  return "";
}

/// A command line that cannot be read: what is wrong, how the verb is used, and where more is said.
Stop wrong_usage(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const std::string verb = verb_of(argc, argv);
  if (verb.empty()) return {kUsage, std::string(error.what()) + "\ndymsum --help lists the verbs"};
  const CLI::App& parser = *app.get_subcommand(verb);
  // A word that is no option of the verb may also leave an operand missing.
  const bool misread = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                       dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  std::string what = misread ? unknown_option(parser, argc, argv) : "";
  if (what.empty()) what = error.what();
  std::string usage = "dymsum " + verb;
  for (const CLI::Option* option : parser.get_options(&CLI::Option::get_positional))
    usage += " " + (option->get_required() ? option->get_name(true) : "[" + option->get_name(true) + "...]");
  return {kUsage, what + "\nUsage: " + usage + " [options]; " + "dymsum " + verb + " --help says more"};
}

/// Help that is the same in every run: CLI11 lists the options that exclude each other by where they are in memory.
class HelpText : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string text = CLI::Formatter::make_option_opts(option);
    const std::string label = " " + get_label("Excludes") + ":";
    const std::size_t at = text.find(label);
    if (at == std::string::npos) return text;
    std::vector<std::string> names;
    for (const CLI::Option* other : option->get_excludes()) names.push_back(other->get_name());
    std::sort(names.begin(), names.end());
    std::string sorted = text.substr(0, at) + label;
    for (const std::string& name : names) sorted += " " + name;
    return sorted;
  }
};

ExitCode run(int argc, char** argv) {
  CLI::App app("dymsum: exact Minkowski sums of planar regions and of solids, and of both in motion", "dymsum");
  app.formatter(std::make_shared<HelpText>());
  app.require_subcommand(1);
  app.set_version_flag("--version", DYMSUM_VERSION);
  app.footer(kFooter);
  Action action;
  check_verb(verb_of(argc, argv));
  if (argc < 2 || std::string(argv[1]) != "--version") add_verbs(app, verb_of(argc, argv), action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw wrong_usage(app, error, argc, argv);
    app.exit(error);  // help and version
    return kDone;
  }
  check_arguments(*app.get_subcommands().front());
  if (wants_json(argc, argv))
    print_when_interrupted(report_text(failure_json(verb_of(argc, argv), Stop(kInterrupted, "interrupted"))));
  return action();
}

/// `dymsum help [VERB]` is `dymsum [VERB] --help`, and `dymsum help check sum` that of these two words.
std::vector<char*> as_option_help(std::vector<char*> words) {
  static std::string help = "--help";
  if (words.size() < 2 || std::string(words[1]) != "help") return words;
  if (words.size() > 4 || (words.size() == 4 && std::string(words[2]) != "check")) return words;
  words.erase(words.begin() + 1);
  words.push_back(help.data());
  return words;
}

/// `dymsum check sum` is `dymsum check-sum`, and so on for what else is checked.
std::vector<char*> with_whole_verb(std::vector<char*> words) {
  static std::string verb;
  if (words.size() < 3 || std::string(words[1]) != "check") return words;
  verb = "check-" + std::string(words[2]);
  if (std::none_of(std::begin(kVerbs), std::end(kVerbs), [&](const Verb& known) { return known.name == verb; }))
    return words;
  words.erase(words.begin() + 1);
  words[1] = verb.data();
  return words;
}

/// The stop where memory did not suffice, with the limit that was reached, if one was.
Stop with_memory_limit(const Stop& stop) {
  const std::string reached = memory_limit_reached(), message = stop.what();
  if (reached.empty() || message.find("memory") == std::string::npos || message.find("limit") != std::string::npos)
    return stop;
  if (!stop.error()) return {stop.code(), message + ": " + reached};
  return {stop.code(), message + ": " + reached, *stop.error()};
}

/// Tells on standard error why the command ended, and with --json as an object on standard output.
ExitCode report(const Stop& ended, int argc, char** argv) {
  lift_memory_limit();
  const Stop stop = with_memory_limit(ended);
  if (wants_json(argc, argv)) print_report(failure_json(verb_of(argc, argv), stop));
  std::cout.flush();
  std::cerr << (stop.code() == kBadInput ? "" : "dymsum: ") << stop.what() << "\n";
  return stop.code();
}

}  // namespace

int main(int count, char** given) {
  std::vector<char*> words = with_whole_verb(as_option_help({given, given + count}));
  const int argc = static_cast<int>(words.size());
  words.push_back(nullptr);
  char** argv = words.data();
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on sizes of files is an error of writing
  try {
    const ExitCode code = run(argc, argv);
    if (!std::cout.flush()) throw Stop(kBadInput, "cannot write to standard output");
    return code;
  } catch (const Stop& stop) {
    return report(stop, argc, argv);
  } catch (const std::bad_alloc&) {
    const std::string what = "out of memory in `dymsum " + verb_of(argc, argv) + "`";
    const bool limited = !memory_limit_reached().empty();
    return report(Stop(kBadInput, limited ? what : what + ": the inputs, or what comes of them, are too large",
                       dymsum::Error{dymsum::ErrorCode::out_of_memory, what, {}}),
                  argc, argv);
  } catch (const std::exception& error) {
    return report(Stop(kDefect, std::string("this is a defect of dymsum: ") + error.what()), argc, argv);
  }
}
