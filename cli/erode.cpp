// dymsum erode P Q
#include "commands.h"
#include "sum_command.h"

namespace dymsum::cli {

void add_erode(CLI::App& app, Action& action) {
  SumVerb verb;
  verb.name = "erode";
  verb.first = "P";
  verb.second = "Q";
  verb.description = "The inner fit { x : x + Q inside P }; ends with 4 when Q fits nowhere, also not exactly";
  verb.example = "dymsum erode sheet.wkt part.wkt --json";
  verb.compute = erode;
  verb.reflects_second = true;
  verb.empty_is_no = true;
  add_sum_verb(app, verb, action);
}

}  // namespace dymsum::cli
