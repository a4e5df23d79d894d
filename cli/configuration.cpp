#include "configuration.h"

#include <cmath>
#include <vector>

#include "exit_code.h"
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

}  // namespace dymsum::cli
