#include "pictures/solid_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "numbers.h"
#include "pictures/page.h"
#include "solid/solid_outputs.h"

namespace dymsum::cli {
namespace {

constexpr const char* kShowSolid = R"(
const colours = ['#e8a33d', '#5bb98c', '#8cbae6', '#b3b8bf', '#d81e3a'];
const canvas = el('drawing'), draw = canvas.getContext('2d'), changes = el('changes');
let yaw = 0.6, pitch = 0.4;
function show(i) {
  const f = frames[i], width = canvas.width = canvas.clientWidth * devicePixelRatio, height = canvas.height = canvas.clientHeight * devicePixelRatio;
  const size = Math.min(width, height);
  const cy = Math.cos(yaw), sy = Math.sin(yaw), cp = Math.cos(pitch), sp = Math.sin(pitch), k = 0.46 * size / reach;
  const at = f.v.map(([x, y, z]) => {
    const u = cy * x + sy * y, w = -sy * x + cy * y;
    return [width / 2 + k * w, height / 2 - k * (cp * z - sp * u), cp * u + sp * z];
  });
  draw.clearRect(0, 0, width, height);
  draw.lineJoin = 'round';
  draw.lineWidth = Math.max(0.5, size / 1600);
  f.f.forEach((face, i) => {
    // Newell's normal, in the coordinates of the screen.
    let nx = 0, ny = 0, nz = 0;
    face.forEach((v, j) => {
      const a = at[v], b = at[face[(j + 1) % face.length]];
      nx += (b[1] - a[1]) * (a[2] + b[2]); ny += (b[2] - a[2]) * k * (a[0] + b[0]); nz += (a[0] - b[0]) * (a[1] + b[1]);
    });
    nx *= k;
    if (nz <= 0) return;
    const light = Math.max(0, (0.35 * nx - 0.5 * ny + 0.8 * nz) / Math.hypot(nx, ny, nz));
    const c = colours[changes.checked && f.c[i] ? 4 : f.k[i]], dim = 0.45 + 0.55 * light;
    draw.fillStyle = 'rgb(' + [1, 3, 5].map(p => Math.round(parseInt(c.slice(p, p + 2), 16) * dim)).join(',') + ')';
    draw.strokeStyle = 'rgba(36,52,71,.55)';
    draw.beginPath();
    face.forEach((v, j) => j ? draw.lineTo(at[v][0], at[v][1]) : draw.moveTo(at[v][0], at[v][1]));
    draw.closePath(); draw.fill(); draw.stroke();
  });
  return f.label + ', ' + f.f.length + ' facets, ' + f.c.reduce((a, b) => a + b, 0) + ' new';
}
canvas.style.touchAction = 'none';
canvas.style.cursor = 'grab';
canvas.onpointerdown = e => canvas.setPointerCapture(e.pointerId);
canvas.onpointermove = e => {
  if (!e.buttons) return;
  yaw -= e.movementX / 150;
  pitch = Math.max(-1.5, Math.min(1.5, pitch + e.movementY / 150));
  again();
};
changes.onchange = () => again();
)";

/// Six digits are finer than any screen.
nlohmann::json shortened(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", v);
  return std::strtod(text, nullptr);
}

/// The middle of a scene that is far from the origin; else the origin, about which the page turns.
Point3 middle_of(const std::vector<SolidPicture>& frames) {
  constexpr double kFar = 16, kMost = std::numeric_limits<double>::max();
  std::array<double, 3> low{kMost, kMost, kMost}, high{-kMost, -kMost, -kMost};
  double furthest = 0, size = 0;
  for (const SolidPicture& frame : frames)
    for (const Point3& at : frame.sum.at)
      for (std::size_t k = 0; k < 3; ++k) {
        const double c = std::array{at.x, at.y, at.z}[k];
        low[k] = std::min(low[k], c), high[k] = std::max(high[k], c), furthest = std::max(furthest, std::abs(c));
      }
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, high[k] - low[k]);
  if (!(furthest > kFar * size)) return {};
  return {std::midpoint(low[0], high[0]), std::midpoint(low[1], high[1]), std::midpoint(low[2], high[2])};
}

nlohmann::json frame_json(const SolidPicture& picture, const Point3& middle) {
  const SolidSum& sum = picture.sum;
  nlohmann::json v = nlohmann::json::array(), f = v, k = v, c = v;
  for (const Point3& at : sum.at)
    v.push_back({shortened(at.x - middle.x), shortened(at.y - middle.y), shortened(at.z - middle.z)});
  for (const SolidFacet& facet : sum.facets) {
    const std::string kind = facet_kind(facet);
    f.push_back(facet.vertices);
    k.push_back(kind == "face_vertex" ? 0 : kind == "vertex_face" ? 1 : kind == "edge_edge" ? 2 : 3);
    c.push_back(facet.changed ? 1 : 0);
  }
  return {{"label", picture.label}, {"v", v}, {"f", f}, {"k", k}, {"c", c}};
}

}  // namespace

std::string solid_page(const std::vector<SolidPicture>& frames, const std::vector<SliderTick>& events,
                       const std::string& title) {
  const Point3 middle = middle_of(frames);
  double reach = 0;
  nlohmann::json list = nlohmann::json::array();
  for (const SolidPicture& frame : frames) {
    for (const Point3& at : frame.sum.at) {
      const double far = length_of(at.x - middle.x, at.y - middle.y, at.z - middle.z);
      if (!std::isfinite(far)) throw Stop(kBadInput, "this cannot be drawn: a vertex is past the range of doubles");
      reach = std::max(reach, far);
    }
    list.push_back(frame_json(frame, middle));
  }
  const std::string extra =
      "<div class=\"row\"><label><input id=\"changes\" type=\"checkbox\" checked> show what is new in red</label>"
      "<span>drag to look around</span></div>\n";
  std::vector<LegendEntry> legend = {{"#e8a33d", "face of P"},
                                     {"#5bb98c", "face of Q"},
                                     {"#8cbae6", "edge + edge"},
                                     {"#b3b8bf", "merged"},
                                     {"#d81e3a", "new"}};
  if (!events.empty()) legend.push_back({"#777777", "low tick: an event"});
  std::ostringstream constants;
  constants.precision(17);
  constants << "const reach = " << (reach > 0 ? reach : 1) << ";";
  return page(title, "<canvas id=\"drawing\"></canvas>", legend, extra, list.dump(),
              constants.str() + kShowSolid + slider_ticks(events));
}

}  // namespace dymsum::cli
