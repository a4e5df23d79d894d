#include "configuration.h"

#include <cctype>
#include <cmath>
#include <fstream>
#include <iostream>
#include <optional>
#include <vector>

#include "exit_code.h"
#include "inputs.h"
#include "numbers.h"

namespace dymsum::cli {

Configuration read_configuration(const std::string& text, const char* option) {
  const std::vector<std::string> words = split(text, ',');
  const auto place = words.size() == 3 ? finite_point(words[0] + "," + words[1]) : std::nullopt;
  const auto angle = place ? angle_in(words[2]) : std::nullopt;
  if (!angle) throw Stop(kUsage, std::string(option) + " wants x,y,theta with theta in radians, or in degrees as 90deg, not '" + text + "'");
  const Configuration q{place->x, place->y, angle->radians()};
  constexpr double kLargest = 0x1p400;  // as for the vertices of robots and obstacles
  if (std::abs(q.x) > kLargest || std::abs(q.y) > kLargest) throw Stop(kUsage, std::string(option) + ": a coordinate is larger than 2^400: '" + text + "'");
  return q;
}

namespace {

[[noreturn]] void refuse(Code code, const std::string& message, const std::string& file, std::optional<std::int64_t> line) {
  Error error{code, message, {}};
  error.evidence.file = file;
  error.evidence.line = line;
  stop_with(error);
}

}  // namespace

std::vector<Configuration> read_configurations(const std::string& file) {
  std::ifstream opened;
  if (file != "-") opened.open(file);
  std::istream& in = file == "-" ? std::cin : opened;
  if (!in) refuse(Code::cannot_open, "cannot open the file of configurations", file, {});
  std::vector<Configuration> all;
  std::int64_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::erase_if(line = line.substr(0, line.find('#')), [](char c) { return std::isspace(static_cast<unsigned char>(c)); });
    if (line.empty()) continue;
    try {
      all.push_back(read_configuration(line, "a line"));
    } catch (const Stop& stop) {
      refuse(Code::malformed, stop.what(), file, number);
    }
  }
  if (in.bad()) refuse(Code::cannot_open, "cannot read the file of configurations", file, {});
  return all;
}

}  // namespace dymsum::cli
