#include "cspace/family/slab_loops.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "cspace/boundary/patch_slabs.h"

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

}  // namespace dymsum::planar
