// Regions as DXF text, of AutoCAD 2000 and later: every ring and polyline an LWPOLYLINE, every point a POINT.
#include <string>
#include <string_view>

#include "io/number_text.h"
#include "io/region/dxf_words.h"
#include "io/region/readers.h"

namespace dymsum::io {
namespace {

class DxfWriter {
 public:
  std::string write(const RegionData& data) {
    group(999, kDxfOwn);
    begin_section("HEADER");
    group(9, "$ACADVER");
    group(1, "AC1015");
    group(0, "ENDSEC");
    begin_section("ENTITIES");
    for (const Part& part : data.parts) {
      chain(part.outer, kDxfOuter, true);
      for (const Ring& hole : part.holes) chain(hole, kDxfHole, true);
    }
    for (const Polyline& line : data.polylines) chain(line, kDxfLine, false);
    for (const Point p : data.points) {
      begin_entity("POINT", "AcDbPoint", kDxfPoint);
      position(p);
      number(30, 0);
    }
    group(0, "ENDSEC");
    group(0, "EOF");
    return std::move(out_);
  }

 private:
  void group(int code, std::string_view value) {
    out_ += std::to_string(code);
    out_ += '\n';
    out_ += value;
    out_ += '\n';
  }
  void number(int code, double value) {
    std::string text;
    append_number(text, value);
    group(code, text);
  }
  void position(Point p) {
    number(10, p.x);
    number(20, p.y);
  }
  void begin_section(std::string_view name) {
    group(0, "SECTION");
    group(2, name);
  }
  // Every entity has a handle of its own.
  void begin_entity(std::string_view kind, std::string_view type, std::string_view layer) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string handle;
    for (std::size_t n = ++entities_ + 0xff; n > 0; n /= 16) handle.insert(handle.begin(), kDigits[n % 16]);
    group(0, kind);
    group(5, handle);
    group(100, "AcDbEntity");
    group(8, layer);
    group(100, type);
  }
  void chain(const std::vector<Point>& points, std::string_view layer, bool closed) {
    begin_entity("LWPOLYLINE", "AcDbPolyline", layer);
    group(90, std::to_string(points.size()));
    group(70, closed ? "1" : "0");
    for (const Point p : points) position(p);
  }

  std::string out_;
  std::size_t entities_ = 0;
};

}  // namespace

std::string write_dxf(const RegionData& data) { return DxfWriter().write(data); }

}  // namespace dymsum::io
