// dymsum erode CONTAINER PART
#include "verbs/commands.h"
#include "verbs/sum_command.h"

namespace dymsum::cli {

void add_erode(CLI::App& app, Action& action) {
  SumVerb verb;
  verb.name = "erode";
  verb.first = {"CONTAINER", "The region P to stay inside of"};
  verb.second = {"PART", "The region Q that is to fit"};
  verb.description =
      "The inner fit { x : x + PART inside CONTAINER }; ends with 4 when the part fits nowhere, also not exactly "
      "(with --semantics regular: nowhere with room to move both ways)";
  verb.footer = "Example: dymsum erode sheet.wkt part.wkt --json";
  verb.compute = erode;
  verb.reflects_second = true;
  verb.empty_is_no = true;
  add_sum_verb(app, verb, action);
}

}  // namespace dymsum::cli
