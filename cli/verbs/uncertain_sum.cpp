#include "verbs/uncertain_sum.h"

#include <iostream>
#include <optional>

#include "dymsum/snap_rounding.h"
#include "dymsum/sum_io.h"
#include "memory_limit.h"
#include "planar/uncertain_operands.h"
#include "progress_bar.h"
#include "report.h"

namespace dymsum::cli {
namespace {

/// The positions of an erosion, with the answer; of a sum, itself.
struct Computed {
  Uncertain set;
  std::optional<UncertainFit> fit;
};

Computed computed(const SumVerb& verb, const UncertainOperands& operands, const SumOptions& options) {
  if (!verb.empty_is_no)
    return {require_of(operands.inputs, verb.uncertain(operands.p, operands.q, options)), std::nullopt};
  UncertainFit fit = require_of(operands.inputs, fits_anywhere(operands.p, operands.q, options));
  return {fit.positions, fit};
}

const PlanarSum& chosen(const SumCommand& command, const Uncertain& set) {
  return command.set == "inner" ? set.inner() : set.outer();
}

void write_outputs(const SumVerb& verb, const SumCommand& command, const UncertainOperands& operands,
                   const Uncertain& set) {
  for (const std::string& file : command.output.files) {
    OutputOptions one = command.output;
    one.files = {file};
    if (file.ends_with(".svg")) write_text(file, uncertain_picture(set));
    else write_sum(operands.inputs[0].region, operands.inputs[1].region, chosen(command, set), verb.names, one);
  }
}

Json set_json(const PlanarSum& sum, bool exact) {
  Json json = size_json(sum, exact);
  json.update({{"segments", sum.segments.size()}, {"points", sum.points.size()}});
  return json;
}

Json report_json(const SumVerb& verb, const SumCommand& command, const UncertainOperands& operands,
                 const Computed& found, const Timing& timing) {
  const Uncertain& set = found.set;
  Json json = report_head(verb.name, inputs_json(operands.inputs), set.outer().stats.tier_bits, timing);
  json["semantics"] = command.semantics;
  json["uncertain"] = uncertain_json(command.uncertain, operands);
  json.update({{"exact", set.exact()},
               {"error", set.error()},
               {"inner", set_json(set.inner(), command.report.exact)},
               {"outer", set_json(set.outer(), command.report.exact)}});
  if (found.fit) {
    json["fits"] = holds_json(found.fit->answer);
    const auto& at = found.fit->common;
    json["common"] = at ? Json({at->x.to_double(), at->y.to_double()}) : Json();
    json["common_exact"] = at ? Json({at->x.to_string(), at->y.to_string()}) : Json();
  }
  return json;
}

void print_set(std::ostream& out, const std::string& what, const PlanarSum& sum) {
  out << "  " << what << ": " << counted(sum.parts.size(), "part") << ", " << counted(sum.hole_count(), "hole") << ", "
      << counted(sum.vertex_count(), "vertex", "vertices") << ", area " << shown_area(sum);
  if (!sum.segments.empty()) out << ", " << counted(sum.segments.size(), "segment");
  if (!sum.points.empty()) out << ", " << counted(sum.points.size(), "point");
  out << "\n";
}

void print_text(std::ostream& out, const SumVerb& verb, const UncertainOperands& operands, const Computed& found,
                const Timing& timing) {
  const std::vector<Input>& inputs = operands.inputs;
  out << verb.name << " of variants of " << inputs[0].file << " and " << inputs[1].file << ", "
      << (found.set.exact() ? "which have one result" : "which differ") << "\n";
  if (found.fit) {
    out << "  fits " << holds_text(found.fit->answer, operands) << "\n";
    if (const auto& at = found.fit->common)
      out << "  every variant fits at (" << shown(at->x) << ", " << shown(at->y) << ")\n";
  }
  print_set(out, found.fit ? "for all" : "inner", found.set.inner());
  print_set(out, found.fit ? "for some" : "outer", found.set.outer());
  if (found.set.error() > 0) out << "  discs are within " << Json(found.set.error()).dump() << "\n";
  print_times(out, timing);
}

}  // namespace

ExitCode run_uncertain_sum(const SumVerb& verb, const SumCommand& command) {
  refuse_options(*command.parser, {"--engine", "--lines"}, "goes without --tolerance, --fuzz and --variants");
  if (!command.more.empty()) throw Stop(kUsage, "--tolerance, --fuzz and --variants are for two operands");
  for (const std::string& file : command.output.files)
    if (is_stage_picture(file)) throw Stop(kUsage, file + ": sets that are not known exactly have no stages to draw");
  std::ostream& out = report_stream(command.output.files, command.report.json);
  limit_memory(command.memory_mb);
  const UncertainOperands operands = read_uncertain(command.operands, command.uncertain, command.input);
  const InterruptGuard guard;
  SumOptions options;
  options.semantics = named<Semantics>(command.semantics);
  options.memory = memory_bytes(command.memory_mb);
  std::optional<ProgressBar> bar;
  bar.emplace();
  options.progress = bar->callback();
  const auto [found, timing] = timed(command.report.repeat, [&] {
    Computed made = computed(verb, operands, options);
    throw_if_interrupted();
    return made;
  });
  bar.reset();
  write_outputs(verb, command, operands, found.set);
  if (command.report.json) print_report(report_json(verb, command, operands, found, timing));
  else print_text(out, verb, operands, found, timing);
  return found.fit ? exit_code_of(found.fit->answer) : kDone;
}

}  // namespace dymsum::cli
