// A pair of operands with what is known about their combination, as text: the format of tests/corpus/planar, and of
// what a failing test prints. Lines `#` comments, `p WKT`, `q WKT`, `op sum|nfp|erode`, `expect KEY VALUE...`.
#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::oracles {

struct Case {
  std::string name;
  RegionData p, q;
  std::string op = "sum";
  std::vector<std::pair<std::string, std::string>> expect;
  friend std::ostream& operator<<(std::ostream& out, const Case& one) { return out << one.name; }
};

/// Throws std::runtime_error with the offending text.
RegionData parse_wkt(std::string_view text);
Case parse_case(std::string_view text, std::string name);

/// Every *.txt file of a folder, by name.
std::vector<Case> read_cases(const std::string& folder);

/// Coordinates with 17 digits: they read back to the same doubles.
std::string to_wkt(const RegionData& region);
std::string to_text(const RegionData& p, const RegionData& q, std::string_view op = "sum");

}  // namespace dymsum::oracles
