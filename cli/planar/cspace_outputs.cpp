#include "planar/cspace_outputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "dymsum/mesh_io.h"
#include "inputs.h"
#include "pictures/frame_pictures.h"
#include "planar/contact.h"
#include "record_json.h"

namespace dymsum::cli {
namespace {

const double kPi = std::acos(-1.0);

/// An angle by its index; null for a patch that is there at every angle.
Json angle_json(const CspaceObstacle& obstacle, std::uint32_t index) {
  if (index == Patch::kNone) return nullptr;
  const EventAngle& a = obstacle.angles()[index];
  Json json = {{"index", index}, {"theta", a.theta}, {"low", a.low}, {"high", a.high}};
  if (a.exact) json["tan_half"] = orientation_json(*a.exact)["tan_half"];
  return json;
}

Json patch_json(const CspaceObstacle& obstacle, const Patch& p) {
  return {{"contact", contact_json(p.contact)},    {"left", contact_json(p.left)},
          {"right", contact_json(p.right)},        {"left_corner", p.left_corner},
          {"right_corner", p.right_corner},        {"theta0", angle_json(obstacle, p.begin)},
          {"theta1", angle_json(obstacle, p.end)}, {"shell", p.shell}};
}

/// 0 for what can be left to infinity, others for cavities, so that neighbours differ.
constexpr std::size_t kShades = 5;
std::size_t shade_of(const CspaceObstacle& obstacle, std::uint32_t shell) {
  return obstacle.shells()[shell].outer ? 0 : 1 + shell % (kShades - 1);
}

/// Yellow for fixed contacts and blue for rotating ones, as in the figures of docs/results; grey for the caps.
std::vector<FaceColour> colours_of(const CspaceObstacle& obstacle, const ObstacleMesh& mesh, std::size_t faces) {
  constexpr std::array<std::array<double, 3>, 2> kHues{
      {{250 / 255.0, 205 / 255.0, 120 / 255.0}, {40 / 255.0, 115 / 255.0, 185 / 255.0}}};
  constexpr std::array<double, kShades> kLight{0, 0.45, -0.35, 0.65, -0.55};  // towards white, or black
  std::vector<FaceColour> colours;
  for (const auto& hue : kHues) {
    for (const double light : kLight) {
      FaceColour colour;
      for (std::size_t i = 0; i < 3; ++i)
        colour.rgb[i] = light < 0 ? hue[i] * (1 + light) : hue[i] + (1 - hue[i]) * light;
      colours.push_back(std::move(colour));
    }
  }
  for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
    const Patch& patch = obstacle.patches()[mesh.triangles[k].patch];
    colours[(patch.rotating() ? kShades : 0) + shade_of(obstacle, patch.shell)].faces.push_back(k);
  }
  colours.push_back({{0.78, 0.78, 0.78}, {}});
  for (auto k = static_cast<std::uint32_t>(mesh.triangles.size()); k < faces; ++k) colours.back().faces.push_back(k);
  return colours;
}

/// No stream: a page's module has this file as well, and streams would be a part of it.
std::string six_digits(double v) {
  std::array<char, 32> text;
  return {text.data(), static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.6g", v))};
}

/// A Stop where single precision, in which a GLB file holds coordinates, does not distinguish the sides of the mesh.
void require_singles(const MeshData& data) {
  for (double Point3::*const axis : {&Point3::x, &Point3::y, &Point3::z}) {
    const auto less = [&](const Point3& a, const Point3& b) { return a.*axis < b.*axis; };
    const auto [low, high] = std::minmax_element(data.vertices.begin(), data.vertices.end(), less);
    const auto from = static_cast<float>(*low.*axis), to = static_cast<float>(*high.*axis);
    if (!std::isfinite(from) || !std::isfinite(to))
      throw Stop(kBadInput, "a .glb file cannot hold this: a coordinate is past the range of single precision");
    if (from == to) throw Stop(kBadInput, "a .glb file cannot hold this: in single precision the obstacle is flat");
  }
}

}  // namespace

Json shells_json(const CspaceObstacle& obstacle) {
  Json list = Json::array();
  for (const Shell& s : obstacle.shells())
    list.push_back({{"kind", s.outer ? "outer" : "cavity"},
                    {"patches", s.patches},
                    {"euler", s.euler},
                    {"component", s.free_component}});
  return list;
}

Json obstacle_json(const CspaceObstacle& obstacle) {
  Json patches = Json::array(), angles = Json::array(), cells = Json::array();
  for (const Patch& p : obstacle.patches()) patches.push_back(patch_json(obstacle, p));
  for (std::uint32_t k = 0; k < obstacle.angles().size(); ++k) angles.push_back(angle_json(obstacle, k));
  for (const FreeCell& c : obstacle.free_cells())
    cells.push_back({{"theta0", angle_json(obstacle, c.begin)},
                     {"theta1", angle_json(obstacle, c.end)},
                     {"unbounded", c.unbounded},
                     {"component", c.component}});
  return {{"patches", patches},
          {"angles", angles},
          {"events", json_of(obstacle.events())},
          {"shells", shells_json(obstacle)},
          {"free_cells", cells}};
}

std::string obstacle_glb(const CspaceObstacle& obstacle, const ObstacleMesh& mesh, Ends ends) {
  const double scale = mesh.extent / (2 * kPi);
  const std::vector<std::pair<std::string, std::string>> notes = {
      {"content", "boundary of the obstacle of a robot that moves and turns; x and y are translations of the robot"},
      {"z", "theta in radians times " + six_digits(scale) + ", from -pi to pi"},
      {"planes", ends == Ends::capped ? "the planes at -pi and at pi show the same slice, as grey caps"
                                      : "the planes at -pi and at pi show the same slice: the surface goes on from the "
                                        "one in the other"},
      {"colours",
       "yellow: edges of the obstacle on vertices of the robot; blue: edges of the robot, which turn, on "
       "vertices of the obstacle; shades: shells; grey: caps"},
      {"error", "at every angle within " + six_digits(mesh.tolerance) + " of the exact surface"},
      {"closed", closure(mesh).watertight() ? "yes" : "no"}};
  const MeshData data = ends == Ends::capped ? capped_mesh_data(mesh) : mesh_data(mesh);
  require_singles(data);
  const std::vector<FaceColour> colours = colours_of(obstacle, mesh, data.faces.size());
  return format_glb(data, {colours, notes});
}

std::string slice_strip(const CspaceObstacle& obstacle, std::size_t slices, const Progress& progress) {
  constexpr std::size_t kColumns = 6;
  std::vector<PicturedFrame> frames;
  const double step = 2 * kPi / static_cast<double>(slices);
  for (std::size_t k = 1; k <= slices; ++k) {
    if (progress && !progress("slices", static_cast<double>(k) / static_cast<double>(slices)))
      stop_with({ErrorCode::cancelled, "interrupted", {}});
    const Orientation theta = require(Orientation::nearest(static_cast<double>(k) * step - kPi, step / 1000));
    const PlanarSum slice = require(obstacle.slice(theta));
    const std::string tangent = theta.is_half_turn() ? "inf" : shown(theta.tan_half());
    const std::string degrees = six_digits(theta.radians() / kPi * 180) + "°";
    frames.push_back({degrees + ", tan θ/2 = " + tangent, drawn(slice)});
  }
  return film_strip(frames, kColumns);
}

Json mesh_json(const ObstacleMesh& mesh) {
  const MeshClosure closed = closure(mesh);
  return {{"vertices", mesh.vertices.size()},    {"triangles", mesh.triangles.size()},
          {"tolerance", mesh.tolerance},         {"watertight", closed.watertight()},
          {"open_edges", closed.open},           {"crowded_edges", closed.crowded},
          {"closing_area", closed.closing_area}, {"volume", enclosed_volume(mesh)}};
}

}  // namespace dymsum::cli
