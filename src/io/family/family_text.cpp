#include "io/family/family_text.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "dymsum/family_file.h"
#include "io/read_file.h"
#include "planar/family/scaling_cells.h"
#include "planar/family/scaling_family.h"

namespace dymsum::io {
namespace {

// Whether a vertex of a family that was read can be one: what it names is there, and its lines meet at it.

class NameCheck {
 public:
  explicit NameCheck(const planar::ScalingCells& cells) : path_(cells.path) {}

  /// What is wrong with a vertex, or null. A crossing has two contacts whose lines are not parallel, a corner lies on
  /// the lines of both contacts at every scale.
  const char* fault(const SumVertex& v) const;

 private:
  using Vector = std::array<exact::BigRational, 2>;
  /// At scale t: the line through `still` + t `moved`.
  struct Line {
    Vector direction, still, moved;
  };
  bool names_an_edge(const Contact& c) const;
  const char* fault_of_corner(const SumVertex& v) const;
  bool sums_points(const SumVertex& v) const;
  Vector vertex(std::uint32_t op, std::uint32_t source) const;
  Line line(const Contact& c) const;
  bool on_line(const SumVertex& v, const Contact& c) const;

  const planar::ScalingPath& path_;
};

using exact::BigRational;

using planar::Operand;

template <class Pair>
BigRational cross(const Pair& a, const Pair& b) {
  return a[0] * b[1] - a[1] * b[0];
}

template <class Pair>
Pair minus(const Pair& a, const Pair& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

bool NameCheck::names_an_edge(const Contact& c) const {
  const std::uint32_t op = c.kind == Contact::Kind::edge_of_p ? 0 : 1;
  const Operand &of_edge = path_.given->operands[op], &of_vertex = path_.given->operands[1 - op];
  const std::uint32_t edge = op == 0 ? c.p : c.q, vertex = op == 0 ? c.q : c.p;
  if (edge >= of_edge.edge_of_index.size() || vertex >= of_vertex.vertex_of_index.size()) return false;
  const auto [from, to] = of_edge.edge_of_index[edge];
  const std::size_t sources = path_.given->lattice->points[op]->input.size();
  return from < sources && to < sources;
}

/// As it moves: of the moved operand times the factors of the path.
NameCheck::Vector NameCheck::vertex(std::uint32_t op, std::uint32_t source) const {
  const Point at = path_.given->given->points[op]->input[source];
  Vector v{exact::exact_value(at.x), exact::exact_value(at.y)};
  if (op != path_.given->moved) return v;
  return {v[0] * planar::rational(path_.factors.x), v[1] * planar::rational(path_.factors.y)};
}

NameCheck::Line NameCheck::line(const Contact& c) const {
  const std::uint32_t op = c.kind == Contact::Kind::edge_of_p ? 0 : 1;
  const auto [from, to] = path_.given->operands[op].edge_of_index[op == 0 ? c.p : c.q];
  const std::uint32_t other = path_.given->operands[1 - op].vertex_of_index[op == 0 ? c.q : c.p];
  const Vector start = vertex(op, from), vertex_of_other = vertex(1 - op, other);
  const bool edge_moves = op == path_.given->moved;
  return {minus(vertex(op, to), start), edge_moves ? vertex_of_other : start, edge_moves ? start : vertex_of_other};
}

bool NameCheck::on_line(const SumVertex& v, const Contact& c) const {
  const std::uint32_t moved = path_.given->moved;
  const auto source = [&](std::uint32_t op) {
    return path_.given->operands[op].vertex_of_index[op == 0 ? v.corner_p : v.corner_q];
  };
  const Line l = line(c);
  return cross(l.direction, minus(vertex(moved, source(moved)), l.moved)) == 0 &&
         cross(l.direction, minus(vertex(1 - moved, source(1 - moved)), l.still)) == 0;
}

const char* NameCheck::fault_of_corner(const SumVertex& v) const {
  const auto& operands = path_.given->operands;
  if (v.corner_p >= operands[0].vertex_of_index.size() || v.corner_q >= operands[1].vertex_of_index.size())
    return "a vertex is the sum of vertices that are not there";
  return nullptr;
}

/// Whether it is the sum of two points, which no edge carries.
bool NameCheck::sums_points(const SumVertex& v) const {
  const auto is_point = [&](std::uint32_t op, std::uint32_t index) {
    const Operand& o = path_.given->operands[op];
    const std::uint32_t source = o.vertex_of_index[index];
    return std::any_of(o.components.begin(), o.components.end(),
                       [&](const planar::Component& c) { return c.dimension == 0 && o.source[c.first] == source; });
  };
  return is_point(0, v.corner_p) && is_point(1, v.corner_q);
}

const char* NameCheck::fault(const SumVertex& v) const {
  if (v.corner_p != SumVertex::kNone && fault_of_corner(v) == nullptr && sums_points(v))
    return v.in == Contact{} && v.out == Contact{} ? nullptr : "a sum of two points lies on an edge";
  if (!names_an_edge(v.in) || !names_an_edge(v.out)) return "a vertex lies on an edge that is not there";
  if (v.corner_p == SumVertex::kNone)
    return cross(line(v.in).direction, line(v.out).direction) == 0 ? "a vertex lies on parallel lines" : nullptr;
  if (const char* fault = fault_of_corner(v)) return fault;
  return on_line(v, v.in) && on_line(v, v.out) ? nullptr : "a vertex does not lie on its edges";
}

}  // namespace
}  // namespace dymsum::io

namespace dymsum {

// Every entry is looked at, so that a file that is not what was written is refused before anything uses it.

namespace {

using io::array;
using io::demand;
using FamilyJson = nlohmann::json;

template <names::Enumeration E>
E named_in(const FamilyJson& j) {
  const std::optional<E> value = parse<E>(io::text(j));
  demand(value.has_value(), "an option has a value that it does not have");
  return *value;
}

Rational fraction_in(const FamilyJson& j) {
  const Result<Rational> value = Rational::parse(io::text(j));
  demand(value.ok() && value->to_string() == io::text(j), "a fraction in lowest terms is expected");
  return *value;
}

Scale scale_in(const FamilyJson& j) {
  const Result<Scale> scale = Scale::of(fraction_in(j));
  if (!scale) throw io::Refused{scale.error().message};
  return *scale;
}

FamilyOptions options_in(const FamilyJson& j) {
  FamilyOptions options;
  options.moving = named_in<MovingOperand>(j.at("moving"));
  options.reflect_q = io::flag(j.at("reflect_q"));
  options.semantics = named_in<Semantics>(j.at("semantics"));
  options.structure_bytes = io::whole(j.at("structure_bytes"), std::numeric_limits<std::uint64_t>::max());
  return options;
}

class CellsReader {
 public:
  CellsReader(const FamilyJson& content, planar::ScalingCells& cells) : j_(content), cells_(cells) {}

  void run(const Scale& low, const Scale& high) {
    read_events(low, high);
    const io::NameCheck check(cells_);
    for (const FamilyJson& j : io::list(j_.at("names"))) {
      names_.push_back(name_in(j));
      if (const char* fault = check.fault(names_.back())) throw io::Refused{fault};
    }
    for (const FamilyJson& j : array(j_.at("cells"), cells_.events.size() + 1)) read_cell(j);
  }

 private:
  void read_events(const Scale& low, const Scale& high) {
    for (const FamilyJson& j : io::list(j_.at("events"))) {
      array(j, 4);
      ScaleEvent e;
      e.parameter = fraction_in(j[0]);
      demand(e.parameter >= low.exact() && e.parameter <= high.exact(), "an event is outside of the interval");
      demand(cells_.events.empty() || cells_.events.back().parameter < e.parameter, "events are not in order");
      e.approx = e.parameter.to_double();
      e.kind = static_cast<EventKind>(io::whole(j[1], names_of<EventKind>().size()));
      e.visible = io::flag(j[2]);
      e.topology = io::flag(j[3]);
      cells_.events.push_back(e);
    }
  }
  static SumVertex name_in(const FamilyJson& j) {
    constexpr std::size_t kAny = SumVertex::kNone;
    demand(j.is_array() && (j.size() == 6 || j.size() == 8), "a list has the wrong length");
    const auto contact = [&](std::size_t at) {
      return Contact{static_cast<Contact::Kind>(io::whole(j[at], 2)), io::index(j[at + 1], kAny),
                     io::index(j[at + 2], kAny)};
    };
    SumVertex v{{}, contact(0), contact(3)};
    if (j.size() == 6) return v;
    v.corner_p = io::index(j[6], kAny);
    v.corner_q = io::index(j[7], kAny);
    return v;
  }
  void read_cell(const FamilyJson& j) {
    if (j.is_null()) return cells_.add_dropped_cell();
    array(j, 3);
    const double at = io::number(j[0]);
    demand(at >= 0x1p-64 && at <= 0x1p64, "a cell is at no scale");
    PlanarSum sum;
    std::vector<std::uint64_t> identities;
    for (const FamilyJson& rings : io::list(j[1])) {
      demand(!io::list(rings).empty(), "a part has no ring");
      SumPart& part = sum.parts.emplace_back();
      for (std::size_t k = 0; k < rings.size(); ++k)
        read_ring(rings[k], k == 0 ? part.outer : part.holes.emplace_back(), identities);
    }
    known_.next_cell();
    read_pieces(j[2], sum);
    cells_.add_cell(sum, identities, at);
  }
  void read_ring(const FamilyJson& j, SumRing& ring, std::vector<std::uint64_t>& identities) {
    demand(j.is_array() && j.size() >= 3, "a list has the wrong length");
    identities.push_back(io::whole(j[0], std::numeric_limits<std::uint64_t>::max()));
    const io::KnownRings::Names& then = known_.before(identities.back());
    const std::size_t head = io::index(j[1], then.size() + 1), tail = io::index(j[2], then.size() + 1 - head);
    io::KnownRings::Names now(then.begin(), then.begin() + static_cast<std::ptrdiff_t>(head));
    for (std::size_t k = 3; k < j.size(); ++k) now.push_back(io::index(j[k], names_.size()));
    now.insert(now.end(), then.end() - static_cast<std::ptrdiff_t>(tail), then.end());
    demand(now.size() >= 3, "a ring has less than three vertices");
    count(now.size());
    for (const std::uint32_t name : now) ring.vertices.push_back(names_[name]);
    known_.add(identities.back(), std::move(now));
  }
  void read_pieces(const FamilyJson& j, PlanarSum& sum) {
    demand(j.is_array() && j.size() >= 4, "a list has the wrong length");
    std::size_t next = 4;
    const auto vertex = [&] {
      demand(next < j.size(), "a list has the wrong length");
      count(1);
      return names_[io::index(j[next++], names_.size())];
    };
    const auto segments = [&](const FamilyJson& n, std::vector<SumSegment>& to) {
      for (std::uint64_t k = io::whole(n, j.size()); k > 0; --k) {
        SumSegment& segment = to.emplace_back();
        segment.from = vertex();
        segment.to = vertex();
      }
    };
    const auto points = [&](const FamilyJson& n, std::vector<SumVertex>& to) {
      for (std::uint64_t k = io::whole(n, j.size()); k > 0; --k) to.push_back(vertex());
    };
    segments(j[0], sum.segments);
    points(j[1], sum.points);
    segments(j[2], sum.tight_segments);
    points(j[3], sum.tight_points);
    demand(next == j.size(), "a list has the wrong length");
  }
  /// Vertices of all cells are counted in 32 bits.
  void count(std::size_t vertices) {
    vertices_ += vertices;
    demand(vertices_ < SumVertex::kNone, "cells have more vertices than a family may have");
  }

  const FamilyJson& j_;
  planar::ScalingCells& cells_;
  std::vector<SumVertex> names_;
  io::KnownRings known_;
  std::uint64_t vertices_ = 0;
};

Result<ScalingFamily> family_of(const FamilyJson& content) {
  demand(content.at("motion") == io::kScalingMotion, "it is the family of another motion");
  const Result<Region> p = io::region_of(content.at("p")), q = io::region_of(content.at("q"));
  if (!p) return p.error();
  if (!q) return q.error();
  const Scale low = scale_in(content.at("low")), high = scale_in(content.at("high")),
              ratio = scale_in(content.at("ratio"));
  if (std::optional<Error> error = planar::empty_interval(low, high)) return *std::move(error);
  const FamilyOptions options = options_in(content.at("options"));
  FamilyOptions without_limit = options;  // what is not kept is not written
  without_limit.structure_bytes = 0;
  Result<planar::ScalingCells> made = planar::empty_cells(*p, *q, ratio, without_limit);
  if (!made) return made.error();
  planar::ScalingCells cells = *std::move(made);
  for (const Scale* end : {&low, &high})
    if (const auto both = cells.scales(planar::value_of(*end) * cells.unit); !both) return both.error();
  CellsReader(content, cells).run(low, high);
  const FamilyWork work = planar::work_of(cells);
  using State = planar::FamilyInternals::State;
  return planar::FamilyInternals::make(
      std::make_unique<State>(State{*p, *q, low, high, ratio, options, std::move(cells), work}));
}

}  // namespace

Result<ScalingFamily> parse_family(std::string_view text, std::string_view name_for_errors) {
  std::optional<ScalingFamily> read;
  const auto use = [&](const FamilyJson& content) -> Result<void> {
    Result<ScalingFamily> made = family_of(content);
    if (!made) return made.error();
    read.emplace(*std::move(made));
    return {};
  };
  const Result<void> done = io::read_checked(io::kFamilyFormat, text, name_for_errors, use);
  if (!done) return done.error();
  return *std::move(read);
}

Result<ScalingFamily> read_family(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  return parse_family(*text, path);
}

namespace {

using FamilyJson = nlohmann::json;
using planar::SumStructures;

FamilyJson name_json(const SumVertex& v) {
  FamilyJson json = FamilyJson::array();
  for (const Contact* c : {&v.in, &v.out})
    for (const std::uint32_t n : {static_cast<std::uint32_t>(c->kind), c->p, c->q}) json.push_back(n);
  if (v.corner_p == SumVertex::kNone) return json;
  json.push_back(v.corner_p);
  json.push_back(v.corner_q);
  return json;
}

FamilyJson event_json(const ScaleEvent& e) {
  return FamilyJson::array({e.parameter.to_string(), static_cast<int>(e.kind), e.visible ? 1 : 0, e.topology ? 1 : 0});
}

class CellsWriter {
 public:
  explicit CellsWriter(const planar::ScalingCells& cells) : cells_(cells) {}

  FamilyJson cell(std::uint32_t k) {
    const SumStructures& structures = cells_.structures;
    if (!structures.kept(k)) return nullptr;
    FamilyJson parts = FamilyJson::array();
    for (const SumStructures::Ring& ring : structures.rings(k)) {
      if (!ring.hole) parts.push_back(FamilyJson::array());
      parts.back().push_back(ring_json(ring));
    }
    known_.next_cell();
    return FamilyJson::array({cells_.named_at[k], std::move(parts), pieces_json(structures.pieces(k))});
  }

 private:
  FamilyJson ring_json(const SumStructures::Ring& ring) {
    const std::span<const std::uint32_t> now = cells_.structures.vertices(ring);
    const io::KnownRings::Names& then = known_.before(ring.identity);
    const std::size_t most = std::min(now.size(), then.size());
    std::size_t head = 0, tail = 0;
    while (head < most && now[head] == then[head]) ++head;
    while (head + tail < most && now[now.size() - 1 - tail] == then[then.size() - 1 - tail]) ++tail;
    FamilyJson json = FamilyJson::array({ring.identity, head, tail});
    for (const std::uint32_t name : now.subspan(head, now.size() - head - tail)) json.push_back(name);
    known_.add(ring.identity, {now.begin(), now.end()});
    return json;
  }
  FamilyJson pieces_json(const SumStructures::Pieces& pieces) const {
    FamilyJson json = FamilyJson::array({pieces.segments, pieces.points, pieces.tight_segments, pieces.tight_points});
    for (const std::uint32_t name : cells_.structures.vertices(pieces)) json.push_back(name);
    return json;
  }

  const planar::ScalingCells& cells_;
  io::KnownRings known_;
};

FamilyJson options_json(const FamilyOptions& options) {
  return {{"moving", name(options.moving)},
          {"reflect_q", options.reflect_q ? 1 : 0},
          {"semantics", name(options.semantics)},
          {"structure_bytes", options.structure_bytes}};
}

}  // namespace

std::string format_family(const ScalingFamily& family) {
  const planar::FamilyInternals::State& s = planar::FamilyInternals::of(family);
  FamilyJson content = {{"motion", io::kScalingMotion},       {"p", io::region_json(s.p)},
                        {"q", io::region_json(s.q)},          {"low", s.low.exact().to_string()},
                        {"high", s.high.exact().to_string()}, {"ratio", s.ratio.exact().to_string()},
                        {"options", options_json(s.options)}, {"events", FamilyJson::array()},
                        {"names", FamilyJson::array()},       {"cells", FamilyJson::array()}};
  for (const ScaleEvent& e : s.cells.events) content["events"].push_back(event_json(e));
  for (const SumVertex& v : s.cells.structures.names()) content["names"].push_back(name_json(v));
  CellsWriter writer(s.cells);
  for (std::uint32_t k = 0; k < s.cells.structures.cell_count(); ++k) content["cells"].push_back(writer.cell(k));
  return io::format_checked(io::kFamilyFormat, content);
}

}  // namespace dymsum
