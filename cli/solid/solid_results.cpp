#include "solid/solid_results.h"

#include <iostream>
#include <utility>

#include "dymsum/solid_sum_io.h"
#include "exit_code.h"

namespace dymsum::cli {
namespace {

void refuse_options_of_doubles(const std::string& file, const InputOptions& options) {
  const std::pair<bool, const char*> given[] = {
      {!options.snap.empty(), "--snap"}, {options.hull, "--hull"}, {!options.planes.empty(), "--planes"}};
  for (const auto& [is_given, name] : given)
    if (is_given)
      throw Stop(kUsage, std::string(name) + " is for coordinates in doubles, and " + shown_file(file) +
                             " holds an exact result; dymsum convert writes it in doubles, as .off");
}

std::size_t tight_features(const SpatialSum& sum) {
  return sum.tight_faces.size() + sum.tight_segments.size() + sum.tight_points.size();
}

}  // namespace

bool holds_solid_result(const std::string& file, const InputOptions& options) {
  if (file != "-") return names_solid_sum(file);
  return (options.from.empty() || options.from == "json") && begins_like_solid_sum(without_mark(standard_input()));
}

SpatialSum read_solid_result(const std::string& file, const InputOptions& options) {
  refuse_options_of_doubles(file, options);
  Result<SpatialSum> sum = file == "-" ? parse_solid_sum(standard_input(), "standard input") : read_solid_sum(file);
  if (sum) return *std::move(sum);
  stop_with(sum.error());
}

SolidInput result_operand(const std::string& file, const InputOptions& options) {
  SpatialSum sum = read_solid_result(file, options);
  SolidInput input{file, Mesh()};
  if (Result<Mesh> mesh = as_mesh(sum)) input.mesh = *std::move(mesh);
  else input.fractions = true;
  if (input.fractions || tight_features(sum) > 0) input.result = std::move(sum);
  return input;
}

void refuse_fractions(const std::vector<SolidInput>& inputs, bool quiet) {
  for (const SolidInput& input : inputs) {
    if (input.fractions)
      throw Stop(
          kBadInput,
          shown_file(input.file) +
              (input.notes.contains("planes") ? ": by its planes, the vertices of this solid are fractions, which "
                                              : ": the vertices of this exact result are fractions, which ") +
              "sum, nfp, erode, opening, closing, offset, union, intersect, subtract, contains, "
              "depth, slice, info, convert and check take; others take it in doubles, as dymsum convert FILE.json "
              "FILE.off writes it");
  }
  report_left_out(inputs, quiet);
}

void report_left_out(const std::vector<SolidInput>& inputs, bool quiet) {
  for (const SolidInput& input : inputs)
    if (!quiet && input.result && tight_features(*input.result) > 0)
      std::cerr << shown_file(input.file) << ": " << counted(tight_features(*input.result), "tight feature")
                << " left out: an operand here is the solid, without what is tight\n";
}

}  // namespace dymsum::cli
