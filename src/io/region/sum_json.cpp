#include "io/region/sum_json.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dymsum/region_io.h"
#include "dymsum/sum_io.h"
#include "io/read_file.h"
#include "io/region/json_shapes.h"
#include "io/source.h"
#include "planar/boolean/planar_boolean.h"
#include "planar/position/exact_source.h"
#include "planar/result/planar_sum.h"

namespace dymsum::io {
namespace {

class TightData {
 public:
  explicit TightData(const PlanarSum& sum) : nearest_(*exact_source(sum)) {
    for (const SumSegment& s : sum.tight_segments) add(nearest_(s.from), nearest_(s.to));
    for (const SumVertex& v : sum.tight_points) add(nearest_(v));
  }
  RegionData data() && { return std::move(data_); }

 private:
  void add(Point at) { data_.points.push_back(at); }
  /// A segment that rounding makes a point is one.
  void add(Point from, Point to) {
    if (from == to) return add(from);
    data_.polylines.push_back({from, to});
  }

  planar::NearestPoint nearest_;
  RegionData data_;
};

bool before(Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }
bool before(const std::vector<Point>& a, const std::vector<Point>& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [](Point p, Point q) { return before(p, q); });
}

/// Appends items in their order, without those that are there already.
template <class T>
void append_new(std::vector<T>& to, const std::vector<T>& items) {
  const auto less = [](const T& a, const T& b) { return before(a, b); };
  std::set<T, decltype(less)> known(to.begin(), to.end(), less);
  for (const T& item : items)
    if (known.insert(item).second) to.push_back(item);
}

}  // namespace

RegionData tight_data(const PlanarSum& sum) {
  if (sum.tight_segments.empty() && sum.tight_points.empty()) return {};
  return TightData(sum).data();
}

RegionData with_tight(RegionData set, const RegionData& tight) {
  append_new(set.polylines, tight.polylines);
  append_new(set.points, tight.points);
  return set;
}

}  // namespace dymsum::io

namespace dymsum {

// A sum as JSON text with exact coordinates and provenance; written, never read.

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

// Reads what sum_json writes. That rings are those of a set is decided by the Boolean engine: the set that they bound
// has to be the one that they are.

namespace {

using exact::BigInteger;
using exact::HomogeneousPoint;
using io::JsonValue;
using io::Source;

class SumReader {
 public:
  explicit SumReader(const Source& source) : source_(source) {}

  PlanarSum read(const JsonValue& root) {
    PlanarSum sum;
    io::visit_array(source_, io::require_member(source_, root, "parts"), "parts", [&](const JsonValue& part) {
      SumPart& own = sum.parts.emplace_back();
      own.outer = ring(io::require_member(source_, part, "outer"));
      io::visit_array(source_, io::require_member(source_, part, "holes"), "rings",
                      [&](const JsonValue& hole) { own.holes.push_back(ring(hole)); });
    });
    sum.segments = segments(io::require_member(source_, root, "segments"));
    sum.points = vertices(io::require_member(source_, root, "points"));
    sum.tight_segments = segments(io::require_member(source_, root, "tight_segments"));
    sum.tight_points = vertices(io::require_member(source_, root, "tight_points"));
    // Nearest doubles: half an ulp of the largest.
    sum.at_error = largest_ * 0x1p-53 + 0x1p-1074;
    if (!at_.empty()) exact_source(sum) = std::make_shared<planar::ListedPositions>(std::move(at_));
    return sum;
  }

 private:
  Rational number(const JsonValue& object, std::string_view key) {
    return io::require_exact_coordinate(source_, io::require_member(source_, object, key));
  }

  SumVertex vertex(const JsonValue& value) {
    const Rational x = number(value, "x_exact"), y = number(value, "y_exact");
    const auto index = static_cast<std::uint32_t>(at_.size());
    const BigInteger xd = exact::denominator_of(x), yd = exact::denominator_of(y), w = lcm(xd, yd);
    at_.push_back({exact::numerator_of(x) * (w / xd), exact::numerator_of(y) * (w / yd), w});
    SumVertex v;
    v.at = {x.to_double(), y.to_double()};
    v.in = v.out = {Contact::Kind::edge_of_p, index, 0};
    v.corner_p = index;
    v.corner_q = 0;
    largest_ = std::max({largest_, std::abs(v.at.x), std::abs(v.at.y)});
    return v;
  }

  std::vector<SumVertex> vertices(const JsonValue& list) {
    std::vector<SumVertex> all;
    io::visit_array(source_, list, "vertices", [&](const JsonValue& value) { all.push_back(vertex(value)); });
    return all;
  }

  SumRing ring(const JsonValue& value) {
    const JsonValue list = io::require_member(source_, value, "vertices");
    SumRing ring{vertices(list)};
    if (ring.vertices.size() < 3)
      source_.fail_on_line(ErrorCode::malformed, "a ring has fewer than three vertices", list.line());
    for (std::size_t k = 0; k < ring.vertices.size(); ++k)
      ring.vertices[k].in.p = ring.vertices[k == 0 ? ring.vertices.size() - 1 : k - 1].out.p;
    return ring;
  }

  std::vector<SumSegment> segments(const JsonValue& list) {
    std::vector<SumSegment> all;
    io::visit_array(source_, list, "segments", [&](const JsonValue& value) {
      SumSegment s{vertex(io::require_member(source_, value, "from")),
                   vertex(io::require_member(source_, value, "to"))};
      const HomogeneousPoint &a = at_[s.from.corner_p], &b = at_[s.to.corner_p];
      const int x = BigInteger(a.x * b.w).compare(BigInteger(b.x * a.w));
      if (x > 0 || (x == 0 && a.y * b.w >= b.y * a.w))
        source_.fail_on_line(ErrorCode::malformed, "a segment does not run from its smaller end to the larger one",
                             value.line());
      all.push_back(std::move(s));
    });
    return all;
  }

  const Source& source_;
  std::vector<HomogeneousPoint> at_;
  double largest_ = 0;
};

/// Whether two rings are one, vertex by vertex.
bool are_equal(const PlanarSum& a, const SumRing& ring, const PlanarSum& b, const SumRing& other) {
  return std::equal(ring.vertices.begin(), ring.vertices.end(), other.vertices.begin(), other.vertices.end(),
                    [&](const SumVertex& v, const SumVertex& w) { return a.exact(v) == b.exact(w); });
}

/// Where the first ring is that a set does not have, of those that it should have.
void name_ring(const PlanarSum& given, const PlanarSum& set, Error& error) {
  const auto at = [&](std::size_t part, std::size_t ring, const SumRing& vertices) {
    error.evidence.part = static_cast<std::int64_t>(part), error.evidence.ring = static_cast<std::int64_t>(ring);
    error.evidence.x = vertices.vertices[0].at.x, error.evidence.y = vertices.vertices[0].at.y;
  };
  for (std::size_t p = 0; p < given.parts.size(); ++p) {
    const SumPart& part = given.parts[p];
    if (p >= set.parts.size() || !are_equal(given, part.outer, set, set.parts[p].outer)) return at(p, 0, part.outer);
    for (std::size_t h = 0; h < part.holes.size(); ++h)
      if (h >= set.parts[p].holes.size() || !are_equal(given, part.holes[h], set, set.parts[p].holes[h]))
        return at(p, h + 1, part.holes[h]);
  }
}

/// Why the parts are none of a result, or nothing.
std::optional<Error> fault_of(const PlanarSum& sum, std::string_view file) {
  SumOptions regular;
  regular.semantics = Semantics::regular;
  const Result<PlanarSum> bounded = planar::evaluate(planar::terms_of_parts(sum), regular);
  if (!bounded) return bounded.error();
  PlanarSum parts;
  parts.parts = sum.parts;
  exact_source(parts) = exact_source(sum);
  if (parts == *bounded) return std::nullopt;
  Error error = io::file_error(ErrorCode::malformed,
                               "the rings are none of a result: they cross, overlap, have vertices inside straight "
                               "edges, or are not in its order",
                               file);
  name_ring(parts, *bounded, error);
  return error;
}

}  // namespace

bool begins_like_sum(std::string_view text) { return io::begins_with_key(text, "parts"); }

bool names_sum(const std::string& path) { return io::names_json_with(path, "parts"); }

Result<PlanarSum> parse_sum(std::string_view text, std::string_view name_for_errors) {
  try {
    const io::PlainText plain(text);
    const Source source{plain.view(), name_for_errors};
    const io::JsonTape tape(source);
    PlanarSum sum = SumReader(source).read(tape.root());
    if (std::optional<Error> fault = fault_of(sum, name_for_errors)) return *std::move(fault);
    return sum;
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

Result<PlanarSum> read_sum(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  return parse_sum(*text, path == "-" ? "standard input" : path);
}

}  // namespace dymsum
