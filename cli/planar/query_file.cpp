#include "planar/query_file.h"

#include <sstream>
#include <vector>

#include "line_file.h"

namespace dymsum::cli {
namespace {

constexpr const char* kBlanks = " \t\r\n";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

/// The pieces between commas, without the blanks around them; where there are no commas, the words between blanks.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  if (text.find(',') != std::string::npos) {
    for (const std::string& piece : split(text, ',')) words.push_back(trimmed(piece));
    return words;
  }
  std::istringstream in(text);
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

}  // namespace

std::optional<QueryLine> query_in(const std::string& text) {
  const std::vector<std::string> words = words_of(text);
  if (words.size() < 2 || words.size() > 3) return std::nullopt;
  const std::optional<double> x = finite_number(words[0]), y = finite_number(words[1]);
  const std::optional<Angle> theta = words.size() == 3 ? angle_in(words[2]) : std::nullopt;
  if (!x || !y || (words.size() == 3 && !theta)) return std::nullopt;
  return QueryLine{*x, *y, theta};
}

void for_each_query(const std::string& file, const std::function<void(const QueryLine&, const Refuse&)>& take) {
  const std::string all = file_text(file);
  const bool any = for_each_line(all, [&](const std::string& text, std::int64_t line) {
    const std::optional<QueryLine> query = query_in(text);
    if (!query) refuse_line({ErrorCode::malformed, "a question is x,y or x,y,theta", {}}, file, line);
    take(*query, [&](const std::string& why) { refuse_line({ErrorCode::malformed, why, {}}, file, line); });
  });
  if (!any) refuse_line({ErrorCode::malformed, "the file holds no questions", {}}, file, std::nullopt);
}

}  // namespace dymsum::cli
