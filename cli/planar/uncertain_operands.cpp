#include "planar/uncertain_operands.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "line_file.h"
#include "numbers.h"
#include "pictures/marked_drawing.h"
#include "report.h"

namespace dymsum::cli {
namespace {

/// "+0.1", "-0.05", "0.1".
std::optional<double> deviation_in(const std::string& text) {
  return finite_number(text.starts_with('+') ? text.substr(1) : text);
}

/// "+A/-B": the upper and the lower deviation; "A" alone: both, "0" none.
std::optional<Tolerance> tolerance_in(const std::string& text) {
  const std::vector<std::string> ends = split(text, '/');
  std::optional<double> upper = deviation_in(ends[0]), lower;
  if (ends.size() == 2) lower = deviation_in(ends[1]);
  else if (ends.size() == 1 && upper && *upper >= 0) lower = -*upper;
  if (!upper || !lower) return std::nullopt;
  return Tolerance{*upper, *lower};
}

/// One value for both operands, or one for each.
template <class T, class Read>
std::array<T, 2> of_both(const std::string& text, const std::string& option, const std::string& wants,
                         const Read& read) {
  const std::vector<std::string> words = split(text, ',');
  std::vector<T> values;
  for (const std::string& word : words)
    if (const std::optional<T> value = read(word)) values.push_back(*value);
  if (values.size() != words.size() || words.size() > 2)
    throw Stop(kUsage, option + " wants " + wants + ", for both operands or for each of them, not '" + text + "'");
  return {values.front(), values.back()};
}

std::array<std::int64_t, 2> read_fuzz(const std::string& text) {
  return of_both<std::int64_t>(text, "--fuzz", "a number of units in the last place from 0 to 1000000",
                               [](const std::string& word) -> std::optional<std::int64_t> {
                                 const std::optional<double> value = finite_number(word);
                                 if (!value || *value < 0 || *value > 1e6 || *value != std::trunc(*value))
                                   return std::nullopt;
                                 return static_cast<std::int64_t>(*value);
                               });
}

Error in_file(Error error, const Input& input) {
  if (error.evidence.file.empty()) error.evidence.file = shown_file(input.file);
  return error;
}

Uncertain require_in(Result<Uncertain> made, const Input& input) {
  if (!made) stop_with(in_file(made.error(), input));
  return *std::move(made);
}

/// The operand `k`, and its variants from `from` to `to` among all inputs.
Uncertain uncertain_of(const UncertainOptions& options, const std::vector<Input>& inputs, std::size_t k,
                       std::size_t from, std::size_t to) {
  const Region& region = inputs[k].region;
  if (!options.tolerance.empty())
    return require_option(Uncertain::of_band(region, read_tolerances(options.tolerance)[k]), "--tolerance");
  if (!options.fuzz.empty()) return require_in(Uncertain::of_rounding(region, read_fuzz(options.fuzz)[k]), inputs[k]);
  std::vector<Region> variants{region};
  for (std::size_t i = from; i < to; ++i) variants.push_back(inputs[i].region);
  return require_in(Uncertain::of_variants(std::move(variants)), inputs[k]);
}

std::string set_name(std::uint32_t index) { return index == VariantPair::kInner ? "inner" : "outer"; }
bool is_set(std::uint32_t index) { return index >= VariantPair::kInner; }

/// A variant of an operand in words: its file, or the set that stands for it.
std::string variant_text(std::uint32_t index, std::size_t operand, const UncertainOperands& operands) {
  const std::vector<Input>& inputs = operands.inputs;
  if (is_set(index)) return (index == VariantPair::kInner ? "the smallest " : "the largest ") + inputs[operand].file;
  if (index == 0) return inputs[operand].file;
  const std::size_t before = operand == 0 ? 0 : operands.p.variants().size() - 1;
  return inputs[2 + before + index - 1].file;
}

}  // namespace

std::array<Tolerance, 2> read_tolerances(const std::string& text) {
  return of_both<Tolerance>(text, "--tolerance", "+A/-B", tolerance_in);
}

std::vector<Tolerance> read_tolerance_file(const std::string& file) {
  std::vector<Tolerance> tolerances;
  const bool any = for_each_line(file_text(file), [&](const std::string& text, std::int64_t line) {
    const std::vector<std::string> words = words_of(text);
    const std::optional<Tolerance> tolerance = words.size() == 1 ? tolerance_in(words[0]) : std::nullopt;
    if (!tolerance)
      refuse_line({ErrorCode::malformed, "a tolerance is +A/-B, each with its sign, or A both ways", {}}, file, line);
    if (tolerance->lower > tolerance->upper)
      refuse_line({ErrorCode::out_of_range, "the lower deviation is larger than the upper one: write +A/-B", {}}, file,
                  line);
    tolerances.push_back(*tolerance);
  });
  if (!any) refuse_line({ErrorCode::malformed, "the file holds no tolerances", {}}, file, std::nullopt);
  return tolerances;
}

void add_uncertain_options(CLI::App& verb, UncertainOptions& options, const std::string& first,
                           const std::string& second) {
  CLI::Option* tolerance = verb.add_option(
      "--tolerance", options.tolerance,
      "Regions: boundaries are off by +A outside to -B inside, each with its sign, or by A both ways; with a comma "
      "one for " +
          first + " and one for " + second + ": +0.1/0,-0.02/-0.05. Reports what holds for all, some and no variants");
  tolerance->type_name("+A/-B");
  CLI::Option* fuzz = verb.add_option("--fuzz", options.fuzz,
                                      "Regions: the same where every coordinate is off by up to N units in the last "
                                      "place; with a comma for each operand");
  fuzz->type_name("N")->excludes(tolerance);
  for (CLI::Option* variants : {verb.add_option("--variants", options.variants,
                                                "Regions: the same where " + second + " may be any of these, too"),
                                verb.add_option("--first-variants", options.first_variants,
                                                "Regions: the same where " + first + " may be any of these, too")})
    variants->type_name("FILE...")->excludes(tolerance)->excludes(fuzz);
}

void refuse_pages(const UncertainOptions& options, const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (options.given() && file.ends_with(".html"))
      throw Stop(kUsage, file + ": the viewer shows no sets that are not known exactly; write a picture, .svg");
}

UncertainOperands read_uncertain(const std::vector<std::string>& operands, const UncertainOptions& options,
                                 const InputOptions& input) {
  if (!options.tolerance.empty()) read_tolerances(options.tolerance);
  if (!options.fuzz.empty()) read_fuzz(options.fuzz);
  std::vector<std::string> files = operands;
  files.insert(files.end(), options.first_variants.begin(), options.first_variants.end());
  files.insert(files.end(), options.variants.begin(), options.variants.end());
  std::vector<Input> inputs = read_inputs(files, input);
  const std::size_t split_at = 2 + options.first_variants.size();
  Uncertain p = uncertain_of(options, inputs, 0, 2, split_at);
  Uncertain q = uncertain_of(options, inputs, 1, split_at, inputs.size());
  return {std::move(inputs), std::move(p), std::move(q)};
}

Json uncertain_json(const UncertainOptions& options, const UncertainOperands& operands) {
  const auto text = [](const std::string& given) { return given.empty() ? Json() : Json(given); };
  return {{"tolerance", text(options.tolerance)},
          {"fuzz", text(options.fuzz)},
          {"variants", {operands.p.variants().size(), operands.q.variants().size()}}};
}

Json pair_json(const VariantPair& pair) {
  const auto one = [](std::uint32_t index) { return is_set(index) ? Json(set_name(index)) : Json(index); };
  return {{"p", one(pair.p)}, {"q", one(pair.q)}};
}

Json holds_json(const UncertainAnswer& answer) {
  return {{"holds", name(answer.holds)},
          {"yes", answer.yes ? pair_json(*answer.yes) : Json()},
          {"no", answer.no ? pair_json(*answer.no) : Json()}};
}

std::string holds_text(const UncertainAnswer& answer, const UncertainOperands& operands) {
  const auto pair = [&](const VariantPair& of) {
    return variant_text(of.p, 0, operands) + " with " + variant_text(of.q, 1, operands);
  };
  if (answer.holds == Holds::for_all) return "for all variants";
  if (answer.holds == Holds::for_none) return "for no variant";
  return "for some variants: " + pair(*answer.yes) + ", but not " + pair(*answer.no);
}

ExitCode exit_code_of(const UncertainAnswer& answer) { return answer.holds == Holds::for_none ? kNo : kDone; }

std::string uncertain_picture(const Uncertain& set) {
  const PlanarSum between = require(set.doubtful());
  const Drawn outer = drawn(set.outer()), inner = drawn(set.inner()), doubtful = drawn(between);
  Box seen;
  for (const Drawn* part : {&outer, &inner, &doubtful}) seen.see(part->box);
  MarkedDrawing drawing(seen);
  drawing.add(inner, "fill=\"#6b8fb5\" stroke=\"#2f5d8a\"");
  drawing.add(doubtful, "fill=\"#e8a33d\" fill-opacity=\"0.5\" stroke=\"none\"");
  drawing.add(outer, "fill=\"none\" stroke=\"#a8650a\"");
  return drawing.text();
}

}  // namespace dymsum::cli
