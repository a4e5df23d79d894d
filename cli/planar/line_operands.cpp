#include "planar/line_operands.h"

#include <iostream>
#include <utility>

#include "dymsum/region_by_lines.h"
#include "dymsum/snap_rounding.h"
#include "numbers.h"

namespace dymsum::cli {
namespace {

Input input_of(RegionByLines made, Input read, bool quiet) {
  read.notes["lines"] = {
      {"tolerance", made.tolerance},     {"largest_move", made.largest_move},
      {"given_edges", made.edges},       {"edges", made.region.vertex_count() + made.region.segments.size()},
      {"loose_edges", made.loose_edges}, {"axes", made.axes.size()}};
  if (!quiet) std::cerr << shown_file(read.file) << ": by lines: " << made.to_string() << "\n";
  read.region = require(snap_rounded(made.region)).region;
  read.result = std::move(made.region);
  return read;
}

}  // namespace

std::vector<Input> read_by_lines(const std::vector<std::string>& files, const InputOptions& options) {
  InputOptions reading = options;
  reading.lines.clear();
  std::vector<Input> inputs;
  std::vector<std::size_t> of;
  std::vector<RegionData> regions;
  for (std::size_t k = 0; k < files.size(); ++k) {
    inputs.push_back(read_operand(files[k], reading));
    if (inputs[k].result) continue;  // whose lines are what they are
    of.push_back(k);
    regions.push_back(inputs[k].region.data());
  }
  LinesOptions how;
  if (options.lines != "auto") how.tolerance = finite_number(options.lines);
  Result<std::vector<RegionByLines>> made = by_lines(regions, how);
  for (std::size_t k = 0; k < of.size() && !made; ++k) {  // whose fault it is
    Result<RegionByLines> alone = by_lines(regions[k], how);
    if (alone) continue;
    Error error = alone.error();
    error.evidence.file = shown_file(files[of[k]]);
    stop_with(error);
  }
  for (std::size_t k = 0; k < of.size(); ++k)
    inputs[of[k]] = input_of(std::move((*made)[k]), std::move(inputs[of[k]]), options.quiet);
  return inputs;
}

}  // namespace dymsum::cli
