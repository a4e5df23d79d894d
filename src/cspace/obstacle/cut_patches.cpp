#include "cspace/obstacle/cut_patches.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace dymsum::planar {
namespace {

using Key = std::tuple<int, std::uint32_t, std::uint32_t>;
Key key_of(const Contact& c) { return {static_cast<int>(c.kind), c.p, c.q}; }
using PatchKey = std::array<Key, 3>;

class CutPatches {
 public:
  CutPatches(const SweptBoundary& swept, const ContactNames& names)
      : swept_(swept), names_(names), angles_(static_cast<std::uint32_t>(swept.angles.size())) {}

  // Slab s lies after angle s - 1; the one before the first angle is the last one.
  std::vector<CutPatch> run() {
    if (angles_ == 0) {
      add_slab(0);
      for (CutPatch& p : patches_) p.begin = p.end = kNobody;
      return std::move(patches_);
    }
    std::map<PatchKey, std::uint32_t> first;
    for (std::uint32_t s = 1; s <= angles_; ++s) {
      add_slab(s);
      if (s == 1) first = open_;
    }
    join_ends(first);
    return std::move(patches_);
  }

 private:
  bool alive(const BoundaryGraph::Node& n, std::uint32_t slab) const {
    return (n.begin == kNobody || n.begin < slab) && (n.end == kNobody || n.end >= slab);
  }
  std::uint32_t cell(std::uint32_t n, std::uint32_t slab) const {
    const BoundaryGraph::Node& node = swept_.graph.nodes()[n];
    std::uint32_t at = node.born_cell;
    for (const auto& [angle, to] : node.cells)
      if (angle < slab) at = to;
    return at;
  }

  void add_slab(std::uint32_t slab) {
    const auto& nodes = swept_.graph.nodes();
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> by_ids;  // (before, own) -> node
    for (std::uint32_t n = 0; n < nodes.size(); ++n)
      if (alive(nodes[n], slab)) by_ids[{nodes[n].left, nodes[n].id}] = n;
    std::map<PatchKey, std::uint32_t> now;
    for (const auto& [ids, n] : by_ids) {
      const Contact own = names_.contact(nodes[n].id), left = names_.contact(nodes[n].left);
      if (left == own) continue;  // not the first of its run
      std::uint32_t last = n;
      while (names_.contact(nodes[last].right) == own) last = by_ids.at({nodes[last].id, nodes[last].right});
      const Contact right = names_.contact(nodes[last].right);
      const PatchKey key{key_of(own), key_of(left), key_of(right)};
      const auto before = open_.find(key);
      // Not where a passage was shut in between.
      const bool goes_on =
          before != open_.end() && swept_.graph.shell_of(patches_[before->second].node) == swept_.graph.shell_of(n);
      const std::uint32_t p = goes_on ? before->second : static_cast<std::uint32_t>(patches_.size());
      if (!goes_on) {
        CutPatch fresh;
        fresh.patch.contact = own;
        fresh.patch.left = left;
        fresh.patch.right = right;
        fresh.patch.left_corner = names_.corner(nodes[n].left, nodes[n].id);
        fresh.patch.right_corner = names_.corner(nodes[last].id, nodes[last].right);
        fresh.begin = slab - 1;
        patches_.push_back(std::move(fresh));
      }
      CutPatch& patch = patches_[p];
      patch.end = slab == angles_ ? 0 : slab;
      patch.node = n;
      if (const std::uint32_t c = cell(n, slab); patch.cells.empty() || patch.cells.back().second != c)
        patch.cells.emplace_back(slab - 1, c);
      now[key] = p;
    }
    open_ = std::move(now);
  }

  // What is there before and after the first angle is one patch.
  void join_ends(const std::map<PatchKey, std::uint32_t>& first) {
    std::vector<bool> gone(patches_.size(), false);
    for (const auto& [key, from] : open_) {
      const auto to = first.find(key);
      if (to == first.end() ||
          swept_.graph.shell_of(patches_[to->second].node) != swept_.graph.shell_of(patches_[from].node))
        continue;
      CutPatch &early = patches_[to->second], &late = patches_[from];
      if (to->second == from) {
        early.begin = early.end = kNobody;
        continue;
      }
      early.begin = late.begin;
      early.cells.insert(early.cells.begin(), late.cells.begin(), late.cells.end());
      gone[from] = true;
    }
    std::size_t kept = 0;
    for (std::size_t p = 0; p < patches_.size(); ++p)
      if (!gone[p]) {
        if (kept != p) patches_[kept] = std::move(patches_[p]);
        ++kept;
      }
    patches_.resize(kept);
  }

  const SweptBoundary& swept_;
  const ContactNames& names_;
  std::uint32_t angles_;
  std::vector<CutPatch> patches_;
  std::map<PatchKey, std::uint32_t> open_;  // in the slab before
};

}  // namespace

std::vector<CutPatch> cut_patches(const SweptBoundary& swept, const ContactNames& names) {
  return CutPatches(swept, names).run();
}

}  // namespace dymsum::planar
