// Writing results to the places `-o` names.
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "dymsum/region_io.h"
#include "dymsum/snap_rounding.h"
#include "inputs.h"

namespace dymsum::cli {

struct OutputOptions {
  std::vector<std::string> files;  ///< "-" is standard output
  std::string to = "wkt";          ///< the format of standard output
  bool round_repair = false;       ///< where rounding collapses something: rounded_with_repair before snap_rounded
};

/// A sum in doubles, rounded once and only when an output needs it. Says on standard error where that takes more than
/// the nearest doubles.
class RoundedSum {
 public:
  RoundedSum(const PlanarSum& sum, bool with_repair) : sum_(sum), with_repair_(with_repair) {}

  const Region& region();
  /// What rounding did, where region() was requested and is neither the nearest doubles nor a repair.
  const std::optional<Rounding>& rounding() const { return rounding_; }

 private:
  Region snapped();
  Region repaired();  ///< what cannot be repaired is snapped

  const PlanarSum& sum_;
  bool with_repair_;
  std::optional<Region> region_;
  std::optional<Rounding> rounding_;
};

/// Whether a file's name requests the picture of the stages ("stages.svg", "x.stages.svg").
bool is_stage_picture(const std::string& file);
bool writes_to_stdout(const std::vector<std::string>& files);
/// The stream that the report is printed on: standard error when a result takes standard output. Stops with wrong usage
/// for --json then.
std::ostream& report_stream(const std::vector<std::string>& files, bool json);

/// The format of every output is known: before any long work.
void check_outputs(const OutputOptions& options);

/// Whether an output holds the rounded result: not the exact one, and no picture.
bool writes_rounded(const OutputOptions& options);

/// Every output of a sum: the exact sum for .json, the rounded set otherwise, in pictures beside its operands. Nothing
/// is written before everything is ready; every file is replaced as a whole. Returns what rounding did where it was
/// requested and is no repair.
std::optional<Rounding> write_sum(const Region& p, const Region& q, const PlanarSum& sum, const SumNames& names,
                                  const OutputOptions& options);

void write_text(const std::string& file, const std::string& text);
/// What tells the format of an output: the file's name, or --to for "-".
std::string format_name(const std::string& file, const std::string& to);
/// The planar format of an output; wrong usage for others, which says so where it is one of solids.
RegionFormat output_format(const std::string& file, const OutputOptions& options);

}  // namespace dymsum::cli
