#include "solid_feature.h"

#include <string>

namespace dymsum::web {

val solid_feature(const SolidFeature& feature) {
  val v = val::object();
  v.set("kind", std::string(feature.kind == SolidFeature::Kind::vertex ? "vertex"
                            : feature.kind == SolidFeature::Kind::edge ? "edge"
                                                                       : "face"));
  v.set("a", feature.a);
  v.set("b", feature.b);
  return v;
}

val solid_contact(const SolidContact& contact) {
  val v = val::object();
  v.set("p", solid_feature(contact.p));
  v.set("q", solid_feature(contact.q));
  return v;
}

void add(std::vector<std::uint32_t>& numbers, const SolidFeature& feature) {
  numbers.insert(numbers.end(), {static_cast<std::uint32_t>(feature.kind), feature.a, feature.b});
}

}  // namespace dymsum::web
