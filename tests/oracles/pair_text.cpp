#include "pair_text.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace dymsum::oracles {
namespace {

class WktReader {
 public:
  explicit WktReader(std::string_view text) : text_(text) {}

  RegionData read() {
    RegionData out;
    geometry(out);
    skip_space();
    if (at_ != text_.size()) fail();
    return out;
  }

 private:
  [[noreturn]] void fail() const {
    throw std::runtime_error("bad WKT: " + text_.substr(0, at_) + " >>> " + text_.substr(at_));
  }
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool accept(char c) {
    skip_space();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail();
  }
  std::string word() {
    skip_space();
    std::string out;
    while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_]))) out += text_[at_++];
    return out;
  }
  double number() {
    char* end = nullptr;
    const double value = std::strtod(text_.c_str() + at_, &end);
    if (end == text_.c_str() + at_) fail();
    at_ = static_cast<std::size_t>(end - text_.c_str());
    return value;
  }
  Point point() {
    const double x = number();
    return {x, number()};
  }
  template <class Each>
  void list(const Each& each) {
    expect('(');
    do each();
    while (accept(','));
    expect(')');
  }
  std::vector<Point> points() {
    std::vector<Point> out;
    list([&] { out.push_back(point()); });
    return out;
  }
  Part polygon() {
    Part out;
    bool first = true;
    list([&] {
      Ring ring = points();
      if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
      if (first) out.outer = std::move(ring);
      else out.holes.push_back(std::move(ring));
      first = false;
    });
    return out;
  }
  void geometry(RegionData& out) {
    const std::string kind = word();
    const std::size_t before = at_;
    if (word() == "EMPTY") return;
    at_ = before;
    if (kind == "POLYGON") out.parts.push_back(polygon());
    else if (kind == "MULTIPOLYGON") list([&] { out.parts.push_back(polygon()); });
    else if (kind == "LINESTRING") out.polylines.push_back(points());
    else if (kind == "MULTILINESTRING") list([&] { out.polylines.push_back(points()); });
    else if (kind == "POINT" || kind == "MULTIPOINT") multipoint(out);
    else if (kind == "GEOMETRYCOLLECTION") list([&] { geometry(out); });
    else fail();
  }
  void multipoint(RegionData& out) {
    list([&] {
      const bool wrapped = accept('(');
      out.points.push_back(point());
      if (wrapped) expect(')');
    });
  }

  std::string text_;
  std::size_t at_ = 0;
};

std::string text_of(const std::vector<Point>& points, bool close) {
  std::string out = "(";
  char buffer[80];
  for (std::size_t i = 0; i < points.size() + (close ? 1 : 0); ++i) {
    const Point& c = points[i % points.size()];
    std::snprintf(buffer, sizeof buffer, "%s%.17g %.17g", i == 0 ? "" : ", ", c.x, c.y);
    out += buffer;
  }
  return out + ")";
}

}  // namespace

RegionData parse_wkt(std::string_view text) { return WktReader(text).read(); }

Case parse_case(std::string_view text, std::string name) {
  Case out;
  out.name = std::move(name);
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string key, rest;
    words >> key;
    std::getline(words >> std::ws, rest);
    if (key == "p") out.p = parse_wkt(rest);
    else if (key == "q") out.q = parse_wkt(rest);
    else if (key == "op") out.op = rest;
    else if (key == "expect") {
      const std::size_t space = rest.find(' ');
      out.expect.emplace_back(rest.substr(0, space), space == std::string::npos ? "" : rest.substr(space + 1));
    } else throw std::runtime_error(out.name + ": unknown line: " + line);
  }
  return out;
}

std::vector<Case> read_cases(const std::string& folder) {
  std::vector<Case> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".txt") continue;
    std::ifstream file(entry.path());
    std::ostringstream text;
    text << file.rdbuf();
    out.push_back(parse_case(text.str(), entry.path().stem().string()));
  }
  std::sort(out.begin(), out.end(), [](const Case& a, const Case& b) { return a.name < b.name; });
  return out;
}

std::string to_wkt(const RegionData& region) {
  std::vector<std::string> pieces;
  for (const Part& part : region.parts) {
    std::string text = "POLYGON (" + text_of(part.outer, true);
    for (const Ring& hole : part.holes) text += ", " + text_of(hole, true);
    pieces.push_back(text + ")");
  }
  for (const Polyline& line : region.polylines) pieces.push_back("LINESTRING " + text_of(line, false));
  for (const Point& c : region.points) pieces.push_back("POINT " + text_of({c}, false));
  if (pieces.size() == 1) return pieces[0];
  std::string all = "GEOMETRYCOLLECTION ";
  for (std::size_t i = 0; i < pieces.size(); ++i) all += (i == 0 ? "(" : ", ") + pieces[i];
  return all + (pieces.empty() ? "EMPTY" : ")");
}

std::string to_text(const RegionData& p, const RegionData& q, std::string_view op) {
  return "p " + to_wkt(p) + "\nq " + to_wkt(q) + "\nop " + std::string(op) + "\n";
}

}  // namespace dymsum::oracles
