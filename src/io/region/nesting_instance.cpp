// The whole of a nesting instance: what read_nesting leaves out.
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

#include "dymsum/nesting.h"
#include "io/number_text.h"
#include "io/plain_text.h"
#include "io/read_file.h"
#include "io/region/json_shapes.h"

namespace dymsum {
namespace {

using io::JsonKind;
using io::JsonValue;

class InstanceReader {
 public:
  explicit InstanceReader(const io::Source& source) : source_(source) {}

  NestingInstance read(const JsonValue& root) const {
    NestingInstance instance;
    io::visit_array(source_, io::require_member(source_, root, "items"), "items",
                    [&](const JsonValue& item) { instance.items.push_back(read_item(item)); });
    if (const auto name = root.find("name")) instance.name = io::name_of(*name).value_or("");
    if (const auto bins = root.find("bins")) {
      io::visit_array(source_, *bins, "bins", [&](const JsonValue& bin) { instance.bins.push_back(read_bin(bin)); });
    }
    if (const auto height = root.find("strip_height"); height && height->kind() != JsonKind::null) {
      instance.strip_height = number(*height, "'strip_height'");
      if (!(*instance.strip_height > 0)) fail("'strip_height' has to be positive", *height);
    }
    name_all(instance.items, "items", root);
    name_all(instance.bins, "bins", root);
    return instance;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const JsonValue& at) const {
    source_.fail_on_line(ErrorCode::malformed, what, at.line());
  }

  double number(const JsonValue& value, const std::string& what) const {
    if (value.kind() != JsonKind::number) fail("expected a number as " + what, value);
    return value.number();
  }

  NestingItem read_item(const JsonValue& json) const {
    NamedShape shape = io::read_nesting_shape(source_, json);
    NestingItem item{std::move(shape.name), std::move(shape.data), 1, std::nullopt};
    if (const auto demand = json.find("demand")) {
      const double count = number(*demand, "'demand'");
      constexpr double kMost = 0x1p53;
      if (!(count >= 0 && count <= kMost && count == std::floor(count))) fail("'demand' has to be a count", *demand);
      item.demand = static_cast<std::uint64_t>(count);
    }
    if (const auto allowed = json.find("allowed_orientations"); allowed && allowed->kind() != JsonKind::null)
      item.degrees = read_degrees(*allowed);
    return item;
  }

  std::vector<Rational> read_degrees(const JsonValue& list) const {
    std::vector<Rational> degrees;
    const auto add = [&](double value) {
      std::string text;
      io::append_number(text, value);
      degrees.push_back(Rational::parse(text).value());
    };
    if (list.kind() == JsonKind::pair) {
      add(list.pair().x);
      add(list.pair().y);
      return degrees;
    }
    io::visit_array(source_, list, "orientations",
                    [&](const JsonValue& one) { add(number(one, "an orientation in degrees")); });
    if (degrees.empty()) fail("the item is allowed no orientation", list);
    return degrees;
  }

  NestingBin read_bin(const JsonValue& json) const {
    NamedShape shape = io::read_nesting_shape(source_, json);
    if (const auto zones = json.find("zones"); zones && zones->kind() != JsonKind::null) {
      io::visit_array(source_, *zones, "zones", [&](const JsonValue& zone) {
        fail("zones of other quality are not supported: cut them out of the bin as holes", zone);
      });
    }
    return {std::move(shape.name), std::move(shape.data)};
  }

  /// Names by its index what has no name. Rows of a table are distinguished by names.
  template <class T>
  void name_all(std::vector<T>& all, const std::string& what, const JsonValue& root) const {
    std::set<std::string> names;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].name.empty()) all[i].name = std::to_string(i);
      if (!names.insert(all[i].name).second) fail("two " + what + " are named " + io::in_quotes(all[i].name), root);
    }
  }

  const io::Source& source_;
};

}  // namespace

Result<NestingInstance> parse_nesting_instance(std::string_view text, std::string_view name_for_errors) {
  const io::PlainText plain(text);
  const io::Source source{plain.view(), name_for_errors};
  try {
    const io::JsonTape tape(source);
    return InstanceReader(source).read(tape.root());
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

Result<NestingInstance> read_nesting_instance(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  return parse_nesting_instance(*text, path);
}

}  // namespace dymsum
