// The family of sums that a verb queries: made of two operands, or read from a file.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "dymsum/scaling_family.h"
#include "inputs.h"
#include "timing.h"

namespace dymsum::cli {

struct FamilyInput {
  std::vector<std::string> operands{"", ""};  ///< P and Q, or a file of a family and nothing
  std::string scale, ratio, scaled = "p", semantics = "closed";
  bool robot = false;
  double memory_mb = 0;  ///< 0: no limit
  InputOptions input;
  bool reads() const { return operands[1].empty(); }
};

struct FamilySource {
  std::vector<Input> inputs;  ///< P and Q
  ScalingFamily family;
  Timing timing;  ///< of making it, or of reading it
};

/// Whether a file's name is that of a family.
bool is_family_file(const std::string& file);
/// "A:B", an interval of exact scales; a Stop with wrong usage for what is none.
std::array<Scale, 2> read_interval(const std::string& text, const std::string& option);

/// P and Q, --scale, --ratio, --robot, --scaled, --semantics, --memory and how operands are read.
void add_family_input(CLI::App& verb, FamilyInput& input);
/// A Stop with wrong usage unless it is two operands and --scale, or one file and none of the options of making one.
void check_family_input(const CLI::App& verb, const FamilyInput& input);
/// Made or read `repeat` times, behind a progress bar.
FamilySource family_of(const FamilyInput& input, std::size_t repeat);

}  // namespace dymsum::cli
