#include "planar/table_options.h"

#include <charconv>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include "exit_code.h"
#include "numbers.h"

namespace dymsum::cli {
namespace {

std::optional<std::uint32_t> count_in(const std::string& text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<Rational> equally_spaced(std::uint32_t count) {
  std::vector<Rational> degrees;
  for (std::uint32_t k = 0; k < count; ++k) degrees.push_back(Rational::of(std::int64_t{360} * k, count).value());
  return degrees;
}

}  // namespace

std::vector<Rational> orientations_in(const std::string& text) {
  constexpr std::uint32_t kMost = 3600;
  if (const std::optional<std::uint32_t> count = count_in(text); count && *count >= 1 && *count <= kMost)
    return equally_spaced(*count);
  std::vector<Rational> degrees;
  for (const std::string& piece : split(text, ',')) {
    const std::optional<Angle> angle = angle_in(piece);
    if (!angle || !angle->degrees)
      throw Stop(kUsage,
                 "--orientations wants a count of equally spaced ones from 1 to 3600, or degrees as 0deg,45deg, "
                 "not '" +
                     text + "'");
    degrees.push_back(angle->exact);
  }
  return degrees;
}

ShardOption shard_in(const std::string& text) {
  const std::vector<std::string> pieces = split(text, '/');
  if (pieces.size() == 2) {
    const std::optional<std::uint32_t> shard = count_in(pieces[0]), shards = count_in(pieces[1]);
    if (shard && shards && *shard >= 1 && *shard <= *shards) return {*shard, *shards};
  }
  throw Stop(kUsage, "--shard wants i/N, such as 2/8 for the second of eight, not '" + text + "'");
}

TableInput table_input(const std::string& file, NestingInstance instance, const std::vector<Rational>& degrees,
                       double angle_error, const InputOptions& options) {
  TableInput input;
  input.strip_height = instance.strip_height;
  input.angle_error = angle_error;
  for (NestingItem& item : instance.items) {
    if (!item.degrees && degrees.empty())
      throw Stop(kBadInput, file + ": item " + item.name +
                                " may take any orientation: a table has some, give them as --orientations");
    Region shape = require(make_input({"", std::move(item.shape)}, file + "#" + item.name, options)).region;
    input.items.push_back({std::move(item.name), std::move(shape), degrees.empty() ? *item.degrees : degrees});
  }
  for (NestingBin& bin : instance.bins) {
    Region shape = require(make_input({"", std::move(bin.shape)}, file + ", bin " + bin.name, options)).region;
    input.bins.push_back({std::move(bin.name), std::move(shape)});
  }
  return input;
}

}  // namespace dymsum::cli
