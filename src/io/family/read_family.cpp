// Every entry is looked at, so that a file that is not what was written is refused before anything uses it.
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "dymsum/family_file.h"
#include "io/family/family_text.h"
#include "io/family/name_check.h"
#include "io/read_file.h"
#include "planar/family/scaling_family.h"

namespace dymsum {
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

}  // namespace dymsum
