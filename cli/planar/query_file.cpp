#include "planar/query_file.h"

#include <vector>

#include "line_file.h"

namespace dymsum::cli {
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
