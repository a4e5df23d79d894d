// Occupancy maps of ROS: a YAML file of a few keys, and a grey image.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "io/read_file.h"
#include "io/region/grid_map.h"
#include "io/source.h"

namespace dymsum::io {
namespace {

struct YamlValue {
  std::vector<std::string> words;  // one, or those of a list
  bool list = false;
  std::int64_t line = 0;
};

// `key: value`, `key: [a, b]` and `key:` with a line `- a` each; comments, quotes. What map files are written in.
class YamlLines {
 public:
  explicit YamlLines(const Source& source) : source_(source) {
    std::size_t at = 0;
    while (at < source.text.size()) {
      const std::size_t end = std::min(source.text.find('\n', at), source.text.size());
      ++line_;
      read_line(trimmed(without_comment(source.text.substr(at, end - at))));
      at = end + 1;
    }
  }

  const YamlValue* find(const std::string& key) const {
    const auto at = values_.find(key);
    return at == values_.end() ? nullptr : &at->second;
  }
  [[noreturn]] void fail(const std::string& what, std::int64_t line) const {
    source_.fail_on_line(ErrorCode::malformed, what, line);
  }
  const YamlValue& require(const std::string& key) const {
    if (const YamlValue* value = find(key)) return *value;
    fail("the map has no '" + key + "'", 1);
  }
  std::string text(const std::string& key) const {
    const YamlValue& value = require(key);
    if (value.list || value.words.size() != 1 || value.words[0].empty())
      fail("'" + key + "' wants one value", value.line);
    return value.words[0];
  }
  double number(const std::string& word, const std::string& key, std::int64_t line) const {
    const ScannedNumber number = scan_number(word);
    if (number.length == 0 || number.length != word.size() || !std::isfinite(number.value))
      fail("'" + key + "' wants finite numbers, not " + in_quotes(word), line);
    return number.value;
  }
  double number(const std::string& key) const { return number(text(key), key, require(key).line); }

 private:
  static std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
  }
  static std::string_view without_comment(std::string_view line) {
    char quote = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
      if (quote != 0) quote = line[k] == quote ? 0 : quote;
      else if (line[k] == '"' || line[k] == '\'') quote = line[k];
      else if (line[k] == '#' && (k == 0 || is_blank(line[k - 1]))) return line.substr(0, k);
    }
    return line;
  }
  static std::string unquoted(std::string_view word) {
    word = trimmed(word);
    if (word.size() > 1 && (word[0] == '"' || word[0] == '\'') && word.back() == word[0])
      word = word.substr(1, word.size() - 2);
    return std::string(word);
  }

  void read_line(std::string_view line) {
    if (line.empty() || line == "---" || line == "...") return;
    if (line[0] == '-' && (line.size() == 1 || is_blank(line[1]))) {
      if (open_ == nullptr) fail("a list entry without a key", line_);
      open_->list = true;
      open_->words.push_back(unquoted(line.substr(1)));
      return;
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) fail("expected 'key: value' instead of " + in_quotes(line), line_);
    const std::string key = unquoted(line.substr(0, colon));
    const auto [at, fresh] = values_.try_emplace(key);
    if (!fresh) fail("'" + key + "' comes twice", line_);
    at->second.line = line_;
    const std::string_view value = trimmed(line.substr(colon + 1));
    open_ = value.empty() ? &at->second : nullptr;
    if (value.empty()) return;
    if (value.front() != '[') {
      at->second.words = {unquoted(value)};
      return;
    }
    if (value.back() != ']') fail("the list of '" + key + "' does not end on its line", line_);
    at->second.list = true;
    std::string_view rest = value.substr(1, value.size() - 2);
    for (;;) {
      const std::size_t comma = rest.find(',');
      at->second.words.push_back(unquoted(rest.substr(0, comma)));
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
  }

  const Source& source_;
  std::map<std::string, YamlValue> values_;
  YamlValue* open_ = nullptr;
  std::int64_t line_ = 0;
};

struct Thresholds {
  double occupied = 0, free = 0;
  bool negate = false, raw = false;

  // The cell is what map_server decides. Raw: the value is the occupancy in per cent, unknown beyond 100. The quotient
  // and the threshold are rounded once each, so that 51 / 255 is no less than a threshold of 0.2.
  GridCell cell(std::uint32_t value, std::uint32_t most) const {
    if (raw && value > 100) return GridCell::unknown;
    const double fraction = static_cast<double>(raw || negate ? value : most - value) / (raw ? 100 : most);
    if (fraction > occupied) return GridCell::occupied;
    return fraction < free ? GridCell::free : GridCell::unknown;
  }
};

Thresholds thresholds_of(const YamlLines& yaml) {
  Thresholds t;
  t.occupied = yaml.number("occupied_thresh");
  t.free = yaml.number("free_thresh");
  if (!(t.free <= t.occupied))
    yaml.fail("free_thresh is larger than occupied_thresh", yaml.require("free_thresh").line);
  const std::string negate = yaml.find("negate") != nullptr ? yaml.text("negate") : "0";
  if (negate != "0" && negate != "1" && negate != "true" && negate != "false")
    yaml.fail("'negate' is 0 or 1, not " + in_quotes(negate), yaml.require("negate").line);
  t.negate = negate == "1" || negate == "true";
  const std::string mode = yaml.find("mode") != nullptr ? yaml.text("mode") : "trinary";
  if (mode != "trinary" && mode != "scale" && mode != "raw")
    yaml.fail("'mode' is trinary, scale or raw, not " + in_quotes(mode), yaml.require("mode").line);
  t.raw = mode == "raw";
  return t;
}

GreyImage image_of(const YamlLines& yaml, std::string_view yaml_file) {
  std::string path = yaml.text("image");
  const std::int64_t line = yaml.require("image").line;
  if (extension(path) != ".pgm") yaml.fail("the image is no .pgm file: " + in_quotes(path), line);
  const std::size_t slash = yaml_file.rfind('/');
  if (path[0] != '/' && slash != std::string_view::npos) path = std::string(yaml_file.substr(0, slash + 1)) + path;
  const Result<std::string> bytes = read_file(path);
  if (!bytes) throw ReadFailure{bytes.error()};
  return read_pgm({*bytes, path});
}

}  // namespace

GridMap read_ros_map(const Source& source) {
  const YamlLines yaml(source);
  GridMap map;
  map.resolution = yaml.number("resolution");
  if (!(map.resolution > 0)) yaml.fail("the resolution is not positive", yaml.require("resolution").line);
  const YamlValue& origin = yaml.require("origin");
  if (!origin.list || origin.words.size() != 3) yaml.fail("'origin' wants [x, y, yaw]", origin.line);
  std::array<double, 3> pose{};
  for (std::size_t k = 0; k < 3; ++k) pose[k] = yaml.number(origin.words[k], "origin", origin.line);
  map.x = pose[0];
  map.y = pose[1];
  map.yaw = pose[2];
  const Thresholds thresholds = thresholds_of(yaml);
  const GreyImage image = image_of(yaml, source.file);
  map.width = image.width;
  map.height = image.height;
  map.cells.resize(image.width * image.height);
  for (std::size_t row = 0; row < map.height; ++row)
    for (std::size_t i = 0; i < map.width; ++i)
      map.cells[(map.height - 1 - row) * map.width + i] =
          thresholds.cell(image.pixels[row * map.width + i], image.most);
  return map;
}

bool names_map(std::string_view path) {
  const std::string text = extension(path);
  return text == ".yaml" || text == ".yml" || text == ".map";
}

GridSet grid_set(const Source& source, std::string_view name) {
  if (name.empty() || name == "blocked") return GridSet::blocked;
  if (name == "occupied") return GridSet::occupied;
  if (name == "unknown") return GridSet::unknown;
  if (name == "free") return GridSet::free;
  source.fail_on_line(ErrorCode::malformed, "a map has no " + in_quotes(name) + ": blocked, occupied, unknown or free",
                      1);
}

}  // namespace dymsum::io
