#include "cspace/family/slab_loops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "cspace/boundary/obstacle_state.h"
#include "exact/big.h"
#include "exact/rounding_bound.h"
#include "planar/operand/lattice.h"

namespace dymsum::planar {
namespace {

using ContactKey = std::tuple<Contact::Kind, std::uint32_t, std::uint32_t>;

ContactKey key_of_contact(const Contact& c) { return {c.kind, c.p, c.q}; }

/// Two contacts in a row along the boundary, as an index.
class ContactPairs {
 public:
  std::uint32_t index(const Contact& before, const Contact& after) {
    return indices_.try_emplace({key_of_contact(before), key_of_contact(after)}, count()).first->second;
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(indices_.size()); }

 private:
  std::map<std::pair<ContactKey, ContactKey>, std::uint32_t> indices_;
};

}  // namespace

SlabLoops::SlabLoops(const CspaceObstacle& obstacle)
    : patches_(obstacle.patches()),
      slabs_(static_cast<std::uint32_t>(std::max<std::size_t>(1, obstacle.angles().size()))) {
  index_patches();
  link_patches();
}

bool SlabLoops::is_there(std::uint32_t patch, std::uint32_t slab) const {
  return is_in_slab(patches_[patch], slab, slabs_);
}

std::uint32_t SlabLoops::since_begin(std::uint32_t patch, std::uint32_t slab) const {
  const Patch& p = patches_[patch];
  return p.begin == Patch::kNone ? slab : slabs_between(p.begin, slab, slabs_);
}

void SlabLoops::index_patches() {
  std::vector<std::vector<std::uint32_t>> begins(slabs_);
  for (std::uint32_t k = 0; k < patches_.size(); ++k)
    if (patches_[k].begin != Patch::kNone) begins[patches_[k].begin].push_back(k);
  for (const auto& here : begins) {
    first_beginning_.push_back(static_cast<std::uint32_t>(beginning_.size()));
    beginning_.insert(beginning_.end(), here.begin(), here.end());
  }
  first_beginning_.push_back(static_cast<std::uint32_t>(beginning_.size()));
  std::vector<std::uint32_t> now;
  for (std::uint32_t k = 0; k < patches_.size(); ++k)
    if (is_there(k, 0)) now.push_back(k);
  for (std::uint32_t slab = 0; slab < slabs_; slab += kEvery) {
    if (slab > 0) {
      for (std::uint32_t s = slab - kEvery + 1; s <= slab; ++s)
        now.insert(now.end(), begins[s].begin(), begins[s].end());
      std::erase_if(now, [&](std::uint32_t k) { return !is_there(k, slab); });
    }
    first_kept_.push_back(static_cast<std::uint32_t>(kept_.size()));
    kept_.insert(kept_.end(), now.begin(), now.end());
  }
  first_kept_.push_back(static_cast<std::uint32_t>(kept_.size()));
}

std::vector<std::uint32_t> SlabLoops::patches_in(std::uint32_t slab) const {
  std::vector<std::uint32_t> found;
  const std::uint32_t kept = slab / kEvery;
  for (std::uint32_t i = first_kept_[kept]; i < first_kept_[kept + 1]; ++i)
    if (is_there(kept_[i], slab)) found.push_back(kept_[i]);
  for (std::uint32_t i = first_beginning_[kept * kEvery + 1]; i < first_beginning_[slab + 1]; ++i)
    if (is_there(beginning_[i], slab)) found.push_back(beginning_[i]);
  return found;
}

// A sweep through the slabs: which patch has two contacts in a row as its first two, and which as its last two.
void SlabLoops::link_patches() {
  ContactPairs pairs;
  std::vector<std::uint32_t> start, end;
  for (const Patch& p : patches_) {
    start.push_back(pairs.index(p.left, p.contact));
    end.push_back(pairs.index(p.contact, p.right));
  }
  std::vector<std::uint32_t> starts_with(pairs.count(), Patch::kNone), ends_with = starts_with;
  std::vector<std::vector<Follower>> followers(patches_.size());
  const auto link = [&](std::uint32_t from, std::uint32_t to, std::uint32_t slab) {
    if (from == Patch::kNone || to == Patch::kNone || !is_there(from, slab) || !is_there(to, slab)) return;
    std::vector<Follower>& list = followers[from];
    const Follower follower{since_begin(from, slab), to};
    if (list.empty() || list.back().patch != to || list.back().since > follower.since) list.push_back(follower);
  };
  const auto begin = [&](std::span<const std::uint32_t> here, std::uint32_t slab) {
    for (const std::uint32_t k : here) {
      starts_with[start[k]] = k;
      ends_with[end[k]] = k;
    }
    for (const std::uint32_t k : here) {
      link(k, starts_with[end[k]], slab);
      link(ends_with[start[k]], k, slab);
    }
  };
  begin(patches_in(0), 0);
  for (std::uint32_t slab = 1; slab < slabs_; ++slab)
    begin(std::span(beginning_).subspan(first_beginning_[slab], first_beginning_[slab + 1] - first_beginning_[slab]),
          slab);
  for (std::vector<Follower>& list : followers) {
    std::sort(list.begin(), list.end(), [](const Follower& a, const Follower& b) { return a.since < b.since; });
    first_follower_.push_back(static_cast<std::uint32_t>(followers_.size()));
    followers_.insert(followers_.end(), list.begin(), list.end());
  }
  first_follower_.push_back(static_cast<std::uint32_t>(followers_.size()));
}

std::uint32_t SlabLoops::follower(std::uint32_t patch, std::uint32_t slab) const {
  const std::uint32_t since = since_begin(patch, slab);
  std::uint32_t at = first_follower_[patch + 1];
  while (at > first_follower_[patch] && followers_[at - 1].since > since) --at;
  if (at == first_follower_[patch]) throw std::logic_error("SlabLoops: nothing follows a patch");
  return followers_[at - 1].patch;
}

SlabLoops::Loops SlabLoops::in(std::uint32_t slab) const {
  const std::vector<std::uint32_t> here = patches_in(slab);
  std::vector<bool> done(patches_.size(), false);
  Loops loops;
  loops.patches.reserve(here.size());
  for (const std::uint32_t first : here) {
    if (done[first]) continue;
    for (std::uint32_t k = first; !done[k]; k = follower(k, slab)) {
      done[k] = true;
      loops.patches.push_back(k);
    }
    loops.ends.push_back(static_cast<std::uint32_t>(loops.patches.size()));
  }
  return loops;
}

std::size_t SlabLoops::bytes() const {
  return (first_beginning_.size() + beginning_.size() + first_kept_.size() + kept_.size() + first_follower_.size()) *
             sizeof(std::uint32_t) +
         followers_.size() * sizeof(Follower);
}

namespace {

// In roundings of the reach: the cosine and the sine err by at most 8 (rotor_of); the products, their sum
// and the last one. An edge vector has one more before it is rotated.
constexpr int kOfRotor = 8, kOfPoint = kOfRotor + 4, kOfVector = kOfRotor + 4;
constexpr double kPointError = exact::rounding_bound(kOfPoint, 16), kVectorError = exact::rounding_bound(kOfVector, 16);
// A cross product of two edge vectors errs by what both err by, and three of its own; with a gap of two points, which
// errs absolutely, by one more.
constexpr double kCrossError = exact::rounding_bound(2 * kOfVector + 3 + 1, 32);
// Quotients and sums: a fraction, its product and the last sum.
constexpr double kFractionError = exact::rounding_bound(4, 8);

Point rotated(Point v, Rotor rotor) {
  return {rotor.cosine * v.x - rotor.sine * v.y, rotor.sine * v.x + rotor.cosine * v.y};
}
Point sum(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
Point gap(Point a, Point b) { return {b.x - a.x, b.y - a.y}; }
double size_of(Point v) { return std::abs(v.x) + std::abs(v.y); }
double cross_of(Point a, Point b) { return a.x * b.y - a.y * b.x; }

double reach_of(const std::vector<Point>& points) {
  double reach = 0;
  for (const Point& v : points) reach = std::max(reach, size_of(v));
  return reach;
}

/// What a contact's edge ends at, by its index, and source vertices of all indices.
struct EdgeEndIndex {
  explicit EdgeEndIndex(const Operand& o) : end(o.edge_of_index.size(), SumVertex::kNone) {
    for (std::uint32_t e = 0; e < o.size(); ++e)
      if (o.next[e] != e) end[o.edge_index[e]] = o.vertex_index[o.next[e]];
  }
  std::vector<std::uint32_t> end;
};

}  // namespace

// The tangent t of half the angle, or of a right angle less that, is at most 1, and errs by one rounding, or two where
// it is inverted: the cosine and the sine by less than 1.3 times that, so 2.6. Their own: t^2 and the numerator 2, the
// denominator 1.5, the quotient 1.
Rotor rotor_of(const Orientation& theta) {
  if (theta.is_half_turn()) return {-1, 0};
  const double tangent = theta.tan_half().to_double();
  const bool inverted = std::abs(tangent) > 1;
  const double t = inverted ? 1 / tangent : tangent, whole = 1 + t * t, cosine = (1 - t * t) / whole;
  return {inverted ? -cosine : cosine, 2 * t / whole};
}

RotatedPositions::RotatedPositions(const OperandPair& base, const CspaceObstacle& obstacle)
    : reach_(reach_of(base.lattice->points[0]->input) + reach_of(base.lattice->points[1]->input)) {
  const std::array<EdgeEndIndex, 2> ends{EdgeEndIndex(base.operands[0]), EdgeEndIndex(base.operands[1])};
  for (const Patch& patch : obstacle.patches()) {
    const Contact& c = patch.contact;
    const bool moves = c.kind == Contact::Kind::edge_of_q;
    const std::uint32_t op = moves ? 1 : 0, edge = moves ? c.q : c.p, vertex = moves ? c.p : c.q;
    const auto& own = base.lattice->points[op]->input;
    const auto& other = base.lattice->points[1 - op]->input;
    const auto [from, to] = base.operands[op].edge_of_index[edge];
    lines_.push_back(
        {own[from], own[to], other[base.operands[1 - op].vertex_of_index[vertex]], moves, patch.right_corner});
    const std::uint32_t end = ends[op].end[edge];
    corners_.push_back(!patch.right_corner ? Corner{} : moves ? Corner{vertex, end} : Corner{end, vertex});
  }
}

RotatedPositions::Placed RotatedPositions::corner(const Line& line, Rotor rotor) const {
  const Point at = line.moves ? sum(rotated(line.to, rotor), line.vertex) : sum(line.to, rotated(line.vertex, rotor));
  return {at, kPointError * reach_ + exact::kSubnormal};
}

// The fraction along `on` is n / d, n = (b - a) x e and d = d_on x e.
RotatedPositions::Placed RotatedPositions::crossing(const Line& on, const Line& other, Rotor rotor) const {
  const auto start = [&](const Line& l) {
    return l.moves ? sum(rotated(l.from, rotor), l.vertex) : sum(l.from, rotated(l.vertex, rotor));
  };
  const auto along = [&](const Line& l) {
    const Point v = gap(l.from, l.to);
    return l.moves ? rotated(v, rotor) : v;
  };
  const Point a = start(on), d = along(on), e = along(other), g = gap(a, start(other));
  const double n = cross_of(g, e), m = cross_of(d, e), fraction = n / m, point = kPointError * reach_;
  const double of_n = 2 * point * size_of(e) + kCrossError * size_of(g) * size_of(e) + exact::kSubnormal,
               of_m = kCrossError * size_of(d) * size_of(e) + exact::kSubnormal;
  if (!(4 * of_m < std::abs(m))) return {a, INFINITY};
  // Divided by less than three quarters of |m|, and rounded.
  const double of_fraction =
      1.5 * (of_n + std::abs(fraction) * of_m) / std::abs(m) + kFractionError * std::abs(fraction);
  const double error = point + size_of(d) * of_fraction + std::abs(fraction) * kVectorError * size_of(d) +
                       kFractionError * (reach_ + std::abs(fraction) * size_of(d)) + exact::kSubnormal;
  return {{a.x + fraction * d.x, a.y + fraction * d.y}, error <= kPoorPosition * reach_ ? error : INFINITY};
}

}  // namespace dymsum::planar
