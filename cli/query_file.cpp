#include "query_file.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include "inputs.h"

namespace dymsum::cli {
namespace {

[[noreturn]] void refuse_line(Code code, const std::string& why, const std::string& file, std::optional<std::int64_t> line) {
  Error error{code, why, {}};
  error.evidence.file = file;
  error.evidence.line = line;
  stop_with(error);
}

}  // namespace

std::optional<QueryLine> query_in(const std::string& text) {
  // "1, 2", "1,2" and "1 2" are the same; "1,,2" is not a pair.
  std::string blanks = text;
  std::replace(blanks.begin(), blanks.end(), ',', ' ');
  std::istringstream in(blanks);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  const auto commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  if (words.size() < 2 || words.size() > 3 || (commas != 0 && commas + 1 != words.size())) return std::nullopt;
  const std::optional<double> x = finite_number(words[0]), y = finite_number(words[1]);
  const std::optional<Angle> theta = words.size() == 3 ? angle_in(words[2]) : std::nullopt;
  if (!x || !y || (words.size() == 3 && !theta)) return std::nullopt;
  return QueryLine{*x, *y, theta};
}

void for_each_query(const std::string& file, const std::function<void(const QueryLine&, const Refuse&)>& take) {
  std::ifstream in(file);
  if (!in) refuse_line(Code::cannot_open, "the file of questions cannot be read", file, std::nullopt);
  std::int64_t line = 0, taken = 0;
  for (std::string text; std::getline(in, text);) {
    ++line;
    text.resize(std::min(text.find('#'), text.size()));
    if (text.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::optional<QueryLine> query = query_in(text);
    if (!query) refuse_line(Code::malformed, "a question is x,y or x,y,theta", file, line);
    take(*query, [&](const std::string& why) { refuse_line(Code::malformed, why, file, line); });
    ++taken;
  }
  if (taken == 0) refuse_line(Code::malformed, "the file holds no questions", file, std::nullopt);
}

}  // namespace dymsum::cli
