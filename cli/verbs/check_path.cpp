#include "verbs/check_path.h"

#include <algorithm>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>

#include "exact_number.h"
#include "inputs.h"
#include "line_file.h"
#include "planar/contact.h"
#include "planar/query_file.h"

namespace dymsum::cli {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& what, std::optional<std::int64_t> line = {}) {
  refuse_line({ErrorCode::malformed, what, {}}, file, line);
}

std::vector<ExactPose> poses_of_lines(const std::string& file, const std::string& text) {
  std::vector<ExactPose> poses;
  for_each_line(text, [&](const std::string& one, std::int64_t line) {
    const std::optional<QueryLine> pose = query_in(one, Fractions::taken);
    if (!pose || !pose->theta) refuse(file, "expected a pose x,y,theta", line);
    const Angle& theta = *pose->theta;
    // Whole turns count: from one pose to the next the robot turns by the difference.
    poses.push_back({pose->at(), theta.degrees ? theta.value() / 180 * std::numbers::pi : theta.value()});
  });
  return poses;
}

Rational rational_in(const std::string& file, const std::string& text) {
  const Result<Rational> value = Rational::parse(text);
  if (!value) refuse(file, value.error().message);
  return *value;
}

Json parsed(const std::string& file, const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::size_t at = std::min(error.byte, text.size());
    refuse(file, error.byte > text.size() ? "the JSON of a path ends too early" : "this is no JSON of a path",
           1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  } catch (const Json::out_of_range&) {
    refuse(file, "a number is past the range of doubles");
  }
}

/// The entries of a waypoint; a Stop for those that are missing or of another kind.
class WaypointEntries {
 public:
  WaypointEntries(const std::string& file, const Json& json, std::size_t index)
      : file_(file), json_(json), index_(index) {}

  std::string text(const char* key) const {
    const Json* value = find(key);
    if (value == nullptr || !value->is_string()) wants(key, "a text");
    return *value;
  }
  double number(const char* key) const {
    const Json* value = find(key);
    if (value == nullptr || !value->is_number()) wants(key, "a number");
    return *value;
  }
  RationalPoint fractions(const char* key) const {
    const Json* value = find(key);
    if (value == nullptr || !value->is_array() || value->size() != 2 || !(*value)[0].is_string() ||
        !(*value)[1].is_string())
      wants(key, "a pair of fractions");
    return {rational_in(file_, (*value)[0]), rational_in(file_, (*value)[1])};
  }

 private:
  const Json* find(const char* key) const {
    const auto found = json_.find(key);
    return found == json_.end() ? nullptr : &*found;
  }
  [[noreturn]] void wants(const char* key, const char* what) const {
    refuse(file_, "waypoint " + std::to_string(index_) + " wants " + what + " as `" + key + "`");
  }

  const std::string& file_;
  const Json& json_;
  std::size_t index_;
};

Waypoint::Move move_in(const std::string& file, const std::string& name) {
  if (const auto move = parse<Waypoint::Move>(name)) return *move;
  refuse(file, "'" + name + "' is no move");
}

Waypoint waypoint_in(const std::string& file, const WaypointEntries& entries) {
  Waypoint w;
  w.move = move_in(file, entries.text("move"));
  w.at = entries.fractions("exact");
  Result<Orientation> theta = Orientation::parse(entries.text("tan_half"));
  if (!theta) refuse(file, theta.error().message);
  w.theta = *theta;
  w.approx = {entries.number("x"), entries.number("y"), w.theta.radians()};
  return w;
}

/// A number, or a text that is one or a fraction.
std::optional<Rational> coordinate_in(const Json& json) {
  if (json.is_number()) return Rational::of(json.get<double>()).value();
  return json.is_string() ? exact_number(json) : std::nullopt;
}

ExactPose pose_in(const std::string& file, const Json& json) {
  if (json.is_array() && json.size() == 3 && json[2].is_number()) {
    const std::optional<Rational> x = coordinate_in(json[0]), y = coordinate_in(json[1]);
    if (x && y) return {{*x, *y}, json[2]};
  }
  refuse(file, "expected a pose [x, y, theta] of finite numbers instead of " + json.dump());
}

GivenPath path_of_json(const std::string& file, const Json& json) {
  if (json.is_object()) {
    std::vector<Waypoint> path;
    if (!json.contains("waypoints") || !json["waypoints"].is_array()) refuse(file, "there is no list of `waypoints`");
    for (const Json& w : json["waypoints"]) path.push_back(waypoint_in(file, {file, w, path.size()}));
    return path;
  }
  std::vector<ExactPose> poses;
  for (const Json& pose : json) poses.push_back(pose_in(file, pose));
  return poses;
}

const char* kind_of(const PathCheck& check) { return !check.turns ? "translation" : check.moves ? "both" : "rotation"; }

}  // namespace

GivenPath read_path_file(const std::string& file) {
  const std::string text = file_text(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  GivenPath path;
  if (first == std::string::npos || (text[first] != '{' && text[first] != '[')) {
    path = poses_of_lines(file, text);
  } else {
    path = path_of_json(file, parsed(file, text));
  }
  if (size_of(path) == 0) refuse(file, "the file holds no pose");
  return path;
}

std::size_t size_of(const GivenPath& path) {
  return std::visit([](const auto& poses) { return poses.size(); }, path);
}

PathCheck checked(const Region& robot, const std::vector<Input>& inputs, const GivenPath& path, Touching touching,
                  const std::string& file) {
  const auto run = [&](const auto& poses) { return check_path(robot, inputs[1].region, std::span(poses), touching); };
  Result<PathCheck> check = std::visit(run, path);
  if (check) return std::move(check).value();
  Error error = in_operand(check.error(), inputs);
  if (error.evidence.file.empty()) error.evidence.file = shown_file(file);
  stop_with(error);
}

Json check_json(const PathCheck& check, const GivenPath& path) {
  Json blocked = nullptr;
  if (check.outcome != MotionCheck::Outcome::free)
    blocked = {{"piece", check.piece},
               {"kind", kind_of(check)},
               {"share", {check.low, check.high}},
               {"at", {check.at.x, check.at.y, check.at.theta}},
               {"contact", contact_json(check.contact)}};
  return {{"outcome", name(check.outcome)}, {"poses", size_of(path)}, {"pieces", check.pieces}, {"first", blocked}};
}

std::string check_text(const PathCheck& check) {
  std::ostringstream text;
  if (check.outcome == MotionCheck::Outcome::free) {
    text << "free: " << check.pieces << (check.pieces == 1 ? " piece" : " pieces");
    return text.str();
  }
  text.precision(10);
  text << name(check.outcome) << ": piece " << check.piece << ", a "
       << (check.moves && check.turns ? "translation that turns" : kind_of(check)) << ", at (" << check.at.x << ", "
       << check.at.y << "), theta = " << check.at.theta << ", " << 100 * check.low << " % of it";
  if (check.contact) text << ": " << contact_text(*check.contact);
  return text.str();
}

}  // namespace dymsum::cli
