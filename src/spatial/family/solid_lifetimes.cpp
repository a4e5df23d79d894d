#include "spatial/family/solid_lifetimes.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace dymsum::spatial {
namespace {

void sort_each(ShellContacts& shells) {
  for (std::vector<SolidContact>& contacts : shells) {
    std::sort(contacts.begin(), contacts.end());
    contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
  }
}

}  // namespace

ShellContacts contacts_of(const SpatialSum& sum) {
  ShellContacts shells(sum.shells);
  for (const SpatialFace& face : sum.faces) shells[face.shell].push_back({face.p, face.q});
  sort_each(shells);
  return shells;
}

ShellContacts contacts_of(const SumStructure& structure) {
  ShellContacts shells(structure.shells);
  for (const SumStructure::Face& face : structure.faces)
    shells[face.shell].insert(shells[face.shell].end(), structure.contacts.begin() + face.first_contact,
                              structure.contacts.begin() + face.last_contact);
  sort_each(shells);
  return shells;
}

void SolidLifetimes::add(std::uint32_t cell, const ShellContacts& shells) {
  std::vector<SolidContact> now;
  for (const std::vector<SolidContact>& contacts : shells) now.insert(now.end(), contacts.begin(), contacts.end());
  std::sort(now.begin(), now.end());
  now.erase(std::unique(now.begin(), now.end()), now.end());
  for (const SolidContact& contact : now) {
    const auto [at, fresh] = face_.try_emplace(contact, faces_.size());
    if (!fresh && faces_[at->second].last_cell + 1 == cell) {
      faces_[at->second].last_cell = cell;
      continue;
    }
    at->second = faces_.size();
    faces_.push_back({SolidFamilyFeature::face, contact, 0, cell, cell});
  }

  std::map<SolidContact, std::vector<std::size_t>> shell_of;
  for (const std::vector<SolidContact>& contacts : shells) {
    // The first shell of the cell before that has a contact of this one, and that no other goes on from.
    std::size_t life = shells_.size();
    for (const SolidContact& contact : contacts)
      if (const auto before = shell_of_.find(contact); before != shell_of_.end())
        for (const std::size_t l : before->second)
          if (shells_[l].last_cell + 1 == cell) life = std::min(life, l);
    if (life == shells_.size()) shells_.push_back({SolidFamilyFeature::shell, {}, life + 1, cell, cell});
    shells_[life].last_cell = cell;
    for (const SolidContact& contact : contacts) shell_of[contact].push_back(life);
  }
  shell_of_ = std::move(shell_of);
}

std::vector<SolidLifetime> SolidLifetimes::all() && {
  std::vector<SolidLifetime> all = std::move(faces_);
  all.insert(all.end(), shells_.begin(), shells_.end());
  return all;
}

}  // namespace dymsum::spatial
