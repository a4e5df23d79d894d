#include "copies_file.h"

#include <fstream>
#include <optional>
#include <sstream>

#include "inputs.h"
#include "numbers.h"

namespace dymsum::cli {
namespace {

[[noreturn]] void refuse(Error error, const std::string& file, std::optional<std::int64_t> line) {
  error.evidence.file = file;
  error.evidence.line = line;
  stop_with(error);
}

}  // namespace

std::vector<ScaledCopy> read_copies(const std::string& file) {
  std::ifstream in(file);
  if (!in) refuse({Code::cannot_open, "the file of copies cannot be read", {}}, file, std::nullopt);
  std::vector<ScaledCopy> copies;
  std::int64_t line = 0;
  for (std::string text; std::getline(in, text);) {
    ++line;
    std::istringstream words(text.substr(0, text.find('#')));
    std::string scale, x, y, more;
    if (!(words >> scale)) continue;
    const bool three = static_cast<bool>(words >> x >> y) && !(words >> more);
    const std::optional<double> at_x = finite_number(x), at_y = finite_number(y);
    if (!three || !at_x || !at_y) refuse({Code::malformed, "a copy is a line with a scale and two coordinates", {}}, file, line);
    Result<Scale> s = Scale::parse(scale);
    if (!s) refuse(s.error(), file, line);
    copies.push_back({std::move(s).value(), {*at_x, *at_y}});
  }
  if (copies.empty()) refuse({Code::malformed, "the file lists no copies", {}}, file, std::nullopt);
  return copies;
}

}  // namespace dymsum::cli
