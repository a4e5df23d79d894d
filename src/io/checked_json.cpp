#include "io/checked_json.h"

#include <algorithm>
#include <cmath>

#include "cspace/events/walked_rings.h"
#include "io/source.h"

namespace dymsum::io {

namespace {

using CheckedJson = nlohmann::json;

CheckedJson ring_json(const Ring& ring) {
  CheckedJson flat = CheckedJson::array();
  for (const Point& p : ring) {
    flat.push_back(p.x);
    flat.push_back(p.y);
  }
  return flat;
}

// A polyline, which encloses nothing as a ring.
bool is_there_and_back(const Ring& ring) {
  const std::size_t n = ring.size();
  for (std::size_t k = 1; k < n / 2; ++k)
    if (ring[k] != ring[n - k]) return false;
  return n > 0 && n % 2 == 0;
}

CheckedJson content_of(const CheckedFormat& format, std::string_view text) {
  const CheckedJson file = CheckedJson::parse(text);
  demand(file.is_object() && file.value("format", CheckedJson()) == format.name, "it is of another format");
  if (const CheckedJson version = file.value("version", CheckedJson()); version != format.version)
    throw Refused{"version " + version.dump() + " of the format; this program reads version " +
                  std::to_string(format.version)};
  const CheckedJson content = file.value("content", CheckedJson());
  demand(content.is_object(), "there is no content");
  demand(file.value("checksum", CheckedJson()) == checksum(content),
         "the checksum differs: the file is damaged or was changed");
  return content;
}

}  // namespace

std::string checksum(const CheckedJson& content) {
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (const char c : content.dump()) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[sum >> shift & 15];
  return digits;
}

std::string format_checked(const CheckedFormat& format, const CheckedJson& content) {
  return "{\"format\":" + CheckedJson(format.name).dump() + ",\"version\":" + std::to_string(format.version) +
         ",\"checksum\":" + CheckedJson(checksum(content)).dump() + ",\n\"content\":" + content.dump() + "}\n";
}

Result<void> read_checked(const CheckedFormat& format, std::string_view text, std::string_view name_for_errors,
                          const std::function<Result<void>(const CheckedJson& content)>& use) {
  const std::string of = format.of;
  Error error{ErrorCode::malformed, "", {}};
  // Blanks around the object are no token, which the parser would keep, and write out in its error.
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  const std::size_t end = std::max(text.find_last_not_of(kBlanks) + 1, begin);
  try {
    Result<void> read = use(content_of(format, text.substr(begin, end - begin)));
    if (read) return read;
    error = read.error();
  } catch (const CheckedJson::parse_error& e) {
    // nlohmann says "while parsing" and where; a text that ends too early fails at its end.
    const std::size_t at = std::min<std::size_t>(begin + e.byte, end);
    const bool ends = begin + e.byte > end;
    error.code = ends ? ErrorCode::truncated : ErrorCode::malformed;
    error.message = ends ? "the file of " + of + " ends too early" : "this is no file of " + of;
    error.evidence.line = io::Source{text, name_for_errors}.line(at);
  } catch (const CheckedJson::exception&) {
    error.message = "the file of " + of + " lacks an entry";
  } catch (const Refused& refused) {
    error.message = "not a file of " + of + " that can be read: " + refused.why;
  }
  if (error.evidence.file.empty()) error.evidence.file = name_for_errors;
  return error;
}

void demand(bool holds, const char* why) {
  if (!holds) throw Refused{why};
}

std::uint64_t whole(const CheckedJson& j, std::uint64_t below) {
  demand(j.is_number_unsigned() && j.get<std::uint64_t>() < below, "an index names nothing, or a count is none");
  return j.get<std::uint64_t>();
}
std::uint32_t index(const CheckedJson& j, std::size_t count) { return static_cast<std::uint32_t>(whole(j, count)); }
double number(const CheckedJson& j) {
  demand(j.is_number() && std::isfinite(j.get<double>()), "a number is expected");
  return j.get<double>();
}
bool flag(const CheckedJson& j) { return whole(j, 2) != 0; }
const std::string& text(const CheckedJson& j) {
  demand(j.is_string(), "a text is expected");
  return j.get_ref<const std::string&>();
}
const CheckedJson& list(const CheckedJson& j) {
  demand(j.is_array(), "a list is expected");
  return j;
}
const CheckedJson& array(const CheckedJson& j, std::size_t size) {
  demand(j.is_array() && j.size() == size, "a list has the wrong length");
  return j;
}

CheckedJson region_json(const Region& region) {
  CheckedJson parts = CheckedJson::array();
  for (const Part& part : region.parts()) {
    CheckedJson rings = CheckedJson::array({ring_json(part.outer)});
    for (const Ring& hole : part.holes) rings.push_back(ring_json(hole));
    parts.push_back(std::move(rings));
  }
  for (const Polyline& line : region.polylines())
    parts.push_back(CheckedJson::array({ring_json(planar::walked(line))}));
  for (const Point& point : region.points()) parts.push_back(CheckedJson::array({ring_json({point})}));
  return parts;
}

Result<Region> region_of(const CheckedJson& parts) {
  RegionData data;
  for (const CheckedJson& rings : list(parts)) {
    std::vector<Ring> read;
    for (const CheckedJson& flat : list(rings)) {
      demand(flat.is_array() && flat.size() % 2 == 0, "a ring is a list of coordinates");
      Ring& ring = read.emplace_back();
      for (std::size_t k = 0; k < flat.size(); k += 2) ring.push_back({number(flat[k]), number(flat[k + 1])});
    }
    demand(!read.empty(), "a part has no ring");
    if (read.size() == 1 && is_there_and_back(read[0]))
      data.polylines.emplace_back(read[0].begin(),
                                  read[0].begin() + static_cast<std::ptrdiff_t>(read[0].size() / 2 + 1));
    else if (read.size() == 1 && read[0].size() == 1) data.points.push_back(read[0][0]);
    else data.parts.push_back({read[0], {read.begin() + 1, read.end()}});
  }
  return Region::create(std::move(data));
}

}  // namespace dymsum::io
