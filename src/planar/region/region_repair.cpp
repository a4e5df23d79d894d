// The named repair: what can be repaired without a choice.
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "dymsum/named_repairs.h"
#include "exact/orient.h"
#include "planar/region/region_validate.h"

namespace dymsum {

namespace {

bool lexicographically_less(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

// A repaired chain, and where each of its vertices was.
struct RepairedChain {
  std::vector<Point> chain;
  std::vector<std::uint32_t> source;
};

// What may be repaired, and what was.
class RepairNotes {
 public:
  explicit RepairNotes(const RegionRepairOptions& options) : options_(options) {}

  bool may(RegionRepairKind kind) const {
    return std::find(options_.kinds.begin(), options_.kinds.end(), kind) != options_.kinds.end();
  }
  void add(RegionRepairKind kind, Point at) {
    const auto k = static_cast<std::size_t>(kind);
    if (++counts_[k] <= RegionRepairLog::kMostMarks) marks_[k].push_back({kind, at});
  }
  RegionRepairLog log() const {
    RegionRepairLog log{{counts_[0], counts_[1], counts_[2], counts_[3], counts_[5]}, counts_[4], {}};
    for (const std::vector<RegionRepairMark>& of_kind : marks_)
      log.marks.insert(log.marks.end(), of_kind.begin(), of_kind.end());
    return log;
  }

 private:
  static constexpr std::size_t kKinds = 6;
  static_assert(static_cast<std::size_t>(RegionRepairKind::short_polylines) + 1 == kKinds);
  const RegionRepairOptions& options_;
  std::array<std::size_t, kKinds> counts_{};
  std::array<std::vector<RegionRepairMark>, kKinds> marks_;
};

// Drops duplicates, straight vertices and spikes of a ring until there are none. Every drop can make the vertices
// before it droppable: the list of kept ones is a stack. What remains to repair at the seam is dropped from either end.
class RingMender {
 public:
  explicit RingMender(const Ring& ring, RepairNotes& log) : ring_(ring), log_(log) {}

  RepairedChain run() {
    for (std::uint32_t i = 0; i < ring_.size(); ++i) push(i);
    close_seam();
    RepairedChain result;
    if (kept_.size() - first_ < 3 && log_.may(RegionRepairKind::empty_rings)) return result;
    result.source.assign(kept_.begin() + static_cast<std::ptrdiff_t>(first_), kept_.end());
    for (const std::uint32_t i : result.source) result.chain.push_back(ring_[i]);
    return result;
  }

 private:
  std::size_t size() const { return kept_.size() - first_; }
  Point from_end(std::size_t k) const { return ring_[kept_[kept_.size() - k]]; }
  Point from_start(std::size_t k) const { return ring_[kept_[first_ + k]]; }

  bool merges() const { return log_.may(RegionRepairKind::duplicate_vertices); }
  bool straightens() const { return log_.may(RegionRepairKind::collinear_vertices); }
  bool bends_nowhere(Point a, Point b, Point c) const {
    return straightens() && size() >= 3 && exact::orient_sign(a, b, c) == 0;
  }

  void push(std::uint32_t i) {
    while (size() >= 1) {
      if (merges() && from_end(1) == ring_[i]) return log_.add(RegionRepairKind::duplicate_vertices, ring_[i]);
      if (!straightens() || size() < 2 || exact::orient_sign(from_end(2), from_end(1), ring_[i]) != 0) break;
      log_.add(RegionRepairKind::collinear_vertices, from_end(1));
      kept_.pop_back();
    }
    kept_.push_back(i);
  }

  void close_seam() {
    while (size() >= 2) {
      if (merges() && from_end(1) == from_start(0)) {
        log_.add(RegionRepairKind::duplicate_vertices, from_end(1));
        kept_.pop_back();
      } else if (bends_nowhere(from_end(2), from_end(1), from_start(0))) {
        log_.add(RegionRepairKind::collinear_vertices, from_end(1));
        kept_.pop_back();
      } else if (bends_nowhere(from_end(1), from_start(0), from_start(1))) {
        log_.add(RegionRepairKind::collinear_vertices, from_start(0));
        ++first_;
      } else {
        return;
      }
    }
  }

  const Ring& ring_;
  RepairNotes& log_;
  std::vector<std::uint32_t> kept_;
  std::size_t first_ = 0;
};

// True when the ring runs counter-clockwise. All its rays at the lexicographically smallest point go right, and what
// lies under the lowest is outside. Requires a repaired ring; means nothing for one that crosses itself.
bool runs_counter_clockwise(const Ring& ring) {
  const Point start = *std::min_element(ring.begin(), ring.end(), lexicographically_less);
  bool first = true, outgoing = true;
  Point lowest{};
  const auto offer = [&](Point end, bool out) {
    if (!first && exact::orient_sign(start, lowest, end) >= 0) return;
    first = false;
    lowest = end;
    outgoing = out;
  };
  for (std::size_t i = 0, before = ring.size() - 1; i < ring.size(); before = i++) {
    if (ring[before] == start) offer(ring[i], true);
    if (ring[i] == start) offer(ring[before], false);
  }
  return outgoing;
}

bool is_dropped(const Ring& chain, const RepairNotes& log) {
  return chain.empty() && log.may(RegionRepairKind::empty_rings);
}

RepairedChain repair_ring(const Ring& ring, bool outer, RepairNotes& log) {
  RepairedChain result = RingMender(ring, log).run();
  if (is_dropped(result.chain, log)) {
    log.add(RegionRepairKind::empty_rings, ring.empty() ? Point{} : ring.front());
  } else if (log.may(RegionRepairKind::reversed_rings) && result.chain.size() > 2 &&
             runs_counter_clockwise(result.chain) != outer) {
    log.add(RegionRepairKind::reversed_rings, result.chain.front());
    std::reverse(result.chain.begin() + 1, result.chain.end());
    std::reverse(result.source.begin() + 1, result.source.end());
  }
  return result;
}

// Folds stay: the end of a fold belongs to the set.
RepairedChain repair_polyline(const Polyline& line, RepairNotes& log) {
  RepairedChain result;
  std::vector<Point>& kept = result.chain;
  for (std::uint32_t i = 0; i < line.size(); ++i) {
    if (log.may(RegionRepairKind::duplicate_vertices) && !kept.empty() && kept.back() == line[i]) {
      log.add(RegionRepairKind::duplicate_vertices, line[i]);
      continue;
    }
    if (log.may(RegionRepairKind::collinear_vertices) && kept.size() >= 2) {
      const Point a = kept[kept.size() - 2], b = kept.back();
      if (exact::orient_sign(a, b, line[i]) == 0 && exact::dot_sign(a, b, b, line[i]) > 0) {
        log.add(RegionRepairKind::collinear_vertices, kept.back());
        kept.pop_back();
        result.source.pop_back();
      }
    }
    kept.push_back(line[i]);
    result.source.push_back(i);
  }
  return result;
}

// A ring's coordinates from its smallest vertex on: equal for rings that are written alike but for where they begin.
using RingKey = std::vector<std::pair<double, double>>;
RingKey key_of(const Ring& ring) {
  RingKey key;
  for (const Point p : ring) key.emplace_back(p.x, p.y);
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  return key;
}
// The key of a part, with its holes in any order.
std::pair<RingKey, std::set<RingKey>> key_of(const Part& part) {
  std::set<RingKey> holes;
  for (const Ring& hole : part.holes) holes.insert(key_of(hole));
  return {key_of(part.outer), std::move(holes)};
}

// A repaired ring and the numbers it had in the given data.
struct RingSource {
  std::int64_t part, ring;
  std::vector<std::uint32_t> vertices;
};

// Writes the indices of the given data into the evidence of an error about repaired data.
class SourceNames {
 public:
  void start_part() { parts_.emplace_back(); }
  void add_ring(RingSource source) { parts_.back().push_back(std::move(source)); }

  void drop_last_part() { parts_.pop_back(); }

  void rename(Evidence& evidence) const {
    rename(evidence.part, evidence.ring, evidence.vertex);
    rename(evidence.other_part, evidence.other_ring, evidence.other_vertex);
  }

 private:
  using Index = std::optional<std::int64_t>;
  void rename(Index& part, Index& ring, Index& vertex) const {
    if (!part || !ring) return;
    const RingSource& source = parts_[static_cast<std::size_t>(*part)][static_cast<std::size_t>(*ring)];
    part = source.part;
    ring = source.ring;
    if (vertex) vertex = source.vertices[static_cast<std::size_t>(*vertex)];
  }

  std::vector<std::vector<RingSource>> parts_;
};

// A hole with area whose outer ring has none.
Error homeless_hole(std::int64_t part, std::int64_t ring, const RepairedChain& hole) {
  Error error{ErrorCode::hole_outside, "the outer ring of a hole encloses nothing", {}};
  error.evidence.part = part;
  error.evidence.ring = ring;
  error.evidence.vertex = hole.source.front();
  error.evidence.x = hole.chain.front().x;
  error.evidence.y = hole.chain.front().y;
  return error;
}

Result<void> repair_part(const Part& part, std::int64_t index, RegionData& result, SourceNames& names,
                         RepairNotes& log) {
  RepairedChain outer = repair_ring(part.outer, true, log);
  const bool keep = !is_dropped(outer.chain, log);
  if (keep) {
    result.parts.push_back({std::move(outer.chain), {}});
    names.start_part();
    names.add_ring({index, 0, std::move(outer.source)});
  }
  std::set<RingKey> holes;
  for (std::size_t h = 0; h < part.holes.size(); ++h) {
    const auto ring = static_cast<std::int64_t>(h + 1);
    RepairedChain hole = repair_ring(part.holes[h], false, log);
    if (is_dropped(hole.chain, log)) continue;
    if (!keep) return homeless_hole(index, ring, hole);
    if (log.may(RegionRepairKind::duplicate_rings) && !holes.insert(key_of(hole.chain)).second) {
      log.add(RegionRepairKind::duplicate_rings, hole.chain.front());
      continue;
    }
    result.parts.back().holes.push_back(std::move(hole.chain));
    names.add_ring({index, ring, std::move(hole.source)});
  }
  return {};
}

using PartKeys = std::set<std::pair<RingKey, std::set<RingKey>>>;

// Drops the last part where one before it is the same.
void drop_if_known(RegionData& result, PartKeys& known, SourceNames& names, RepairNotes& log) {
  if (!log.may(RegionRepairKind::duplicate_rings) || known.insert(key_of(result.parts.back())).second) return;
  log.add(RegionRepairKind::duplicate_rings, result.parts.back().outer.front());
  result.parts.pop_back();
  names.drop_last_part();
}

Error empty_polyline(std::int64_t index) {
  Error error{ErrorCode::too_few_vertices, "a polyline needs at least two vertices", {}};
  error.evidence.ring = index;
  return error;
}

}  // namespace

std::string RepairReport::to_string() const {
  std::vector<std::string> changes;
  const auto add = [&changes](std::size_t count, const char* one, const char* many, const char* what) {
    if (count > 0) changes.push_back(std::to_string(count) + " " + (count == 1 ? one : many) + " " + what);
  };
  add(duplicate_vertices, "duplicate vertex", "duplicate vertices", "merged");
  add(collinear_vertices, "collinear vertex", "collinear vertices", "dropped");
  add(reversed_rings, "ring", "rings", "reversed");
  add(dropped_rings, "empty ring", "empty rings", "dropped");
  add(polylines_to_points, "polyline", "polylines", "collapsed to a point");
  if (changes.empty()) return "nothing to repair";
  std::string text = changes.front();
  for (std::size_t i = 1; i < changes.size(); ++i) text += ", " + changes[i];
  return text;
}

std::vector<RegionRepairKind> all_region_repairs() {
  return {RegionRepairKind::duplicate_vertices, RegionRepairKind::collinear_vertices,
          RegionRepairKind::reversed_rings,     RegionRepairKind::empty_rings,
          RegionRepairKind::duplicate_rings,    RegionRepairKind::short_polylines};
}

std::vector<RegionRepairKind> RegionRepairLog::kinds() const {
  std::vector<RegionRepairKind> made;
  for (const RegionRepairMark& mark : marks)
    if (made.empty() || made.back() != mark.kind) made.push_back(mark.kind);
  return made;
}

std::string RegionRepairLog::to_string() const {
  if (duplicate_rings == 0) return counts.to_string();
  return (counts.changed() ? counts.to_string() + ", " : "") + std::to_string(duplicate_rings) +
         (duplicate_rings == 1 ? " ring that was there already dropped" : " rings that were there already dropped");
}

Result<Repaired> repair(RegionData data) {
  RegionRepairOptions options;
  std::erase(options.kinds, RegionRepairKind::duplicate_rings);  // which the report does not count
  Result<LoggedRegion> logged = repair(std::move(data), options);
  if (!logged) return logged.error();
  LoggedRegion repaired = std::move(logged).value();
  return Repaired{std::move(repaired.region), repaired.log.counts};
}

Result<LoggedRegion> repair(RegionData data, const RegionRepairOptions& options) {
  if (std::optional<Error> error = planar::check_finite(data)) return *std::move(error);
  RepairNotes log(options);
  PartKeys known;
  RegionData result;
  SourceNames names;
  for (std::size_t i = 0; i < data.parts.size(); ++i) {
    const std::size_t before = result.parts.size();
    const Result<void> done = repair_part(data.parts[i], static_cast<std::int64_t>(i), result, names, log);
    if (!done) return done.error();
    if (result.parts.size() > before) drop_if_known(result, known, names, log);
  }
  result.points = std::move(data.points);
  for (std::size_t i = 0; i < data.polylines.size(); ++i) {
    RepairedChain repaired = repair_polyline(data.polylines[i], log);
    if (repaired.chain.empty()) return empty_polyline(static_cast<std::int64_t>(i));
    if (repaired.chain.size() == 1 && log.may(RegionRepairKind::short_polylines)) {
      log.add(RegionRepairKind::short_polylines, repaired.chain.front());
      result.points.push_back(repaired.chain.front());
    } else {
      result.polylines.push_back(std::move(repaired.chain));
    }
  }
  Result<Region> region = Region::create(std::move(result));
  if (region) return LoggedRegion{std::move(region).value(), log.log()};
  Error error = region.error();
  names.rename(error.evidence);
  return error;
}

}  // namespace dymsum
