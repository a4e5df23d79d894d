// What sum, nfp, erode and slice share: their options, and running one of them.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dymsum/orientation.h"
#include "dymsum/planar_operand.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"
#include "exit_code.h"
#include "inputs.h"
#include "options.h"
#include "outputs.h"
#include "planar/uncertain_operands.h"

namespace CLI {
class App;
}

namespace dymsum::cli {

/// What makes a verb of this kind.
struct SumVerb {
  std::string name;
  Operand first, second;
  std::string description, footer;
  /// The public function it calls, of regions and results: two, or where it takes several more.
  std::function<Result<PlanarSum>(std::span<const PlanarOperand>, const SumOptions&)> planar;
  std::function<Result<SpatialSum>(const Mesh&, const Mesh&, const SpatialOptions&)> solid;  ///< of solids
  /// The same of exact results, where it is no sum.
  std::function<Result<SpatialSum>(const SpatialOperand&, const SpatialOperand&, const SpatialOptions&)> result;
  bool boolean = false;    ///< a Boolean operation, which has no convolution
  bool two_steps = false;  ///< made of two operations: neither has the convolution, nor the stages, of the operands
  /// Of any number of solids and results; without it more than two are added.
  std::function<Result<SpatialSum>(std::span<const SpatialOperand>, const SpatialOptions&)> solids;
  std::string semantics = "closed";        ///< where --semantics is not given
  bool reflects_second = false;            ///< the convolution behind it is that of P and -Q
  bool empty_is_no = false;                ///< an empty result ends with kNo
  bool planar_result = false;              ///< of solids, too
  bool is_sum = false;                     ///< of solids: takes parts without volume, and keeps convex faces whole
  bool several = false;                    ///< takes more than two operands
  std::string page, solid_page;            ///< of the viewer that shows regions, and solids
  std::optional<Orientation> orientation;  ///< of the operand that is turned, for the report
  SumNames names;                          ///< in pictures
  /// Of regions that are not known exactly; no function: there is none.
  std::function<Result<Uncertain>(const Uncertain&, const Uncertain&, const SumOptions&)> uncertain = {};
  /// The operands as pictures show them and as the convolution is counted; empty: as they are read.
  std::function<std::array<Region, 2>(const Region&, const Region&)> shown;
};

/// What the command line requests of it.
struct SumCommand {
  const CLI::App* parser = nullptr;  ///< which options were given
  std::vector<std::string> operands{"", ""}, more;
  bool triangulate = false;
  double memory_mb = 0;  ///< 0: no limit
  double round = 0;      ///< of solids: as SolidOutput
  std::string engine = "fast", semantics = "closed";
  UncertainOptions uncertain;
  std::string set = "outer";  ///< which of both is written
  ReportOptions report;
  InputOptions input;
  OutputOptions output;
};

/// Declares the verb with its operands and all options.
CLI::App& declare_sum_verb(CLI::App& app, const SumVerb& verb, SumCommand& command);
/// Adds the verb, which needs no further options.
void add_sum_verb(CLI::App& app, const SumVerb& verb, Action& action);

/// The action with -o FILE.html as the viewer.
Action with_viewer(const SumVerb& verb, SumCommand& command, const Action& action);

/// Reads, computes, writes the outputs and reports.
ExitCode run_sum(const SumVerb& verb, const SumCommand& command);

}  // namespace dymsum::cli
