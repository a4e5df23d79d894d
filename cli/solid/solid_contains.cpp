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

std::vector<RationalPoint3> read_places(const SolidContains& command) {
  std::vector<RationalPoint3> places;
  for (const std::string& text : command.at) {
    const std::optional<RationalPoint3> place = exact_place_in_space(text);
    if (!place) throw Stop(kUsage, "--at '" + text + "': " + kWanted);
    places.push_back(*place);
  }
  if (!command.at_file.empty()) {
    const bool any = for_each_line(file_text(command.at_file), [&](const std::string& text, std::int64_t line) {
      const std::optional<RationalPoint3> place = exact_place_in_space(text);
      if (!place) refuse_line({ErrorCode::malformed, kWanted, {}}, command.at_file, line);
      places.push_back(*place);
    });
    if (!any) refuse_line({ErrorCode::malformed, "the file holds no questions", {}}, command.at_file, std::nullopt);
  }
  if (places.empty()) throw Stop(kUsage, "give --at or --at-file");
  return places;
}

Json answers_json(const std::vector<RationalPoint3>& places, const std::vector<bool>& inside) {
  Json list = Json::array();
  for (std::size_t k = 0; k < places.size(); ++k) {
    const RationalPoint3& at = places[k];
    list.push_back({{"at", {at.x.to_double(), at.y.to_double(), at.z.to_double()}},
                    {"exact", {at.x.to_string(), at.y.to_string(), at.z.to_string()}},
                    {"inside", bool{inside[k]}}});
  }
  return list;
}

void print_text(const std::vector<RationalPoint3>& places, const std::vector<bool>& inside) {
  const auto precision = std::cout.precision(17);
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::cout << "(";
    print_exact(std::cout, places[k].x);
    print_exact(std::cout << ", ", places[k].y);
    print_exact(std::cout << ", ", places[k].z);
    std::cout << "): " << (inside[k] ? "inside" : "outside") << "\n";
  }
  std::cout.precision(precision);
}

}  // namespace

ExitCode run_solid_contains(const SolidContains& command) {
  const std::vector<RationalPoint3> places = read_places(command);
  const bool open = command.semantics == "open";
  const std::vector<SolidInput> inputs = read_solids(command.operands, command.input);
  const InterruptGuard guard;
  const auto [inside, timing] = timed(command.report.repeat, [&] {
    Result<std::vector<bool>> made =
        contains_each(inputs[0].mesh, inputs[1].mesh, places, open ? Semantics::open : Semantics::closed);
    if (!made) stop_with(in_solid_operand(made.error(), inputs));
    return *std::move(made);
  });
  if (command.report.json) {
    Json json = report_head("contains", solid_inputs_json(inputs), 0, timing);
    json.update({{"semantics", open ? "open" : "closed"}, {"answers", answers_json(places, inside)}});
    print_report(json);
  } else {
    print_text(places, inside);
    print_times(std::cout, timing);
  }
  return places.size() == 1 && !inside.front() ? kNo : kDone;
}

}  // namespace dymsum::cli
