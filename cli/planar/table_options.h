// What the command line says about a table of no-fit polygons.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dymsum/nesting.h"
#include "dymsum/nfp_table.h"
#include "inputs.h"

namespace dymsum::cli {

/// "8" for as many equally spaced orientations, or degrees: "0deg,45deg,90.5deg". Stops with wrong usage for other
/// text.
std::vector<Rational> orientations_in(const std::string& text);

struct ShardOption {
  std::uint32_t shard = 1, shards = 1;
};
/// "2/8" for the second of eight. Stops with wrong usage for other text.
ShardOption shard_in(const std::string& text);

/// What the table of an instance is made of: its valid shapes, and for items the orientations of the file, or `degrees`
/// where there are some. Stops where an item has neither.
TableInput table_input(const std::string& file, NestingInstance instance, const std::vector<Rational>& degrees,
                       double angle_error, const InputOptions& options);

}  // namespace dymsum::cli
