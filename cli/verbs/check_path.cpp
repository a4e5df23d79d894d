#include "verbs/check_path.h"

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "inputs.h"
#include "line_file.h"
#include "planar/query_file.h"

namespace dymsum::cli {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& what, std::optional<std::int64_t> line = {}) {
  refuse_line({ErrorCode::malformed, what, {}}, file, line);
}

std::vector<Configuration> poses_of_lines(const std::string& file, const std::string& text) {
  std::vector<Configuration> poses;
  for_each_line(text, [&](const std::string& one, std::int64_t line) {
    const std::optional<QueryLine> pose = query_in(one);
    if (!pose || !pose->theta) refuse(file, "expected a pose x,y,theta", line);
    const Angle& theta = *pose->theta;
    // Whole turns count: from one pose to the next the robot turns by the difference.
    poses.push_back({pose->x, pose->y, theta.degrees ? theta.value / 180 * std::numbers::pi : theta.value});
  });
  return poses;
}

Rational rational_in(const std::string& file, const std::string& text) {
  const Result<Rational> value = Rational::parse(text);
  if (!value) refuse(file, value.error().message);
  return *value;
}

Waypoint::Move move_in(const std::string& file, const std::string& name) {
  if (name == "start") return Waypoint::Move::start;
  if (name == "translation") return Waypoint::Move::translation;
  if (name == "counter_clockwise") return Waypoint::Move::counter_clockwise;
  if (name == "clockwise") return Waypoint::Move::clockwise;
  refuse(file, "'" + name + "' is no move");
}

Waypoint waypoint_in(const std::string& file, const Json& json) {
  Waypoint w;
  w.move = move_in(file, json.at("move").get<std::string>());
  w.at = {rational_in(file, json.at("exact").at(0).get<std::string>()),
          rational_in(file, json.at("exact").at(1).get<std::string>())};
  Result<Orientation> theta = Orientation::parse(json.at("tan_half").get<std::string>());
  if (!theta) refuse(file, theta.error().message);
  w.theta = *theta;
  w.approx = {json.at("x").get<double>(), json.at("y").get<double>(), w.theta.radians()};
  return w;
}

GivenPath path_of_json(const std::string& file, const Json& json) {
  if (json.is_object()) {
    std::vector<Waypoint> path;
    for (const Json& w : json.at("waypoints")) path.push_back(waypoint_in(file, w));
    return path;
  }
  std::vector<Configuration> poses;
  for (const Json& pose : json) {
    const auto [x, y, theta] = pose.get<std::array<double, 3>>();
    if (pose.size() != 3 || !std::isfinite(x) || !std::isfinite(y) || !std::isfinite(theta))
      refuse(file, "expected a pose [x, y, theta] of finite numbers instead of " + pose.dump());
    poses.push_back({x, y, theta});
  }
  return poses;
}

const char* name_of(MotionCheck::Outcome outcome) {
  switch (outcome) {
    case MotionCheck::Outcome::free:
      return "free";
    case MotionCheck::Outcome::blocked:
      return "blocked";
    case MotionCheck::Outcome::undecided:
      return "undecided";
  }
  return "";
}

const char* kind_of(const PathCheck& check) { return !check.turns ? "translation" : check.moves ? "both" : "rotation"; }

}  // namespace

GivenPath read_path_file(const std::string& file) {
  const std::string text = file_text(file, "the path");
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  GivenPath path;
  if (first == std::string::npos || (text[first] != '{' && text[first] != '[')) {
    path = poses_of_lines(file, text);
  } else {
    try {
      path = path_of_json(file, Json::parse(text));
    } catch (const Json::exception& error) {
      refuse(file, std::string("no path: ") + error.what());
    }
  }
  if (size_of(path) == 0) refuse(file, "the file holds no pose");
  return path;
}

std::size_t size_of(const GivenPath& path) {
  return std::visit([](const auto& poses) { return poses.size(); }, path);
}

PathCheck checked(const Region& robot, const Region& obstacle, const GivenPath& path, Touching touching) {
  return std::visit([&](const auto& poses) { return require(check_path(robot, obstacle, poses, touching)); }, path);
}

Json contact_json(const std::optional<Contact>& contact) {
  if (!contact) return nullptr;
  const bool fixed = contact->kind == Contact::Kind::edge_of_p;
  return {{"kind", fixed ? "vertex_on_edge" : "edge_on_vertex"}, {"obstacle", contact->p}, {"robot", contact->q}};
}

Json check_json(const PathCheck& check, const GivenPath& path) {
  Json blocked = nullptr;
  if (check.outcome != MotionCheck::Outcome::free)
    blocked = {{"piece", check.piece},
               {"kind", kind_of(check)},
               {"share", {check.low, check.high}},
               {"at", {check.at.x, check.at.y, check.at.theta}},
               {"contact", contact_json(check.contact)}};
  return {{"outcome", name_of(check.outcome)}, {"poses", size_of(path)}, {"pieces", check.pieces}, {"first", blocked}};
}

std::string check_text(const PathCheck& check) {
  std::ostringstream text;
  if (check.outcome == MotionCheck::Outcome::free) {
    text << "free: " << check.pieces << (check.pieces == 1 ? " piece" : " pieces");
    return text.str();
  }
  text.precision(10);
  text << name_of(check.outcome) << ": piece " << check.piece << ", a "
       << (check.moves && check.turns ? "translation that turns" : kind_of(check)) << ", at (" << check.at.x << ", "
       << check.at.y << "), theta = " << check.at.theta << ", " << 100 * check.low << " % of it";
  if (check.contact) {
    const bool fixed = check.contact->kind == Contact::Kind::edge_of_p;
    text << ": " << (fixed ? "edge " : "vertex ") << check.contact->p << " of the obstacle and "
         << (fixed ? "vertex " : "edge ") << check.contact->q << " of the robot";
  }
  return text.str();
}

}  // namespace dymsum::cli
