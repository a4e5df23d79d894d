// A sum as JSON text with exact coordinates and provenance; written, never read.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/region_io.h"
#include "io/number_text.h"
#include "planar/position/exact_source.h"

namespace dymsum {

namespace {

class SumWriter {
 public:
  explicit SumWriter(const PlanarSum& sum) : sum_(sum) {
    if (exact_source(sum)) nearest_.emplace(*exact_source(sum));
  }

  std::string write() {
    out_ = "{\n\"parts\":[";
    list(sum_.parts, [this](const SumPart& part) {
      out_ += "\n{\"outer\":";
      ring(part.outer);
      out_ += ",\n\"holes\":[";
      list(part.holes, [this](const SumRing& hole) { ring(hole); });
      out_ += "]}";
    });
    out_ += "],\n\"segments\":";
    segments(sum_.segments);
    out_ += ",\n\"points\":";
    vertices(sum_.points);
    out_ += ",\n\"tight_segments\":";
    segments(sum_.tight_segments);
    out_ += ",\n\"tight_points\":";
    vertices(sum_.tight_points);
    return out_ + "\n}\n";
  }

 private:
  template <class List, class Write>
  void list(const List& items, Write write) {
    bool first = true;
    for (const auto& item : items) {
      if (!first) out_ += ',';
      first = false;
      write(item);
    }
  }

  void ring(const SumRing& ring) {
    out_ += "{\"vertices\":";
    vertices(ring.vertices);
    out_ += '}';
  }

  void vertices(const std::vector<SumVertex>& items) {
    out_ += '[';
    list(items, [this](const SumVertex& v) { vertex(v); });
    out_ += ']';
  }

  void segments(const std::vector<SumSegment>& items) {
    out_ += '[';
    list(items, [this](const SumSegment& s) {
      out_ += "\n{\"from\":";
      vertex(s.from);
      out_ += ",\"to\":";
      vertex(s.to);
      out_ += '}';
    });
    out_ += ']';
  }

  void vertex(const SumVertex& v) {
    const RationalPoint exact = sum_.exact(v);
    const Point nearest = (*nearest_)(v);
    out_ += "\n{\"x\":";
    append_number(nearest.x);
    out_ += ",\"y\":";
    append_number(nearest.y);
    out_ += ",\"x_exact\":\"" + exact.x.to_string() + "\",\"y_exact\":\"" + exact.y.to_string() + "\",\"in\":";
    contact(v.in);
    out_ += ",\"out\":";
    contact(v.out);
    out_ += ",\"corner\":";
    if (v.corner_p == SumVertex::kNone || v.corner_q == SumVertex::kNone) {
      out_ += "null}";
    } else {
      out_ += "[" + std::to_string(v.corner_p) + "," + std::to_string(v.corner_q) + "]}";
    }
  }

  void append_number(double value) { io::append_number(out_, value); }

  void contact(const Contact& contact) {
    out_ += "{\"edge_of\":\"";
    out_ += contact.kind == Contact::Kind::edge_of_p ? 'P' : 'Q';
    out_ += "\",\"p\":" + std::to_string(contact.p) + ",\"q\":" + std::to_string(contact.q) + "}";
  }

  const PlanarSum& sum_;
  std::optional<planar::NearestPoint> nearest_;  ///< not of a sum without vertices
  std::string out_;
};

}  // namespace

std::string sum_to_json(const PlanarSum& sum) { return SumWriter(sum).write(); }

}  // namespace dymsum
