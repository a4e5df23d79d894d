#include "solid/solid_contains.h"

#include <iostream>
#include <optional>

#include "dymsum/spatial_sum.h"
#include "exact_number.h"
#include "line_file.h"
#include "progress_bar.h"
#include "report.h"
#include "solid/solid_outputs.h"
#include "timing.h"

namespace dymsum::cli {
namespace {

constexpr const char* kWanted = "a place of solids is x,y,z, each a number or a fraction 1/3";

std::vector<RationalPoint3> read_positions(const SolidContains& command) {
  std::vector<RationalPoint3> positions;
  for (const std::string& text : command.at) {
    const std::optional<RationalPoint3> position = exact_position_in_space(text);
    if (!position) throw Stop(kUsage, "--at '" + text + "': " + kWanted);
    positions.push_back(*position);
  }
  if (!command.at_file.empty()) {
    const bool any = for_each_line(file_text(command.at_file), [&](const std::string& text, std::int64_t line) {
      const std::optional<RationalPoint3> position = exact_position_in_space(text);
      if (!position) refuse_line({ErrorCode::malformed, kWanted, {}}, command.at_file, line);
      positions.push_back(*position);
    });
    if (!any) refuse_line({ErrorCode::malformed, "the file holds no questions", {}}, command.at_file, std::nullopt);
  }
  if (positions.empty()) throw Stop(kUsage, "give --at or --at-file");
  return positions;
}

Json answers_json(const std::vector<RationalPoint3>& positions, const std::vector<bool>& inside) {
  Json list = Json::array();
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const RationalPoint3& at = positions[k];
    list.push_back({{"at", {at.x.to_double(), at.y.to_double(), at.z.to_double()}},
                    {"exact", {at.x.to_string(), at.y.to_string(), at.z.to_string()}},
                    {"inside", bool{inside[k]}}});
  }
  return list;
}

void print_text(const std::vector<RationalPoint3>& positions, const std::vector<bool>& inside) {
  const auto precision = std::cout.precision(17);
  for (std::size_t k = 0; k < positions.size(); ++k) {
    std::cout << "(";
    print_exact(std::cout, positions[k].x);
    print_exact(std::cout << ", ", positions[k].y);
    print_exact(std::cout << ", ", positions[k].z);
    std::cout << "): " << (inside[k] ? "inside" : "outside") << "\n";
  }
  std::cout.precision(precision);
}

}  // namespace

ExitCode run_solid_contains(const SolidContains& command) {
  const std::vector<RationalPoint3> positions = read_positions(command);
  const bool open = command.semantics == "open";
  const std::vector<SolidInput> inputs = read_solids_and_results(command.operands, command.input);
  const InterruptGuard guard;
  const auto [inside, timing] = timed(command.report.repeat, [&] {
    Result<std::vector<bool>> made =
        contains_each(inputs[0].operand(), inputs[1].operand(), positions, open ? Semantics::open : Semantics::closed);
    if (!made) stop_with(in_solid_operand(made.error(), inputs));
    return *std::move(made);
  });
  if (command.report.json) {
    Json json = report_head("contains", solid_inputs_json(inputs), 0, timing);
    json.update({{"semantics", open ? "open" : "closed"}, {"answers", answers_json(positions, inside)}});
    print_report(json);
  } else {
    print_text(positions, inside);
    print_times(std::cout, timing);
  }
  return positions.size() == 1 && !inside.front() ? kNo : kDone;
}

}  // namespace dymsum::cli
