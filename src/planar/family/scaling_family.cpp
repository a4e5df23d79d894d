#include "planar/family/scaling_family.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_budget.h"
#include "base/poll.h"
#include "dymsum/planar_operand.h"
#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "dymsum/scaling_family.h"
#include "planar/boolean/planar_boolean.h"
#include "planar/family/scaling_cells.h"
#include "planar/position/exact_source.h"
#include "planar/result/result_region.h"

namespace dymsum {

using exact::BigRational;

namespace planar {

BigRational value_of(const Scale& s) { return rational(scale_value(s)); }

std::optional<Error> empty_interval(const Scale& low, const Scale& high) {
  if (value_of(low) <= value_of(high)) return std::nullopt;
  return Error{ErrorCode::bad_scale,
               "the interval of scales is empty: " + low.exact().to_string() + " > " + high.exact().to_string(),
               {}};
}

FamilyWork work_of(const ScalingCells& cells) {
  FamilyWork work;
  work.events = cells.events.size();
  work.visible = static_cast<std::uint64_t>(
      std::count_if(cells.events.begin(), cells.events.end(), [](const ScaleEvent& e) { return e.visible; }));
  work.cells = cells.structures.cell_count();
  work.kept = cells.structures.kept_count();
  work.names = cells.structures.names().size();
  work.bytes = cells.structures.bytes();
  return work;
}

}  // namespace planar

std::optional<Error> ScalingFamily::State::outside(const Scale& s) const {
  // Rounding is monotone: where doubles differ, scales do.
  if (s.approx() > low.approx() && s.approx() < high.approx()) return std::nullopt;
  const BigRational value = planar::value_of(s);
  if (value >= planar::value_of(low) && value <= planar::value_of(high)) return std::nullopt;
  return Error{ErrorCode::bad_scale,
               "the scale " + s.exact().to_string() + " is outside of the family's interval, " +
                   low.exact().to_string() + " to " + high.exact().to_string(),
               {}};
}

std::optional<Error> ScalingFamily::State::outside(const Scale& a, const Scale& b) const {
  if (std::optional<Error> error = planar::empty_interval(a, b)) return error;
  std::optional<Error> error = outside(a);
  return error ? error : outside(b);
}

std::optional<Error> ScalingFamily::State::not_all_kept(const char* what) const {
  if (work.kept == work.cells) return std::nullopt;
  return Error{ErrorCode::out_of_memory,
               "of " + std::to_string(work.cells) + " structures " + std::to_string(work.kept) + " are kept: " + what +
                   " need all of them, allow more than " + std::to_string(options.structure_bytes) + " bytes",
               {}};
}

}  // namespace dymsum

namespace dymsum::planar {
namespace {

// What lies in a family's sum at some scale of an interval, and what lies in it at every scale.

using exact::HomogeneousPoint;

/// Rings, and lines and points without area, at exact positions for a Boolean operation.
class ExactRings {
 public:
  ExactRings() { set_.fill = Fill::positive; }

  /// Adds a ring as it is.
  void add(const std::vector<HomogeneousPoint>& ring) {
    Ring& rounded = set_.rings.emplace_back();
    for (const HomogeneousPoint& v : ring) rounded.push_back(placed(v, set_.fractions));
  }
  /// Adds a quadrangle counter-clockwise; nothing where it has no area. Requires: it does not cross itself.
  void add_quadrangle(std::vector<HomogeneousPoint> ring) {
    const BigRational area = twice_area(ring);
    if (area == 0) return;
    if (area < 0) std::reverse(ring.begin(), ring.end());
    add(ring);
  }
  /// Adds the convex hull of positions on one line: a segment, or a point.
  void add_on_line(const std::vector<HomogeneousPoint>& positions) {
    const auto before = [](const HomogeneousPoint& a, const HomogeneousPoint& b) {
      const Position u = reduced(a), v = reduced(b);
      return u.x != v.x ? u.x < v.x : u.y < v.y;
    };
    const auto [low, high] = std::minmax_element(positions.begin(), positions.end(), before);
    if (before(*low, *high)) set_.lines.push_back({placed(*low, of_lines_), placed(*high, of_lines_)});
    else set_.points.push_back(placed(*low, of_points_));
  }
  /// Adds a quadrangle, also where it has no area.
  void add_closed_quadrangle(const std::vector<HomogeneousPoint>& ring) {
    if (twice_area(ring) == 0) add_on_line(ring);
    else add_quadrangle(ring);
  }
  BooleanTerms terms() && {
    set_.fractions.insert(set_.fractions.end(), of_lines_.begin(), of_lines_.end());
    set_.fractions.insert(set_.fractions.end(), of_points_.begin(), of_points_.end());
    if (doubles_) set_.fractions.clear();
    BooleanTerms terms;
    terms.inputs.push_back(std::make_shared<const RingSet>(std::move(set_)));
    terms.steps = {0};
    return terms;
  }

 private:
  Point placed(const HomogeneousPoint& v, std::vector<HomogeneousPoint>& fractions) {
    const Position at = reduced(v);
    const Point rounded{exact::round_to_double(at.x), exact::round_to_double(at.y)};
    fractions.push_back(exact::in_lowest_terms(v));
    doubles_ &= is_double(fractions.back(), rounded);
    return rounded;
  }
  static BigRational twice_area(const std::vector<HomogeneousPoint>& ring) {
    BigRational sum = 0;
    Position last = reduced(ring.back());
    for (const HomogeneousPoint& v : ring) {
      Position at = reduced(v);
      sum += last.x * at.y - last.y * at.x;
      last = std::move(at);
    }
    return sum;
  }

  RingSet set_;
  std::vector<HomogeneousPoint> of_lines_, of_points_;
  bool doubles_ = true;
};

SumOptions of_semantics(Semantics semantics) {
  SumOptions options;
  options.semantics = semantics;
  return options;
}

/// The union of diag(x s, y s) times a region for s in [a, b], exact and closed. Each point runs along a ray from the
/// origin, so it is the region at both ends with a quadrangle for every edge, which of a polyline's is a segment where
/// its line passes the origin, and a segment for every point. Requires: 0 < a <= b. Errors: as Boolean operations.
Result<PlanarSum> swept_region(const Region& region, const Factors& factors, const BigRational& a,
                               const BigRational& b) {
  const BigRational x = rational(factors.x), y = rational(factors.y);
  const auto at = [&](Point v, const BigRational& s) {
    return homogeneous(Position{exact::exact_value(v.x) * x * s, exact::exact_value(v.y) * y * s});
  };
  ExactRings rings;
  const auto add = [&](const Ring& ring) {
    for (const BigRational& s : {a, b}) {
      std::vector<HomogeneousPoint> placed;
      for (const Point& v : ring) placed.push_back(at(v, s));
      rings.add(placed);
    }
    for (std::size_t k = 0; k < ring.size() && a != b; ++k) {
      const Point from = ring[k], to = ring[(k + 1) % ring.size()];
      rings.add_quadrangle({at(from, a), at(to, a), at(to, b), at(from, b)});
    }
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    std::for_each(part.holes.begin(), part.holes.end(), add);
  }
  for (const Polyline& line : region.polylines())
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      rings.add_on_line({at(line[k], a), at(line[k + 1], a)});
      rings.add_on_line({at(line[k], b), at(line[k + 1], b)});
      rings.add_closed_quadrangle({at(line[k], a), at(line[k + 1], a), at(line[k + 1], b), at(line[k], b)});
    }
  for (const Point& point : region.points()) rings.add_on_line({at(point, a), at(point, b)});
  return evaluate(std::move(rings).terms(), of_semantics(Semantics::closed));
}

/// The edges of the boundary, and the cells in which each is there.
struct LivingEdge {
  std::uint32_t from = 0, to = 0;  // names
  std::uint32_t first_cell = 0, last_cell = 0;
};

std::vector<LivingEdge> edges_in(const SumStructures& structures, std::uint32_t first_cell, std::uint32_t last_cell) {
  std::vector<LivingEdge> edges;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> last;
  for (std::uint32_t cell = first_cell; cell <= last_cell; ++cell)
    for (const SumStructures::Ring& ring : structures.rings(cell)) {
      const auto vertices = structures.vertices(ring);
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        const std::uint32_t from = vertices[k], to = vertices[(k + 1) % vertices.size()];
        const auto [at, fresh] = last.try_emplace({from, to}, edges.size());
        if (!fresh && edges[at->second].last_cell + 1 >= cell) {
          edges[at->second].last_cell = cell;
          continue;
        }
        at->second = edges.size();
        edges.push_back({from, to, cell, cell});
      }
    }
  return edges;
}

/// Exact positions of a family's vertices where cells begin and end.
class PositionsAtEnds {
 public:
  PositionsAtEnds(const ScalingCells& cells, const BigRational& a, const BigRational& b)
      : cells_(cells), a_(a), b_(b) {}

  /// Before event k, which is event 0 at the beginning of cell 0; within [a, b].
  HomogeneousPoint begin(std::uint32_t cell, std::uint32_t name) {
    return at(cell == 0 ? a_ : std::max(a_, scale_of(cell - 1)), name);
  }
  HomogeneousPoint end(std::uint32_t cell, std::uint32_t name) {
    return at(cell == cells_.events.size() ? b_ : std::min(b_, scale_of(cell)), name);
  }

 private:
  BigRational scale_of(std::uint32_t event) const {
    return exact::exact_value(cells_.events[event].parameter) * cells_.unit;
  }
  HomogeneousPoint at(const BigRational& t, std::uint32_t name) {
    std::unique_ptr<FrameSource>& source = sources_[t];
    if (source == nullptr)
      source = std::make_unique<FrameSource>(cells_.path.swept, cells_.path.swept->lattice_scale(scale_value(t)));
    return source->homogeneous(cells_.structures.names()[name]);
  }

  const ScalingCells& cells_;
  BigRational a_, b_;
  std::map<BigRational, std::unique_ptr<FrameSource>> sources_;
};

/// The closure of the interior of the intersection of a family's sums at t in [a, b], t as the path has it; `first` is
/// the one at a. An interior point of `first` leaves the intersection where an edge of the boundary passes it. Edges
/// keep their directions, so what one passes is a quadrangle, from its first position to its last one. Requires: the
/// structures in between are kept. Errors: as Boolean operations.
Result<PlanarSum> common_set(const ScalingCells& cells, const PlanarSum& first, const BigRational& a,
                             const BigRational& b) {
  const auto cell_of = [&](const BigRational& t, bool after) {
    std::uint32_t cell = 0;
    for (const ScaleEvent& e : cells.events) {
      const BigRational at = exact::exact_value(e.parameter) * cells.unit;
      if (at > t || (at == t && !after)) break;
      ++cell;
    }
    return cell;
  };
  const std::uint32_t first_cell = cell_of(a, true), last_cell = std::max(first_cell, cell_of(b, false));
  PositionsAtEnds positions(cells, a, b);
  ExactRings passed;
  for (const LivingEdge& edge : edges_in(cells.structures, first_cell, last_cell))
    passed.add_quadrangle({positions.begin(edge.first_cell, edge.from), positions.begin(edge.first_cell, edge.to),
                           positions.end(edge.last_cell, edge.to), positions.end(edge.last_cell, edge.from)});
  BooleanTerms terms;
  append_difference(terms_of_parts(first), std::move(passed).terms(), terms);
  return evaluate(std::move(terms), of_semantics(Semantics::regular));
}

}  // namespace
}  // namespace dymsum::planar

namespace dymsum {

using namespace planar;

ScalingFamily::ScalingFamily(std::unique_ptr<const State> state) : state_(std::move(state)) {}
ScalingFamily::ScalingFamily(ScalingFamily&&) noexcept = default;
ScalingFamily& ScalingFamily::operator=(ScalingFamily&&) noexcept = default;
ScalingFamily::~ScalingFamily() = default;

namespace {

/// The options that queries need: a progress is of the making alone.
FamilyOptions at_rest(FamilyOptions options) {
  options.progress = {};
  return options;
}

}  // namespace

Result<ScalingFamily> ScalingFamily::create(const Region& p, const Region& q, const Scale& low, const Scale& high,
                                            const FamilyOptions& options) {
  return create(p, q, low, high, Scale(), options);
}

Result<ScalingFamily> ScalingFamily::create(const Region& p, const Region& q, const Scale& low, const Scale& high,
                                            const Scale& ratio, const FamilyOptions& options) {
  const Stopwatch watch;
  if (std::optional<Error> error = empty_interval(low, high)) return *std::move(error);
  Result<ScalingCells> cells = base::within_memory(options.memory, "the family of sums",
                                                   [&] { return scaling_cells(p, q, low, high, ratio, options); });
  if (!cells) return cells.error();
  FamilyWork work = work_of(*cells);
  work.ms = watch.ms();
  return ScalingFamily(
      std::make_unique<State>(State{p, q, low, high, ratio, at_rest(options), *std::move(cells), work}));
}

const Region& ScalingFamily::p() const { return state_->p; }
const Region& ScalingFamily::q() const { return state_->q; }
const FamilyOptions& ScalingFamily::options() const { return state_->options; }
const Scale& ScalingFamily::low() const { return state_->low; }
const Scale& ScalingFamily::high() const { return state_->high; }
const Scale& ScalingFamily::ratio() const { return state_->ratio; }
const std::vector<ScaleEvent>& ScalingFamily::events() const { return state_->cells.events; }
const FamilyWork& ScalingFamily::work() const { return state_->work; }

ScalingFamily::Location ScalingFamily::locate(const Scale& s) const {
  const auto [index, event] = state_->cells.locate(s);
  return {index, event};
}

Result<PlanarSum> ScalingFamily::at(const Scale& s) const {
  if (std::optional<Error> error = state_->outside(s)) return *std::move(error);
  return state_->cells.at(s, state_->options.semantics);
}

std::vector<ScaleEvent> ScalingFamily::changes(const Scale& a, const Scale& b, EventChange change) const {
  const BigRational low = value_of(a), high = value_of(b);
  std::vector<ScaleEvent> found;
  for (const ScaleEvent& e : events()) {
    if (!(change == EventChange::topology ? e.topology : e.visible)) continue;
    if (const BigRational at = exact::exact_value(e.parameter); at >= low && at <= high) found.push_back(e);
  }
  return found;
}

std::optional<ScaleEvent> ScalingFamily::next(const Scale& s, EventChange change) const {
  const auto [index, event] = state_->cells.locate(s);
  for (std::size_t k = event ? index + std::size_t{1} : index; k < events().size(); ++k)
    if (change == EventChange::topology ? events()[k].topology : events()[k].visible) return events()[k];
  return std::nullopt;
}

Result<std::vector<Lifetime>> ScalingFamily::lifetimes() const {
  if (std::optional<Error> error = state_->not_all_kept("lifetimes")) return *std::move(error);
  return lifetimes_of(state_->cells.structures);
}

Result<std::vector<std::uint64_t>> ScalingFamily::ring_ids(const Scale& s) const {
  const Result<PlanarSum> sum = at(s);
  if (!sum) return sum.error();
  return state_->cells.ring_ids(*sum, s);
}

Result<PlanarSum> ScalingFamily::outer(const Scale& a, const Scale& b) const {
  if (std::optional<Error> error = state_->outside(a, b)) return *std::move(error);
  const FamilyOptions& options = state_->options;
  const bool p_moves = options.moving == MovingOperand::p;
  const Result<PlanarSum> swept =
      swept_region(p_moves ? state_->p : state_->q, {{}, scale_value(state_->ratio)}, value_of(a), value_of(b));
  if (!swept) return swept;
  SumOptions sum;
  sum.semantics = options.semantics;
  const PlanarOperand p = p_moves ? PlanarOperand(*swept) : PlanarOperand(state_->p),
                      q = p_moves ? PlanarOperand(state_->q) : PlanarOperand(*swept);
  return options.reflect_q ? nfp(p, q, sum) : minkowski_sum(p, q, sum);
}

Result<PlanarSum> ScalingFamily::inner(const Scale& a, const Scale& b) const {
  if (std::optional<Error> error = state_->outside(a, b)) return *std::move(error);
  if (std::optional<Error> error = state_->not_all_kept("common sets")) return *std::move(error);
  const Result<PlanarSum> first = at(a);
  if (!first) return first;
  const BigRational unit = state_->cells.unit;
  return common_set(state_->cells, *first, value_of(a) * unit, value_of(b) * unit);
}

}  // namespace dymsum
