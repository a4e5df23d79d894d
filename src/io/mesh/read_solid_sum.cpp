// Reads what write_solid_sum writes: lists of positions and indices, which solid_sum_fault then compares with the solid
// that they bound.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "dymsum/solid_sum_io.h"
#include "io/mesh/solid_sum_fault.h"
#include "io/plain_text.h"
#include "io/read_file.h"
#include "io/region/exact_json.h"
#include "spatial/sum/sum_edges.h"
#include "spatial/sum/sum_source.h"

namespace dymsum {
namespace {

using exact::BigInteger;
using io::JsonKind;
using io::JsonValue;
using io::Source;
using spatial::SpatialSumInternals;

class SolidSumReader {
 public:
  explicit SolidSumReader(const Source& source) : source_(source) {}

  SpatialSum read(const JsonValue& root) {
    io::visit_array(source_, member(root, "vertex_list"), "vertices", [&](const JsonValue& v) { add_vertex(v); });
    sum_.at_error = largest_ * 0x1p-53 + 0x1p-1074;  // nearest doubles: half an ulp of the largest
    sum_.shells = whole(member(root, "shells"), "a number of shells", kNoLimit);
    io::visit_array(source_, member(root, "face_list"), "faces", [&](const JsonValue& f) { add_face(f); });
    read_tight(member(root, "tight_list"));
    if (!listed_.empty()) {
      auto positions = std::make_shared<spatial::SpatialPositions>();
      positions->listed = std::move(listed_);
      SpatialSumInternals::set_positions(sum_, std::move(positions));
    }
    read_edges(member(root, "edge_list"));
    if (const auto sizes = root.find("convolution")) {
      sum_.stats.face_vertex = whole(member(*sizes, "fv"), "a count", kNoLimit);
      sum_.stats.edge_edge = whole(member(*sizes, "ee"), "a count", kNoLimit);
    }
    return std::move(sum_);
  }

 private:
  static constexpr double kNoLimit = 0x1p32;

  JsonValue member(const JsonValue& object, std::string_view key) { return io::require_member(source_, object, key); }
  [[noreturn]] void fail(const std::string& message, const JsonValue& at) {
    source_.fail_on_line(ErrorCode::malformed, message, at.line());
  }

  // Numbers.

  std::uint32_t checked(double value, const std::string& what, double limit, const JsonValue& at) {
    if (!(value >= 0 && value < limit) || value != std::floor(value)) fail("expected " + what, at);
    return static_cast<std::uint32_t>(value);
  }
  std::uint32_t whole(const JsonValue& value, const std::string& what, double limit) {
    if (value.kind() != JsonKind::number) fail("expected " + what, value);
    return checked(value.number(), what, limit, value);
  }
  /// Indices below `limit`: two of them are one token.
  std::vector<std::uint32_t> indices(const JsonValue& list, const std::string& what, double limit) {
    const std::string one = what + " below " + std::to_string(static_cast<std::uint64_t>(limit));
    if (list.kind() == JsonKind::pair)
      return {checked(list.pair().x, one, limit, list), checked(list.pair().y, one, limit, list)};
    if (list.kind() != JsonKind::array) fail("expected a list of " + what, list);
    std::vector<std::uint32_t> all;
    list.each([&](const JsonValue& value) { all.push_back(whole(value, one, limit)); });
    return all;
  }
  double vertices() const { return static_cast<double>(sum_.vertices.size()); }

  // Vertices.

  void add_vertex(const JsonValue& value) {
    std::vector<Rational> at;
    const JsonValue list = member(value, "exact");
    io::visit_array(source_, list, "exact coordinates",
                    [&](const JsonValue& c) { at.push_back(io::require_exact_coordinate(source_, c)); });
    if (at.size() != 3) fail("a vertex has " + std::to_string(at.size()) + " exact coordinates, not 3", list);
    BigInteger w = 1;
    for (const Rational& c : at) w = lcm(w, exact::denominator_of(c));
    const auto over = [&](const Rational& c) {
      return BigInteger(exact::numerator_of(c) * (w / exact::denominator_of(c)));
    };
    listed_.push_back({over(at[0]), over(at[1]), over(at[2]), w});
    sum_.vertices.push_back({at[0].to_double(), at[1].to_double(), at[2].to_double()});
    for (const Rational& c : at) largest_ = std::max(largest_, std::abs(c.to_double()));
    sum_.vertex_contacts.push_back(contact(value));
  }

  // What touches.

  SolidFeature feature(const JsonValue& value) {
    constexpr double kAny = 0x1p32;
    if (const auto v = value.find("vertex"))
      return {SolidFeature::Kind::vertex, whole(*v, "the index of a vertex", kAny), 0};
    if (const auto f = value.find("face")) return {SolidFeature::Kind::face, whole(*f, "the index of a face", kAny), 0};
    const auto edge = value.find("edge");
    if (!edge || edge->kind() != JsonKind::pair) fail("expected a vertex, an edge of two vertices, or a face", value);
    const std::vector<std::uint32_t> ends = indices(*edge, "vertices of an edge", kAny);
    return {SolidFeature::Kind::edge, ends[0], ends[1]};
  }
  /// Nothing where both are null.
  std::optional<SolidContact> contact(const JsonValue& value) {
    const JsonValue p = member(value, "p"), q = member(value, "q");
    if (p.kind() == JsonKind::null && q.kind() == JsonKind::null) return std::nullopt;
    return SolidContact{feature(p), feature(q)};
  }
  SolidContact required_contact(const JsonValue& value) {
    const std::optional<SolidContact> found = contact(value);
    if (!found) fail("expected features that touch", value);
    return *found;
  }
  std::vector<SolidContact> contacts(const JsonValue& value) {
    std::vector<SolidContact> all;
    io::visit_array(source_, member(value, "contacts"), "contacts",
                    [&](const JsonValue& item) { all.push_back(required_contact(item)); });
    return all;
  }

  // Faces, edges and what is tight.

  std::vector<std::vector<std::uint32_t>> loops(const JsonValue& value) {
    std::vector<std::vector<std::uint32_t>> all;
    const JsonValue list = member(value, "loops");
    io::visit_array(source_, list, "loops", [&](const JsonValue& loop) {
      all.push_back(indices(loop, "vertices", vertices()));
      if (all.back().size() < 3) fail("a loop has fewer than three vertices", loop);
    });
    if (all.empty()) fail("a face has no loop", list);
    return all;
  }
  void add_face(const JsonValue& value) {
    const SolidContact touching = required_contact(value);
    const std::uint32_t shell = whole(member(value, "shell"), "the index of a shell", static_cast<double>(sum_.shells));
    sum_.faces.push_back({loops(value), touching.p, touching.q, shell});
  }
  void read_edges(const JsonValue& list) {
    const std::vector<SpatialEdge> edges = spatial::edges_of(sum_.faces);
    std::vector<std::optional<SolidContact>> found;
    io::visit_array(source_, list, "edges", [&](const JsonValue& value) {
      const auto ends = indices(member(value, "vertices"), "vertices", vertices());
      const auto faces = indices(member(value, "faces"), "faces", static_cast<double>(sum_.faces.size()));
      const std::size_t k = found.size();
      if (k >= edges.size() || ends != std::vector{edges[k].from, edges[k].to} || faces != edges[k].faces)
        fail("the edges are not those of the faces, in their order", value);
      found.push_back(contact(value));
    });
    if (found.size() != edges.size()) fail("the edges are not those of the faces, in their order", list);
    SpatialSumInternals::set_edge_contacts(sum_, std::move(found));
  }
  void read_tight(const JsonValue& tight) {
    io::visit_array(source_, member(tight, "faces"), "tight faces", [&](const JsonValue& value) {
      sum_.tight_faces.push_back(loops(value));
      sum_.tight_face_contacts.push_back(
          {required_contact(member(value, "front")), required_contact(member(value, "back"))});
    });
    io::visit_array(source_, member(tight, "segments"), "tight segments", [&](const JsonValue& value) {
      const auto ends = indices(member(value, "vertices"), "vertices", vertices());
      if (ends.size() != 2) fail("a segment has two vertices", value);
      sum_.tight_segments.push_back({ends[0], ends[1]});
      sum_.tight_segment_contacts.push_back(contacts(value));
    });
    io::visit_array(source_, member(tight, "points"), "tight points", [&](const JsonValue& value) {
      sum_.tight_points.push_back(whole(member(value, "vertex"), "the index of a vertex", vertices()));
      sum_.tight_point_contacts.push_back(contacts(value));
    });
  }

  const Source& source_;
  SpatialSum sum_;
  std::vector<std::array<BigInteger, 4>> listed_;
  double largest_ = 0;
};

}  // namespace

bool begins_like_solid_sum(std::string_view text) { return io::begins_with_key(text, "shells"); }

bool names_solid_sum(const std::string& path) { return io::names_json_with(path, "shells"); }

Result<SpatialSum> parse_solid_sum(std::string_view text, std::string_view name_for_errors) {
  try {
    const io::PlainText plain(text);
    const Source source{plain.view(), name_for_errors};
    const io::JsonTape tape(source);
    SpatialSum sum = SolidSumReader(source).read(tape.root());
    if (std::optional<Error> fault = io::solid_sum_fault(sum)) {
      fault->evidence.file = name_for_errors;
      return *std::move(fault);
    }
    return sum;
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

Result<SpatialSum> read_solid_sum(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  return parse_solid_sum(*text, path == "-" ? "standard input" : path);
}

}  // namespace dymsum
