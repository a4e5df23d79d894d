#include "planar/contact.h"

namespace dymsum::cli {

Json contact_json(const std::optional<Contact>& contact) {
  if (!contact) return nullptr;
  const bool fixed = contact->kind == Contact::Kind::edge_of_p;
  return {{"kind", fixed ? "vertex_on_edge" : "edge_on_vertex"}, {"obstacle", contact->p}, {"robot", contact->q}};
}

std::string contact_text(const Contact& contact) {
  const bool fixed = contact.kind == Contact::Kind::edge_of_p;
  return (fixed ? "edge " : "vertex ") + std::to_string(contact.p) + " of the obstacle and " +
         (fixed ? "vertex " : "edge ") + std::to_string(contact.q) + " of the robot";
}

}  // namespace dymsum::cli
