#include "solid_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "solid_outputs.h"
#include "svg_paths.h"

namespace dymsum::cli {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>
body { font: 15px sans-serif; color: #243447; margin: 1.5rem; background: #fff }
canvas { width: min(92vw, 760px); aspect-ratio: 1; border: 1px solid #dfe5ea; touch-action: none; cursor: grab }
.row { display: flex; gap: .8rem; align-items: center; margin: .6rem 0; max-width: 760px } input[type=range] { flex: 1 }
.key span { display: inline-block; width: .9em; height: .9em; margin: 0 .3em 0 1em; vertical-align: -.1em }
</style>)";

constexpr const char* kScript = R"(<script>
const colours = ['#e8a33d', '#5bb98c', '#8cbae6', '#b3b8bf', '#d81e3a'];
const canvas = document.querySelector('canvas'), draw = canvas.getContext('2d');
const slider = document.querySelector('input[type=range]'), label = document.querySelector('output');
const button = document.querySelector('button'), changes = document.querySelector('input[type=checkbox]');
let yaw = 0.6, pitch = 0.4, timer = 0;
slider.max = frames.length - 1;
function show() {
  const f = frames[+slider.value], size = canvas.width = canvas.height = canvas.clientWidth * devicePixelRatio;
  const cy = Math.cos(yaw), sy = Math.sin(yaw), cp = Math.cos(pitch), sp = Math.sin(pitch), k = 0.46 * size / reach;
  const at = f.v.map(([x, y, z]) => {
    const u = cy * x + sy * y, w = -sy * x + cy * y;
    return [size / 2 + k * w, size / 2 - k * (cp * z - sp * u), cp * u + sp * z];
  });
  draw.clearRect(0, 0, size, size);
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
  label.textContent = f.label + ', ' + f.f.length + ' facets, ' + f.c.reduce((a, b) => a + b, 0) + ' new';
}
canvas.onpointerdown = e => canvas.setPointerCapture(e.pointerId);
canvas.onpointermove = e => { if (!e.buttons) return; yaw -= e.movementX / 150; pitch = Math.max(-1.5, Math.min(1.5, pitch + e.movementY / 150)); show(); };
button.onclick = () => {
  if (timer) { clearInterval(timer); timer = 0; button.textContent = 'play'; return; }
  timer = setInterval(() => { slider.value = (+slider.value + 1) % frames.length; show(); }, 60); button.textContent = 'pause';
};
slider.oninput = changes.onchange = window.onresize = show;
show();
</script></body></html>
)";

/// Six digits are finer than any screen.
nlohmann::json shortened(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", v);
  return std::strtod(text, nullptr);
}

nlohmann::json frame_json(const SolidPicture& picture) {
  const SolidSum& sum = picture.sum;
  nlohmann::json v = nlohmann::json::array(), f = v, k = v, c = v;
  for (const Point3& at : sum.at) v.push_back({shortened(at.x), shortened(at.y), shortened(at.z)});
  for (const SolidFacet& facet : sum.facets) {
    const std::string kind = facet_kind(facet);
    f.push_back(facet.vertices);
    k.push_back(kind == "face_vertex" ? 0 : kind == "vertex_face" ? 1 : kind == "edge_edge" ? 2 : 3);
    c.push_back(facet.changed ? 1 : 0);
  }
  return {{"label", picture.label}, {"v", v}, {"f", f}, {"k", k}, {"c", c}};
}

}  // namespace

std::string solid_page(const std::vector<SolidPicture>& frames, const std::string& title) {
  double reach = 0;
  nlohmann::json list = nlohmann::json::array();
  for (const SolidPicture& frame : frames) {
    for (const Point3& at : frame.sum.at) reach = std::max(reach, std::hypot(at.x, at.y, at.z));
    list.push_back(frame_json(frame));
  }
  std::string data = list.dump();
  for (std::size_t at = data.find("</"); at != std::string::npos; at = data.find("</", at + 2)) data.insert(at + 1, "\\");
  std::string page = kHead;
  page += "<title>" + escaped(title) + "</title></head><body><h3>" + escaped(title) + "</h3>\n<canvas></canvas>\n";
  page += "<div class=\"row\"><button>play</button><input type=\"range\" min=\"0\" value=\"0\"><output></output></div>\n";
  page += "<div class=\"row\"><label><input type=\"checkbox\" checked> show what is new in red</label><div class=\"key\">"
          "<span style=\"background:#e8a33d\"></span>face of P<span style=\"background:#5bb98c\"></span>face of Q"
          "<span style=\"background:#8cbae6\"></span>edge + edge<span style=\"background:#b3b8bf\"></span>merged</div></div>\n";
  page += "<script>const reach = " + std::to_string(reach > 0 ? reach : 1) + ", frames = " + data + ";</script>\n";
  return page + kScript;
}

}  // namespace dymsum::cli
