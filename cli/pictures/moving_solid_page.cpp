#include "pictures/moving_solid_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "exit_code.h"
#include "pictures/page.h"
#include "report.h"
#include "solid/any_solid_outputs.h"
#include "solid/tight_marks.h"

namespace dymsum::cli {
namespace {

// Frames are sent to the graphics card when they are first shown. Triangles are drawn one by one, as flat as they are.
constexpr const char* kShowFrame = R"(
const colours = ['#e8a33d', '#5bb98c', '#8cbae6', '#b3b8bf', '#d81e3a', '#c2185b'].map(c => [1, 3, 5].map(p => parseInt(c.slice(p, p + 2), 16) / 255));
const canvas = el('drawing'), gl = canvas.getContext('webgl', {antialias: true, preserveDrawingBuffer: true}), changes = el('changes');
let yaw = 0.6, pitch = 0.4, zoom = 1;
const vertexText = `attribute vec3 at; attribute vec3 normal; attribute vec3 colour; uniform mat3 turn; uniform vec3 size; uniform float dark; varying vec3 c;
void main() {
  vec3 p = turn * at, n = turn * normal;
  float light = 0.45 + 0.55 * max(0.0, dot(n, vec3(0.35, 0.5, 0.8)));
  c = dark > 0.5 ? vec3(0.14, 0.2, 0.28) : colour * light;
  gl_Position = vec4(p.xy * size.xy, -p.z * size.z - dark * 0.0008, 1.0);
}`, pixelText = `precision mediump float; varying vec3 c; void main() { gl_FragColor = vec4(c, 1.0); }`;
function shader(kind, text) { const s = gl.createShader(kind); gl.shaderSource(s, text); gl.compileShader(s); return s; }
let program = null, where = {};
function prepare() {
  program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, vertexText));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, pixelText));
  gl.linkProgram(program);
  gl.useProgram(program);
  for (const name of ['at', 'normal', 'colour']) gl.enableVertexAttribArray(where[name] = gl.getAttribLocation(program, name));
  for (const name of ['turn', 'size', 'dark']) where[name] = gl.getUniformLocation(program, name);
  gl.enable(gl.DEPTH_TEST);
  gl.clearColor(1, 1, 1, 1);
}
if (gl) prepare();
canvas.addEventListener('webglcontextlost', e => e.preventDefault());
canvas.addEventListener('webglcontextrestored', () => { frames.forEach(f => { f.sent = null; }); prepare(); again(); });

function buffer(numbers) {
  const b = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, b);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
  return b;
}
function sent(f) {
  if (f.sent) return f.sent;
  const at = [], normal = [], colour = [], fresh = [], line = [], flat = [];
  const place = v => [f.v[3 * v], f.v[3 * v + 1], f.v[3 * v + 2]];
  const triangle = (corners, kind, isNew) => {
    const [a, b, c] = corners, u = b.map((x, k) => x - a[k]), w = c.map((x, k) => x - a[k]);
    const n = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]], length = Math.hypot(...n) || 1;
    for (const p of corners) {
      at.push(...p); normal.push(n[0] / length, n[1] / length, n[2] / length);
      colour.push(...colours[kind]); fresh.push(...colours[isNew ? 4 : kind]);
    }
  };
  f.k.forEach((kind, i) => triangle([0, 1, 2].map(j => place(f.t[3 * i + j])), kind % 4, kind >= 4));
  const solid = at.length / 3, mark = v => f.m.slice(3 * v, 3 * v + 3);
  for (let i = 0; i + 2 < f.w.length; i += 3) triangle([0, 1, 2].map(j => mark(f.w[i + j])), 5, false);
  for (const v of f.e) { line.push(...place(v)); flat.push(0, 0, 0); }
  return f.sent = {solid, count: at.length / 3, at: buffer(at), normal: buffer(normal), colour: buffer(colour), fresh: buffer(fresh),
                   lines: line.length / 3, line: buffer(line), flat: buffer(flat)};
}
function use(name, from) { gl.bindBuffer(gl.ARRAY_BUFFER, from); gl.vertexAttribPointer(where[name], 3, gl.FLOAT, false, 0, 0); }
function show(i) {
  const f = frames[i];
  if (!gl) return f.label + ': this browser draws no WebGL';
  const width = canvas.width = canvas.clientWidth * devicePixelRatio, height = canvas.height = canvas.clientHeight * devicePixelRatio;
  const size = 0.92 * zoom * Math.min(width, height), s = sent(f);
  const cy = Math.cos(yaw), sy = Math.sin(yaw), cp = Math.cos(pitch), sp = Math.sin(pitch);
  gl.viewport(0, 0, width, height);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  // Columns: where x, y and z of the sum go on the screen, to the right, up and towards the viewer.
  gl.uniformMatrix3fv(where.turn, false, [-sy, -sp * cy, cp * cy, cy, -sp * sy, cp * sy, 0, cp, sp]);
  gl.uniform3f(where.size, size / width, size / height, 0.9);
  gl.uniform1f(where.dark, 0);
  use('at', s.at); use('normal', s.normal); use('colour', changes.checked ? s.fresh : s.colour);
  gl.drawArrays(gl.TRIANGLES, 0, s.count);
  // What is tight shines through what is before it.
  gl.enable(gl.BLEND); gl.blendColor(0, 0, 0, 0.4); gl.blendFunc(gl.CONSTANT_ALPHA, gl.ONE_MINUS_CONSTANT_ALPHA);
  gl.depthFunc(gl.GREATER); gl.depthMask(false);
  gl.drawArrays(gl.TRIANGLES, s.solid, s.count - s.solid);
  gl.disable(gl.BLEND); gl.depthFunc(gl.LESS); gl.depthMask(true);
  gl.uniform1f(where.dark, 1);
  use('at', s.line); use('normal', s.flat); use('colour', s.flat);
  gl.drawArrays(gl.LINES, 0, s.lines);
  return f.label + ', ' + f.text;
}
canvas.style.touchAction = 'none';
canvas.style.cursor = 'grab';
const fingers = new Map();
canvas.onpointerdown = e => { canvas.setPointerCapture(e.pointerId); fingers.set(e.pointerId, e); };
canvas.onpointerup = canvas.onpointercancel = e => fingers.delete(e.pointerId);
canvas.onpointermove = e => {
  const before = fingers.get(e.pointerId);
  if (!before) return;
  if (fingers.size === 2) {
    const other = [...fingers.values()].find(f => f.pointerId !== e.pointerId), far = p => Math.hypot(p.clientX - other.clientX, p.clientY - other.clientY);
    zoom = Math.max(0.2, Math.min(50, zoom * far(e) / (far(before) || 1)));
  } else {
    yaw -= (e.clientX - before.clientX) / 150;
    pitch = Math.max(-1.5, Math.min(1.5, pitch + (e.clientY - before.clientY) / 150));
  }
  fingers.set(e.pointerId, e);
  again();
};
canvas.addEventListener('wheel', e => { e.preventDefault(); zoom = Math.max(0.2, Math.min(50, zoom * Math.exp(-e.deltaY / 500))); again(); }, {passive: false});
changes.onchange = () => again();
)";

/// Five digits are finer than any screen; the largest coordinate is 1.
double five_digits(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5f", v);
  return std::strtod(text, nullptr);
}

/// Where all frames lie.
struct Scene {
  Point3 middle;
  double reach = 1;
};

Scene moving_scene(const std::vector<MovingSolidPicture>& frames) {
  constexpr double kMost = std::numeric_limits<double>::max();
  Point3 low{kMost, kMost, kMost}, high{-kMost, -kMost, -kMost};
  bool any = false;
  for (const MovingSolidPicture& frame : frames)
    for (const Point3& v : frame.sum.vertices) {
      if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
        throw Stop(kBadInput, "this cannot be drawn: a vertex is past the range of doubles");
      low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
      high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
      any = true;
    }
  Scene scene;
  if (!any) return scene;
  scene.middle = {std::midpoint(low.x, high.x), std::midpoint(low.y, high.y), std::midpoint(low.z, high.z)};
  const double x = high.x / 2 - low.x / 2, y = high.y / 2 - low.y / 2, z = high.z / 2 - low.z / 2;
  const double most = std::max({x, y, z});
  if (most > 0)
    scene.reach = most * std::sqrt((x / most) * (x / most) + (y / most) * (y / most) + (z / most) * (z / most));
  return scene;
}

void add_places(const std::vector<Point3>& places, const Scene& scene, nlohmann::json& list) {
  for (const Point3& p : places)
    for (const double c :
         {p.x / scene.reach - scene.middle.x / scene.reach, p.y / scene.reach - scene.middle.y / scene.reach,
          p.z / scene.reach - scene.middle.z / scene.reach})
      list.push_back(five_digits(c));
}

/// The edges at which triangles of different faces meet, as pairs of vertices.
nlohmann::json lines_of(const SpatialSum::Rounded& drawn) {
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> first;
  nlohmann::json lines = nlohmann::json::array();
  for (std::size_t t = 0; t < drawn.mesh.faces.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = drawn.mesh.faces[t][k], b = drawn.mesh.faces[t][(k + 1) % 3];
      const auto [at, is_new] = first.try_emplace({std::min(a, b), std::max(a, b)}, drawn.face[t]);
      if (!is_new && at->second != drawn.face[t]) lines.push_back(a), lines.push_back(b);
    }
  return lines;
}

std::string signed_count(std::int64_t n, const std::string& what) {
  return (n > 0 ? "+" : "") + std::to_string(n) + " " + what;
}

/// What changed in the sum's topology, for the tick over the slider; empty where nothing did.
std::string topology_change(const SolidFrameChanges& changes) {
  std::string text;
  const auto add = [&](std::int64_t n, const char* what) {
    if (n != 0) text += (text.empty() ? "" : ", ") + signed_count(n, what);
  };
  add(changes.shells, "shells"), add(changes.tight_faces, "tight faces");
  add(changes.tight_segments, "tight segments"), add(changes.tight_points, "tight points");
  return text;
}

nlohmann::json moving_frame_json(const MovingSolidPicture& picture, const Scene& scene) {
  const SpatialSum& sum = picture.sum;
  const SpatialSum::Rounded drawn = sum.drawn();
  std::vector<SolidContact> fresh = picture.changes.appeared;
  fresh.insert(fresh.end(), picture.changes.changed.begin(), picture.changes.changed.end());
  std::sort(fresh.begin(), fresh.end());
  nlohmann::json v = nlohmann::json::array(), t = v, k = v, m = v, w = v;
  add_places(drawn.mesh.vertices, scene, v);
  std::size_t changed = 0;
  std::vector<int> kinds;
  for (const SpatialFace& face : sum.faces) {
    const bool is_new = std::binary_search(fresh.begin(), fresh.end(), SolidContact{face.p, face.q});
    changed += is_new;
    kinds.push_back(face_colour(face) + (is_new ? 4 : 0));
  }
  for (std::size_t i = 0; i < drawn.mesh.faces.size(); ++i) {
    for (const std::uint32_t corner : drawn.mesh.faces[i]) t.push_back(corner);
    k.push_back(kinds[drawn.face[i]]);
  }
  const MeshData marks = tight_marks(sum);
  add_places(marks.vertices, scene, m);
  for (const Face& face : marks.faces)
    for (const std::uint32_t corner : face) w.push_back(corner);
  const std::size_t tight = sum.tight_faces.size() + sum.tight_segments.size() + sum.tight_points.size();
  return {{"label", picture.label},
          {"v", v},
          {"t", t},
          {"k", k},
          {"e", lines_of(drawn)},
          {"m", m},
          {"w", w},
          {"text", counted(sum.faces.size(), "face") + ", " + std::to_string(changed) + " new or changed, " +
                       counted(sum.shells, "shell") + ", " + counted(tight, "tight feature")}};
}

std::vector<SliderTick> ticks_at_changes(const std::vector<MovingSolidPicture>& frames) {
  std::vector<SliderTick> ticks;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (const std::string change = topology_change(frames[i].changes); !change.empty())
      ticks.push_back({static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(1, frames.size() - 1)),
                       frames[i].label + ": " + change, true});
  return ticks;
}

}  // namespace

std::string moving_solid_page(const std::vector<MovingSolidPicture>& frames, const std::vector<SliderTick>& events,
                              const std::string& title) {
  const Scene scene = moving_scene(frames);
  nlohmann::json list = nlohmann::json::array();
  for (const MovingSolidPicture& frame : frames) list.push_back(moving_frame_json(frame, scene));
  const std::string extra =
      "<div class=\"row\"><label><input id=\"changes\" type=\"checkbox\" checked> show what is new in red</label>"
      "<span>drag to look around, wheel or pinch to come nearer</span></div>\n";
  std::vector<LegendEntry> legend = {{"#e8a33d", "face of P"},      {"#5bb98c", "face of Q"},
                                     {"#8cbae6", "edge + edge"},    {"#b3b8bf", "merged"},
                                     {"#d81e3a", "new or changed"}, {"#c2185b", "tight"}};
  if (!events.empty()) legend.push_back({"#777777", "low tick: an event"});
  return page(title, "<canvas id=\"drawing\"></canvas>", legend, extra, list.dump(),
              kShowFrame + slider_ticks(events.empty() ? ticks_at_changes(frames) : events));
}

}  // namespace dymsum::cli
