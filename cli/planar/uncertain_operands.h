// Operands that are not known exactly: tolerances, rounding, and files of variants, as options say.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "dymsum/uncertain.h"
#include "dymsum/uncertain_answers.h"
#include "inputs.h"
#include "json_report.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

struct UncertainOptions {
  std::string tolerance, fuzz;
  std::vector<std::string> variants, first_variants;
  bool given() const { return !(tolerance.empty() && fuzz.empty() && variants.empty() && first_variants.empty()); }
};

/// What --tolerance says of both operands. Stops with wrong usage for what is no tolerance.
std::array<Tolerance, 2> read_tolerances(const std::string& text);
/// A file of tolerances, "+A/-B" or "A" on a line. Stops with bad input for others.
std::vector<Tolerance> read_tolerance_file(const std::string& file);

/// Declares --tolerance, --fuzz, --variants and --first-variants. `first` and `second` are the names of the operands.
void add_uncertain_options(CLI::App& verb, UncertainOptions& options, const std::string& first,
                           const std::string& second);
/// Their names, for operands that they are not for.
inline const std::vector<std::string> kUncertainOptions{"--tolerance", "--fuzz", "--variants", "--first-variants"};

/// Stops with wrong usage where these options are given and an output is the viewer, which has no such sets.
void refuse_pages(const UncertainOptions& options, const std::vector<std::string>& files);

/// Both operands, and all files that were read: first, second, then variants.
struct UncertainOperands {
  std::vector<Input> inputs;
  Uncertain p, q;
};
/// Stops with wrong usage for options that say nothing, and for exact results; with bad input as read_inputs.
UncertainOperands read_uncertain(const std::vector<std::string>& operands, const UncertainOptions& options,
                                 const InputOptions& input);

/// What the options say, as reports repeat it: "tolerance", "fuzz", "variants" (how many of each operand).
Json uncertain_json(const UncertainOptions& options, const UncertainOperands& operands);

/// {"holds", "yes", "no"}: pairs are {"p", "q"}, each an index, "inner" or "outer"; null where there is none.
Json holds_json(const UncertainAnswer& answer);
Json pair_json(const VariantPair& pair);
/// "for all variants"; "for some: not for p.wkt with q.wkt".
std::string holds_text(const UncertainAnswer& answer, const UncertainOperands& operands);
/// Exit code 4 where it holds for none, 0 else.
ExitCode exit_code_of(const UncertainAnswer& answer);

/// The sets as a picture: what is in every variant dark, what is doubtful light.
std::string uncertain_picture(const Uncertain& set);

}  // namespace dymsum::cli
