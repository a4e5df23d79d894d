#include "planar/family/scaling_cells.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "planar/frame/frame_rings.h"
#include "planar/result/planar_sum.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum::planar {

std::uint32_t SumStructures::name_of(const SumVertex& vertex) const {
  const auto [first, last] = index_.equal_range(key(vertex));
  for (auto at = first; at != last; ++at) {
    const SumVertex& known = names_[at->second];
    if (known.in == vertex.in && known.out == vertex.out && known.corner_p == vertex.corner_p &&
        known.corner_q == vertex.corner_q)
      return at->second;
  }
  return kNoName;
}

std::uint32_t SumStructures::made_name(const SumVertex& vertex) {
  if (const std::uint32_t known = name_of(vertex); known != kNoName) return known;
  names_.push_back(vertex);
  const auto index = static_cast<std::uint32_t>(names_.size() - 1);
  index_.emplace(key(vertex), index);
  return index;
}

void SumStructures::add_ring(const SumRing& ring, std::uint32_t part, bool hole, std::uint64_t identity) {
  const auto first = static_cast<std::uint32_t>(items_.size());
  for (const SumVertex& v : ring.vertices) items_.push_back(made_name(v));
  rings_.push_back({first, static_cast<std::uint32_t>(items_.size()), part, hole, identity});
}

SumStructures::Pieces SumStructures::add_pieces(const PlanarSum& sum) {
  Pieces pieces;
  pieces.first = static_cast<std::uint32_t>(items_.size());
  const auto segments = [&](const std::vector<SumSegment>& from) {
    for (const SumSegment& s : from) {
      items_.push_back(made_name(s.from));
      items_.push_back(made_name(s.to));
    }
    return static_cast<std::uint32_t>(from.size());
  };
  const auto points = [&](const std::vector<SumVertex>& from) {
    for (const SumVertex& v : from) items_.push_back(made_name(v));
    return static_cast<std::uint32_t>(from.size());
  };
  pieces.segments = segments(sum.segments);
  pieces.points = points(sum.points);
  pieces.tight_segments = segments(sum.tight_segments);
  pieces.tight_points = points(sum.tight_points);
  return pieces;
}

std::uint32_t SumStructures::add(const PlanarSum& sum, std::span<const std::uint64_t> identities) {
  const auto first_new = static_cast<std::uint32_t>(names_.size());
  if (most_bytes_ != 0 && bytes() > most_bytes_) {
    add_dropped();
    return first_new;
  }
  Cell cell;
  cell.first_ring = static_cast<std::uint32_t>(rings_.size());
  std::size_t ring = 0;
  const auto identity = [&] { return ring < identities.size() ? identities[ring++] : 0; };
  for (std::uint32_t part = 0; part < sum.parts.size(); ++part) {
    add_ring(sum.parts[part].outer, part, false, identity());
    for (const SumRing& hole : sum.parts[part].holes) add_ring(hole, part, true, identity());
  }
  cell.last_ring = static_cast<std::uint32_t>(rings_.size());
  cell.pieces = add_pieces(sum);
  cells_.push_back(cell);
  ++kept_;
  return first_new;
}

std::size_t SumStructures::bytes() const {
  constexpr std::size_t kOfName = sizeof(SumVertex) + 32;  // with its entry in the index
  return names_.size() * kOfName + items_.size() * sizeof(std::uint32_t) + rings_.size() * sizeof(Ring) +
         cells_.size() * sizeof(Cell);
}

std::span<const SumStructures::Ring> SumStructures::rings(std::uint32_t cell) const {
  return std::span(rings_).subspan(cells_[cell].first_ring, cells_[cell].last_ring - cells_[cell].first_ring);
}

namespace {

/// The lifetimes of features by their keys, extended cell by cell.
class LivingFeatures {
 public:
  /// The feature is there in a cell; `made` is what a new lifetime of it says.
  void live(std::uint64_t feature, std::uint32_t cell, const Lifetime& made) {
    const auto [at, fresh] = last_.try_emplace(feature, lifetimes_.size());
    if (!fresh && lifetimes_[at->second].last_cell + 1 >= cell) {
      lifetimes_[at->second].last_cell = cell;
      return;
    }
    at->second = lifetimes_.size();
    lifetimes_.push_back(made);
    lifetimes_.back().first_cell = lifetimes_.back().last_cell = cell;
  }
  std::vector<Lifetime>& lifetimes() { return lifetimes_; }

 private:
  std::unordered_map<std::uint64_t, std::size_t> last_;
  std::vector<Lifetime> lifetimes_;
};

std::uint64_t index_of_contact(const Contact& c, std::vector<Contact>& contacts,
                               std::unordered_multimap<std::uint64_t, std::uint64_t>& index) {
  const auto [first, last] = index.equal_range(key(c));
  for (auto at = first; at != last; ++at)
    if (contacts[at->second] == c) return at->second;
  contacts.push_back(c);
  index.emplace(key(c), contacts.size() - 1);
  return contacts.size() - 1;
}

}  // namespace

std::vector<Lifetime> lifetimes_of(const SumStructures& structures) {
  LivingFeatures vertices, edges, holes;
  std::vector<Contact> contacts;
  std::unordered_multimap<std::uint64_t, std::uint64_t> index;
  for (std::uint32_t cell = 0; cell < structures.cell_count(); ++cell)
    for (const SumStructures::Ring& ring : structures.rings(cell)) {
      if (ring.hole && ring.identity != 0)
        holes.live(ring.identity, cell,
                   {FamilyFeature::hole, {}, {}, SumVertex::kNone, SumVertex::kNone, ring.identity, 0, 0});
      for (const std::uint32_t item : structures.vertices(ring)) {
        const SumVertex& v = structures.names()[item];
        vertices.live(item, cell, {FamilyFeature::vertex, v.in, v.out, v.corner_p, v.corner_q, 0, 0, 0});
        edges.live(index_of_contact(v.out, contacts, index), cell,
                   {FamilyFeature::edge, v.out, v.out, SumVertex::kNone, SumVertex::kNone, 0, 0, 0});
      }
    }
  std::vector<Lifetime> all = std::move(vertices.lifetimes());
  all.insert(all.end(), edges.lifetimes().begin(), edges.lifetimes().end());
  all.insert(all.end(), holes.lifetimes().begin(), holes.lifetimes().end());
  return all;
}

using exact::BigRational;

namespace {

LatticeScale scale_of(const OperandPair& base, int s) { return base.lattice_scale(scale_value(BigRational(s))); }

double reach_of(const OperandPair& base, std::uint32_t op) {
  double reach = 0;
  for (const Point& v : base.lattice->points[op]->input) reach = std::max({reach, std::abs(v.x), std::abs(v.y)});
  return reach;
}

}  // namespace

ScaledPositions::ScaledPositions(std::shared_ptr<const OperandPair> base)
    : base_(base),
      ends_{FrameSource(base, scale_of(*base, 1)), FrameSource(base, scale_of(*base, 2))},
      still_(reach_of(*base, 1 - base->moved)),
      moved_(reach_of(*base, base->moved)) {}

void ScaledPositions::add(std::span<const SumVertex> vertices, double at) {
  for (const SumVertex& v : vertices) paths_.push_back(v.corner_p != SumVertex::kNone ? corner(v) : crossing(v, at));
}

ScaledPositions::Path ScaledPositions::corner(const SumVertex& v) const {
  const auto source = [&](std::uint32_t op) {
    return base_->operands[op].vertex_of_index[op == 0 ? v.corner_p : v.corner_q];
  };
  const std::uint32_t moved = base_->moved;
  const PlacedPoints &moves = *base_->lattice->points[moved], &stays = *base_->lattice->points[1 - moved];
  const Point m = moves.input[source(moved)], s = stays.input[source(1 - moved)];
  Path path{s.x, s.y, m.x * moves.factors.x, m.y * moves.factors.y};
  path.size = std::max(std::abs(path.x), std::abs(path.y));
  path.speed = std::max(std::abs(path.dx), std::abs(path.dy));
  return path;
}

ScaledPositions::Path ScaledPositions::crossing(const SumVertex& v, double at) const {
  const ExactSource::Position one = ends_[0].position(v), two = ends_[1].position(v);
  const BigRational dx = two.x - one.x, dy = two.y - one.y, from = exact::exact_value(at) - 1;
  Path path{exact::round_to_double(one.x + from * dx), exact::round_to_double(one.y + from * dy),
            exact::round_to_double(dx), exact::round_to_double(dy), at};
  path.size = std::max(std::abs(path.x), std::abs(path.y));
  path.speed = std::max(std::abs(path.dx), std::abs(path.dy));
  return path;
}

namespace {

MovingOptions moving_options(const FamilyOptions& options) {
  MovingOptions moving;
  moving.moving = options.moving;
  moving.reflect_q = options.reflect_q;
  moving.semantics = options.semantics;
  return moving;
}

/// Exact positions at a scale, placed when first requested.
class PathSource final : public ExactSource {
 public:
  PathSource(std::shared_ptr<const OperandPair> base, const Scale& t) : base_(std::move(base)), t_(t) {}
  Position position(const SumVertex& v) const override { return frame().position(v); }
  Homogeneous homogeneous(const SumVertex& v) const override { return frame().homogeneous(v); }
  std::optional<NearFrame> near_frame() const override { return frame().near_frame(); }
  NearPosition near(const SumVertex& v) const override { return frame().near(v); }
  int compare_x(const SumVertex& a, const SumVertex& b) const override { return frame().compare_x(a, b); }
  int compare_y(const SumVertex& a, const SumVertex& b) const override { return frame().compare_y(a, b); }

 private:
  const FrameSource& frame() const {
    std::call_once(made_,
                   [this] { frame_ = std::make_unique<FrameSource>(base_, base_->lattice_scale(scale_value(t_))); });
    return *frame_;
  }

  std::shared_ptr<const OperandPair> base_;
  Scale t_;
  mutable std::once_flag made_;
  mutable std::unique_ptr<const FrameSource> frame_;
};

/// Takes over events, and the structure of the sum after each.
class CellVisitor final : public EventVisitor {
 public:
  explicit CellVisitor(ScalingCells& cells) : cells_(cells) {}

  void before_events(const ScalingState& before) override { add(before); }
  bool passes(const ScaleEvent& event, const ScalingState& after) override {
    ScaleEvent own = event;
    if (!cells_.unit_is_one) {
      const BigRational s = exact::exact_value(event.parameter) / cells_.unit;
      own.parameter = exact::to_rational(s);
      own.approx = exact::round_to_double(s);
    }
    cells_.events.push_back(own);
    add(after);
    return true;
  }
  void add(const ScalingState& state) {
    cells_.add_cell(state.sum, state.ring_ids, std::max(state.scale.approx(), state.scale_y.approx()));
  }

 private:
  ScalingCells& cells_;
};

/// diag(x, y) with y = ratio x, as the path that windows can serve.
Result<ScalingCells> cells_along(std::shared_ptr<const OperandPair> base, const Scale& ratio,
                                 const FamilyOptions& options) {
  ScalingCells cells{{base, base, {}}, 1, true, {}, SumStructures(options.structure_bytes), {}, nullptr};
  const BigRational r = rational(scale_value(ratio));
  if (r != 1) {
    const Factors factors = factors_of({}, scale_value(r));
    RatioSweeps sweeps;
    const RatioSweep* sweep = sweeps.make(*base, factors);
    if (sweep == nullptr)
      return Error{
          ErrorCode::bad_scale, "the ratio " + ratio.exact().to_string() + " is not between 2^-32 and 2^32", {}};
    cells.path.swept = sweep->base;
    cells.path.factors = factors;
    cells.unit_is_one = r < 1;
    if (r > 1) cells.unit = r;
  }
  cells.positions = std::make_unique<ScaledPositions>(cells.path.swept);
  return cells;
}

}  // namespace

Result<ScalingCells> empty_cells(const Region& p, const Region& q, const Scale& ratio, const FamilyOptions& options) {
  Result<std::shared_ptr<const OperandPair>> base = pair_of_regions(p, q, moving_options(options));
  if (!base) return base.error();
  return cells_along(*base, ratio, options);
}

Result<ScalingCells> scaling_cells(const Region& p, const Region& q, const Scale& low, const Scale& high,
                                   const Scale& ratio, const FamilyOptions& options) {
  const MovingOptions moving = moving_options(options);
  Result<ScalingCells> made = empty_cells(p, q, ratio, options);
  if (!made) return made;
  ScalingCells cells = *std::move(made);
  const BigRational from = rational(scale_value(low)) * cells.unit, to = rational(scale_value(high)) * cells.unit;
  const Result<std::array<Scale, 2>> first = cells.scales(from), last = cells.scales(to);
  if (!first) return first.error();
  if (!last) return last.error();
  CellVisitor visitor(cells);
  const Result<void> done = walk_events(cells.path, moving, from, to, options.progress, visitor);
  if (!done) return done.error();
  if (cells.events.empty()) {
    ScalingState state(cells.path.given, moving);
    const Result<FrameChanges> moved = state.begin([&] { return state.move_to((*first)[0], (*first)[1]); });
    if (!moved) return moved.error();
    visitor.add(state);
  }
  return cells;
}

void ScalingCells::add_cell(const PlanarSum& sum, std::span<const std::uint64_t> rings, double at) {
  const std::uint32_t first = structures.add(sum, rings);
  positions->add(std::span(structures.names()).subspan(first), at);
  named_at.push_back(at);
}

void ScalingCells::add_dropped_cell() {
  structures.add_dropped();
  named_at.push_back(0);
}

Result<std::array<Scale, 2>> ScalingCells::scales(const BigRational& t) const {
  const auto times = [&](const ScaleValue& factor) {
    return Scale::of(exact::to_rational(BigRational(t * rational(factor))));
  };
  const Result<Scale> x = times(path.factors.x), y = times(path.factors.y);
  if (!x) return x.error();
  if (!y) return y.error();
  return std::array<Scale, 2>{*x, *y};
}

// Rounding is monotone: doubles that differ are in the order of the scales.
ScalingCells::Location ScalingCells::locate(const Scale& s) const {
  const auto before = [&](const ScaleEvent& e, double at) { return e.approx < at; };
  auto at = std::lower_bound(events.begin(), events.end(), s.approx(), before);
  for (; at != events.end() && at->approx == s.approx(); ++at) {
    if (at->parameter == s.exact()) return {static_cast<std::uint32_t>(at - events.begin()), true};
    if (exact::exact_value(at->parameter) > rational(scale_value(s))) break;
  }
  return {static_cast<std::uint32_t>(at - events.begin()), false};
}

Scale ScalingCells::of_path(const Scale& s) const {
  return unit_is_one ? s : Scale::of(exact::to_rational(BigRational(rational(scale_value(s)) * unit))).value();
}

Result<PlanarSum> ScalingCells::at(const Scale& s, Semantics semantics) const {
  const Location location = locate(s);
  if (location.event || !structures.kept(location.index)) return from_scratch(s, semantics);
  return in_cell(location.index, s);
}

Result<PlanarSum> ScalingCells::from_scratch(const Scale& s, Semantics semantics) const {
  const BigRational t = rational(scale_value(of_path(s)));
  SumOptions options;
  options.semantics = semantics;
  const Result<std::array<Scale, 2>> at = scales(t);
  if (!at) return at.error();
  const LatticeScale scale = path.given->lattice_scale(scale_value((*at)[0]), scale_value((*at)[1]));
  return placed_sum(path.given->placed(scale), options);
}

std::vector<std::uint64_t> ScalingCells::ring_ids(const PlanarSum& sum, const Scale& s) const {
  const std::vector<const SumRing*> rings = rings_of(sum);
  std::vector<std::uint64_t> ids(rings.size(), 0);
  const Location location = locate(s);
  for (std::uint32_t cell = location.index; cell <= location.index + (location.event ? 1u : 0u); ++cell) {
    if (!structures.kept(cell)) continue;
    std::unordered_map<std::uint32_t, std::uint64_t> owner;  // of a name in the cell: its ring
    for (const SumStructures::Ring& ring : structures.rings(cell))
      for (const std::uint32_t name : structures.vertices(ring)) owner.try_emplace(name, ring.identity);
    for (std::size_t r = 0; r < rings.size(); ++r)
      for (std::size_t k = 0; k < rings[r]->vertices.size() && ids[r] == 0; ++k)
        if (const auto at = owner.find(structures.name_of(rings[r]->vertices[k])); at != owner.end())
          ids[r] = at->second;
  }
  return ids;
}

PlanarSum ScalingCells::in_cell(std::uint32_t cell, const Scale& s) const {
  const Scale along = of_path(s);
  const double t = along.approx();
  PlanarSum sum;
  const auto source = std::make_shared<PathSource>(path.swept, along);
  exact_source(sum) = source;
  const auto put = [&](std::uint32_t name, SumVertex& to) {
    to = structures.names()[name];
    const double error = positions->put(name, t, to);
    if (error < INFINITY) return error;
    const ExactSource::Position at = source->position(to);
    to.at = {exact::round_to_double(at.x), exact::round_to_double(at.y)};
    return exact::kRoundoff * std::max(std::abs(to.at.x), std::abs(to.at.y)) + exact::kSubnormal;
  };
  structures.write(cell, put, sum);
  canonicalize(sum.parts, *source, sum.at_error);
  canonicalize(sum.segments, *source, sum.at_error);
  canonicalize(sum.points, *source, sum.at_error);
  canonicalize(sum.tight_segments, *source, sum.at_error);
  canonicalize(sum.tight_points, *source, sum.at_error);
  sum.stats.tier_bits = path.swept->lattice->tier_bits;
  return sum;
}

}  // namespace dymsum::planar
