#include "configuration.h"

#include <cmath>
#include <sstream>

#include "exit_code.h"

namespace dymsum::cli {

Configuration read_configuration(const std::string& text, const char* option) {
  std::istringstream words(text);
  Configuration q;
  char first = 0, second = 0, rest = 0;
  const bool read = (words >> q.x >> first >> q.y >> second >> q.theta) && first == ',' && second == ',' && !(words >> rest);
  if (!read || !std::isfinite(q.x) || !std::isfinite(q.y) || !std::isfinite(q.theta))
    throw Stop(kUsage, std::string(option) + " wants x,y,theta with theta in radians, not '" + text + "'");
  constexpr double kLargest = 0x1p400;  // as for the vertices of robots and obstacles
  if (std::abs(q.x) > kLargest || std::abs(q.y) > kLargest) throw Stop(kUsage, std::string(option) + ": a coordinate is larger than 2^400: '" + text + "'");
  return q;
}

}  // namespace dymsum::cli
