#include "solid/depth_report.h"

#include <limits>
#include <sstream>

#include "dymsum/names.h"
#include "pictures/depth_trace.h"
#include "solid/solid_outputs.h"

namespace dymsum::cli {
namespace {

Json xyz(const Point3& v) { return {v.x, v.y, v.z}; }
Json xy(const Point& v) { return {v.x, v.y}; }

Json named_feature(const SolidFeature& f) { return feature_json(f); }
Json named_feature(const PlanarFeature& f) { return {{std::string(name(f.kind)), f.index}}; }
void add_position(const RationalPoint3& at, Json& json) {
  json["at"] = {at.x.to_double(), at.y.to_double(), at.z.to_double()};
  json["at_exact"] = {at.x.to_string(), at.y.to_string(), at.z.to_string()};
}
void add_position(const RationalPoint& at, Json& json) {
  json["at"] = {at.x.to_double(), at.y.to_double()};
  json["at_exact"] = {at.x.to_string(), at.y.to_string()};
}

template <class Touch>
Json contact_json(const Touch& c) {
  Json json = {{"p", named_feature(c.p)}, {"q", named_feature(c.q)}, {"dimension", c.dimension}};
  add_position(c.at, json);
  json["patch"] = c.patch;
  return json;
}

Json move_json(const SolidWay& move) {
  return {{"move", {move.move.x.to_double(), move.move.y.to_double(), move.move.z.to_double()}},
          {"move_exact", {move.move.x.to_string(), move.move.y.to_string(), move.move.z.to_string()}},
          {"direction", xyz(move.direction)}};
}
Json move_json(const PlanarWay& move) {
  return {{"move", {move.move.x.to_double(), move.move.y.to_double()}},
          {"move_exact", {move.move.x.to_string(), move.move.y.to_string()}},
          {"direction", xy(move.direction)}};
}

template <class Move>
Json json_of_moves(const std::vector<Move>& all) {
  Json moves = Json::array();
  for (const Move& move : all) {
    Json one = move_json(move);
    Json contacts = Json::array();
    for (const auto& contact : move.contacts) contacts.push_back(contact_json(contact));
    one["contacts"] = std::move(contacts);
    moves.push_back(std::move(one));
  }
  return moves;
}

template <class Distance>
Json distance_json(const Distance& d) {
  const bool inside = d.meeting == Meeting::overlapping;
  Json json = {
      {"meeting", name(d.meeting)},       {"inside", inside},
      {"depth", inside ? d.distance : 0}, {"depth_squared_exact", (inside ? d.squared : Rational()).to_string()},
      {"distance", d.distance},           {"distance_squared_exact", d.squared.to_string()}};
  Json moves = json_of_moves(d.ways);
  if (!moves.empty()) {
    json["direction"] = moves[0]["direction"];
    if (const Json& contacts = moves[0]["contacts"]; !contacts.empty())
      json["p"] = contacts[0]["p"], json["q"] = contacts[0]["q"];
  }
  json["ways"] = std::move(moves);
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

/// The pairs of the greatest dimension; the others are on their rims, or small beside them.
std::string contacts_text(const Json& contacts, const std::string& p, const std::string& q) {
  std::ostringstream out;
  const char* before = ": ";
  std::size_t named = 0;
  for (const Json& contact : contacts) {
    if (contact["dimension"] != contacts[0]["dimension"]) break;
    out << before << feature_text(contact["p"]) << " of " << p << " and " << feature_text(contact["q"]) << " of " << q;
    before = ", ", ++named;
  }
  out << " touch then";
  if (named < contacts.size()) out << ", and " << contacts.size() - named << " of smaller dimension";
  return out.str();
}

std::string text_of_moves(const Json& moves, const std::string& p, const std::string& q) {
  std::ostringstream out;
  for (const Json& move : moves) {
    out << "  along (" << numbers_text(move["direction"]) << ")";
    out << contacts_text(move["contacts"], p, q) << "\n";
  }
  return out.str();
}

template <class Distance>
std::string distance_text(const Distance& d, const std::string& p, const std::string& q) {
  std::ostringstream out;
  if (d.meeting == Meeting::touching) return "they touch, and their interiors do not meet\n";
  const bool inside = d.meeting == Meeting::overlapping;
  if (inside) out << "depth " << d.distance << ": moving " << q << " by that separates them\n";
  else out << "the interiors do not meet: " << q << " is " << d.distance << " away\n";
  out << text_of_moves(json_of_moves(d.ways), p, q);
  out << "  " << (inside ? "depth" : "distance") << " squared is exactly " << shown(d.squared) << "\n";
  return out.str();
}

}  // namespace

Json depth_json(const SolidDistance& d) {
  if (d.complete) return distance_json(d);
  Json json = {{"meeting", name(d.meeting)}, {"complete", false}, {"at_least", d.at_least}, {"at_most", d.distance}};
  if (!(d.distance < std::numeric_limits<double>::infinity())) json["at_most"] = nullptr;
  return json;
}
Json moves_json(const std::vector<PlanarWay>& moves) { return json_of_moves(moves); }
std::string moves_text(const std::vector<PlanarWay>& moves, const std::string& p, const std::string& q) {
  return text_of_moves(json_of_moves(moves), p, q);
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
