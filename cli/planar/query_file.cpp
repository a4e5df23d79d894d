#include "planar/query_file.h"

#include <vector>

#include "exact_number.h"
#include "line_file.h"

namespace dymsum::cli {

std::optional<QueryLine> query_in(const std::string& text, Fractions fractions) {
  const std::vector<std::string> words = words_of(text);
  if (words.size() < 2 || words.size() > 3) return std::nullopt;
  const std::optional<Angle> theta = words.size() == 3 ? angle_in(words[2]) : std::nullopt;
  if (words.size() == 3 && !theta) return std::nullopt;
  const std::optional<Rational> x = exact_number(words[0]), y = exact_number(words[1]);
  if (!x || !y) return std::nullopt;
  const RationalPoint at{*x, *y};
  if (fractions == Fractions::refused && !is_of_doubles(at)) return std::nullopt;
  QueryLine line{x->to_double(), y->to_double(), theta, std::nullopt};
  if (text.find('/') != std::string::npos) line.exact = at;
  return line;
}

void for_each_query(const std::string& file, const std::function<void(const QueryLine&, const Refuse&)>& take,
                    Fractions fractions) {
  const std::string all = file_text(file);
  const bool any = for_each_line(all, [&](const std::string& text, std::int64_t line) {
    const std::optional<QueryLine> query = query_in(text, fractions);
    if (!query) refuse_line({ErrorCode::malformed, "a question is x,y or x,y,theta", {}}, file, line);
    take(*query, [&](const std::string& why) { refuse_line({ErrorCode::malformed, why, {}}, file, line); });
  });
  if (!any) refuse_line({ErrorCode::malformed, "the file holds no questions", {}}, file, std::nullopt);
}

}  // namespace dymsum::cli
