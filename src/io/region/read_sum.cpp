// Reads what sum_json writes. That rings are those of a set is decided by the Boolean engine: the set that they bound
// has to be the one that they are.
#include <algorithm>
#include <cmath>

#include "dymsum/sum_io.h"
#include "io/plain_text.h"
#include "io/read_file.h"
#include "io/region/exact_json.h"
#include "planar/boolean/planar_boolean.h"
#include "planar/result/planar_sum.h"

namespace dymsum {
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
