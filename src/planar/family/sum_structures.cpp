#include "planar/family/sum_structures.h"

#include "planar/frame/frame_rings.h"

namespace dymsum::planar {

std::uint32_t SumStructures::name(const SumVertex& vertex) {
  const std::uint64_t k = key(vertex);
  const auto [first, last] = index_.equal_range(k);
  for (auto at = first; at != last; ++at) {
    const SumVertex& known = names_[at->second];
    if (known.in == vertex.in && known.out == vertex.out && known.corner_p == vertex.corner_p &&
        known.corner_q == vertex.corner_q)
      return at->second;
  }
  names_.push_back(vertex);
  const auto index = static_cast<std::uint32_t>(names_.size() - 1);
  index_.emplace(k, index);
  return index;
}

void SumStructures::add_ring(const SumRing& ring, std::uint32_t part, bool hole, std::uint64_t identity) {
  const auto first = static_cast<std::uint32_t>(items_.size());
  for (const SumVertex& v : ring.vertices) items_.push_back(name(v));
  rings_.push_back({first, static_cast<std::uint32_t>(items_.size()), part, hole, identity});
}

SumStructures::Pieces SumStructures::add_pieces(const PlanarSum& sum) {
  Pieces pieces;
  pieces.first = static_cast<std::uint32_t>(items_.size());
  const auto segments = [&](const std::vector<SumSegment>& from) {
    for (const SumSegment& s : from) {
      items_.push_back(name(s.from));
      items_.push_back(name(s.to));
    }
    return static_cast<std::uint32_t>(from.size());
  };
  const auto points = [&](const std::vector<SumVertex>& from) {
    for (const SumVertex& v : from) items_.push_back(name(v));
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

}  // namespace dymsum::planar
