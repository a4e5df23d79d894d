// The named repair: what can be repaired without a choice.
#include <algorithm>
#include <string>
#include <utility>

#include "dymsum/region.h"
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

// Drops duplicates, straight vertices and spikes of a ring until there are none. Every drop can make the vertices
// before it droppable: the list of kept ones is a stack. What remains to repair at the seam is dropped from either end.
class RingMender {
 public:
  explicit RingMender(const Ring& ring, RepairReport& report) : ring_(ring), report_(report) {}

  RepairedChain run() {
    for (std::uint32_t i = 0; i < ring_.size(); ++i) push(i);
    close_seam();
    RepairedChain result;
    if (kept_.size() - first_ < 3) return result;
    result.source.assign(kept_.begin() + static_cast<std::ptrdiff_t>(first_), kept_.end());
    for (const std::uint32_t i : result.source) result.chain.push_back(ring_[i]);
    return result;
  }

 private:
  std::size_t size() const { return kept_.size() - first_; }
  Point from_end(std::size_t k) const { return ring_[kept_[kept_.size() - k]]; }
  Point from_start(std::size_t k) const { return ring_[kept_[first_ + k]]; }

  void push(std::uint32_t i) {
    while (size() >= 1) {
      if (from_end(1) == ring_[i]) {
        ++report_.duplicate_vertices;
        return;
      }
      if (size() < 2 || exact::orient_sign(from_end(2), from_end(1), ring_[i]) != 0) break;
      kept_.pop_back();
      ++report_.collinear_vertices;
    }
    kept_.push_back(i);
  }

  void close_seam() {
    while (size() >= 2) {
      if (from_end(1) == from_start(0)) {
        kept_.pop_back();
        ++report_.duplicate_vertices;
      } else if (size() >= 3 && exact::orient_sign(from_end(2), from_end(1), from_start(0)) == 0) {
        kept_.pop_back();
        ++report_.collinear_vertices;
      } else if (size() >= 3 && exact::orient_sign(from_end(1), from_start(0), from_start(1)) == 0) {
        ++first_;
        ++report_.collinear_vertices;
      } else {
        return;
      }
    }
  }

  const Ring& ring_;
  RepairReport& report_;
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

RepairedChain repair_ring(const Ring& ring, bool outer, RepairReport& report) {
  RepairedChain result = RingMender(ring, report).run();
  if (result.chain.empty()) {
    ++report.dropped_rings;
  } else if (runs_counter_clockwise(result.chain) != outer) {
    ++report.reversed_rings;
    std::reverse(result.chain.begin() + 1, result.chain.end());
    std::reverse(result.source.begin() + 1, result.source.end());
  }
  return result;
}

// Folds stay: the end of a fold belongs to the set.
RepairedChain repair_polyline(const Polyline& line, RepairReport& report) {
  RepairedChain result;
  std::vector<Point>& kept = result.chain;
  for (std::uint32_t i = 0; i < line.size(); ++i) {
    if (!kept.empty() && kept.back() == line[i]) {
      ++report.duplicate_vertices;
      continue;
    }
    if (kept.size() >= 2) {
      const Point a = kept[kept.size() - 2], b = kept.back();
      if (exact::orient_sign(a, b, line[i]) == 0 && exact::dot_sign(a, b, b, line[i]) > 0) {
        kept.pop_back();
        result.source.pop_back();
        ++report.collinear_vertices;
      }
    }
    kept.push_back(line[i]);
    result.source.push_back(i);
  }
  return result;
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
                         RepairReport& report) {
  RepairedChain outer = repair_ring(part.outer, true, report);
  const bool keep = !outer.chain.empty();
  if (keep) {
    result.parts.push_back({std::move(outer.chain), {}});
    names.start_part();
    names.add_ring({index, 0, std::move(outer.source)});
  }
  for (std::size_t h = 0; h < part.holes.size(); ++h) {
    const auto ring = static_cast<std::int64_t>(h + 1);
    RepairedChain hole = repair_ring(part.holes[h], false, report);
    if (hole.chain.empty()) continue;
    if (!keep) return homeless_hole(index, ring, hole);
    result.parts.back().holes.push_back(std::move(hole.chain));
    names.add_ring({index, ring, std::move(hole.source)});
  }
  return {};
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

Result<Repaired> repair(RegionData data) {
  if (std::optional<Error> error = planar::check_finite(data)) return *std::move(error);
  RepairReport report;
  RegionData result;
  SourceNames names;
  for (std::size_t i = 0; i < data.parts.size(); ++i) {
    const Result<void> done = repair_part(data.parts[i], static_cast<std::int64_t>(i), result, names, report);
    if (!done) return done.error();
  }
  result.points = std::move(data.points);
  for (std::size_t i = 0; i < data.polylines.size(); ++i) {
    RepairedChain repaired = repair_polyline(data.polylines[i], report);
    if (repaired.chain.empty()) return empty_polyline(static_cast<std::int64_t>(i));
    if (repaired.chain.size() == 1) {
      ++report.polylines_to_points;
      result.points.push_back(repaired.chain.front());
    } else {
      result.polylines.push_back(std::move(repaired.chain));
    }
  }
  Result<Region> region = Region::create(std::move(result));
  if (region) return Repaired{std::move(region).value(), report};
  Error error = region.error();
  names.rename(error.evidence);
  return error;
}

}  // namespace dymsum
