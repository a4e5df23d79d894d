#include "solid/depth_report.h"

#include <limits>
#include <sstream>

#include "pictures/depth_trace.h"
#include "solid/solid_outputs.h"

namespace dymsum::cli {
namespace {

Json xyz(const Point3& v) { return {v.x, v.y, v.z}; }
Json xy(const Point& v) { return {v.x, v.y}; }

Json contact_pair(const SolidContact& c) { return {{"p", feature_json(c.p)}, {"q", feature_json(c.q)}}; }
Json contact_pair(const Contact& c) {
  const bool edge_of_p = c.kind == Contact::Kind::edge_of_p;
  return {{"p", {{edge_of_p ? "edge" : "vertex", c.p}}}, {"q", {{edge_of_p ? "vertex" : "edge", c.q}}}};
}

Json way_json(const SolidWay& way) {
  return {{"move", {way.move.x.to_double(), way.move.y.to_double(), way.move.z.to_double()}},
          {"move_exact", {way.move.x.to_string(), way.move.y.to_string(), way.move.z.to_string()}},
          {"direction", xyz(way.direction)}};
}
Json way_json(const PlanarWay& way) {
  return {{"move", {way.move.x.to_double(), way.move.y.to_double()}},
          {"move_exact", {way.move.x.to_string(), way.move.y.to_string()}},
          {"direction", xy(way.direction)}};
}

template <class Distance>
Json distance_json(const Distance& d) {
  const bool inside = d.meeting == Meeting::overlapping;
  Json json = {{"meeting", meeting_name(d.meeting)},
               {"inside", inside},
               {"depth", inside ? d.distance : 0},
               {"depth_squared_exact", (inside ? d.squared : Rational()).to_string()},
               {"distance", d.distance},
               {"distance_squared_exact", d.squared.to_string()}};
  Json ways = Json::array();
  for (const auto& way : d.ways) {
    Json one = way_json(way);
    Json contacts = Json::array();
    for (const auto& contact : way.contacts) contacts.push_back(contact_pair(contact));
    one["contacts"] = std::move(contacts);
    ways.push_back(std::move(one));
  }
  if (!ways.empty()) {
    json["direction"] = ways[0]["direction"];
    if (!ways[0]["contacts"].empty()) json.update(ways[0]["contacts"][0]);
  }
  json["ways"] = std::move(ways);
  return json;
}

std::string feature_text(const Json& feature) {
  for (const auto& [kind, index] : feature.items()) return kind + " " + index.dump();
  return "";
}

std::string numbers_text(const Json& v) {
  std::ostringstream out;
  for (std::size_t k = 0; k < v.size(); ++k) out << (k == 0 ? "" : ", ") << v[k].get<double>();
  return out.str();
}

template <class Distance>
std::string distance_text(const Distance& d, const std::string& p, const std::string& q) {
  std::ostringstream out;
  if (d.meeting == Meeting::touching) return "they touch, and their interiors do not meet\n";
  const bool inside = d.meeting == Meeting::overlapping;
  if (inside) out << "depth " << d.distance << ": moving " << q << " by that separates them\n";
  else out << "the interiors do not meet: " << q << " is " << d.distance << " away\n";
  const Json json = distance_json(d);
  for (const Json& way : json["ways"]) {
    out << "  along (" << numbers_text(way["direction"]) << ")";
    const char* before = ": ";
    for (const Json& contact : way["contacts"]) {
      out << before << feature_text(contact["p"]) << " of " << p << " and " << feature_text(contact["q"]) << " of "
          << q;
      before = ", ";
    }
    out << " touch then\n";
  }
  out << "  " << (inside ? "depth" : "distance") << " squared is exactly " << shown(d.squared) << "\n";
  return out.str();
}

}  // namespace

Json depth_json(const SolidDistance& d) {
  if (d.complete) return distance_json(d);
  Json json = {
      {"meeting", meeting_name(d.meeting)}, {"complete", false}, {"at_least", d.at_least}, {"at_most", d.distance}};
  if (!(d.distance < std::numeric_limits<double>::infinity())) json["at_most"] = nullptr;
  return json;
}
Json depth_json(const PlanarDistance& d) { return distance_json(d); }
Json depth_json(const ConvexDepth& depth) {
  return {{"inside", depth.inside},
          {"depth", depth.depth},
          {"depth_squared_exact", depth.depth_squared.to_string()},
          {"direction", xyz(depth.direction)},
          {"p", feature_json(depth.p)},
          {"q", feature_json(depth.q)}};
}

std::string depth_text(const SolidDistance& d, const std::string& p, const std::string& q) {
  return distance_text(d, p, q);
}
std::string depth_text(const PlanarDistance& d, const std::string& p, const std::string& q) {
  return distance_text(d, p, q);
}

}  // namespace dymsum::cli
