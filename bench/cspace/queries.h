// Questions to the obstacles of pairs of the thesis: time, work, and the errors of its sampled penetration depth.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

#include "dymsum/region.h"

namespace dymsum::bench {

struct QueryPair {
  std::string name;
  Region robot, obstacle;
};

/// Measures a pair with random configurations around the obstacle and writes rows of markdown tables.
class QueryTables {
 public:
  QueryTables(std::ostream& out, std::size_t questions, std::size_t samples)
      : out_(out), questions_(questions), samples_(samples) {}
  void heading();
  void row(const QueryPair& pair);

 private:
  std::ostream& out_;
  std::size_t questions_, samples_;
};

}  // namespace dymsum::bench
