#include "edit_report.h"

#include <iostream>

#include "report.h"

namespace dymsum::cli {

std::string hash_text(std::uint64_t hash) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t k = text.size(); k-- > 0; hash >>= 4) text[k] = kDigits[hash & 15];
  return text;
}

Json step_head(std::size_t step, std::int64_t line, ScriptAction action, std::size_t edits) {
  Json json = {{"step", step}, {"line", line}, {"action", name(action)}};
  if (action == ScriptAction::edit) json["edits"] = edits;
  return json;
}

std::string on_one_line(const std::vector<std::string>& edits) {
  constexpr std::size_t kLongest = 100;
  std::string text;
  for (const std::string& edit : edits) {
    text += (text.empty() ? "" : "; ") + edit.substr(0, edit.find('\n'));
    if (text.size() > kLongest) return text.substr(0, kLongest) + "...";
  }
  return text;
}

Timing timing_of_steps(const std::vector<double>& ms, double static_ms) {
  return ms.empty() ? Timing{static_ms, static_ms, 1} : timing_of(ms);
}

ExitCode report_replay(const std::string& file, const EditReplay& made, std::size_t steps, const Timing& timing,
                       Json head, bool as_json, const std::function<std::string(std::size_t)>& text) {
  const ExitCode code = made.differs ? kNo : kDone;
  if (as_json) {
    head.update({{"replayed", steps},
                 {"differs", made.differs ? Json(*made.differs) : Json(nullptr)},
                 {"refused", made.refused ? error_json(*made.refused) : Json(nullptr)}});
    print_report(head);
    return code;
  }
  std::cout << file << ": ";
  if (!made.differs) {
    std::cout << counted(steps, "step") << " made again, every sum as it was recorded\n";
    print_times(std::cout, timing);
  } else if (*made.differs == 0) {
    std::cout << "the sum before the first step is another one than was recorded\n";
  } else {
    std::cout << "step " << *made.differs << " of " << steps << " differs from what was recorded:\n"
              << text(*made.differs);
  }
  if (made.refused) std::cout << "  refused: " << made.refused->to_string() << "\n";
  return code;
}

}  // namespace dymsum::cli
