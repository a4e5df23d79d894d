#include "planar/copies_file.h"

#include <optional>
#include <sstream>

#include "exact_number.h"
#include "line_file.h"

namespace dymsum::cli {

std::vector<ScaledCopy> read_copies(const std::string& file) {
  std::vector<ScaledCopy> copies;
  const std::string all = file_text(file);
  const bool any = for_each_line(all, [&](const std::string& text, std::int64_t line) {
    std::istringstream words(text);
    std::string scale, x, y, more;
    const bool three = static_cast<bool>(words >> scale >> x >> y) && !(words >> more);
    const std::optional<double> at_x = double_number(x), at_y = double_number(y);
    if (!three || !at_x || !at_y)
      refuse_line(
          {ErrorCode::malformed, "a copy is a line with a scale and two coordinates" + no_double_in(x + " " + y), {}},
          file, line);
    Result<Scale> s = Scale::parse(scale);
    if (!s) refuse_line(s.error(), file, line);
    copies.push_back({std::move(s).value(), {*at_x, *at_y}});
  });
  if (!any) refuse_line({ErrorCode::malformed, "the file lists no copies", {}}, file, std::nullopt);
  return copies;
}

}  // namespace dymsum::cli
