#include "scale_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

namespace dymsum::cli {
namespace {

std::string number(double v) {
  std::ostringstream text;
  text.precision(7);
  text << v;
  return text.str();
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') out += "&lt;";
    else if (c == '&') out += "&amp;";
    else out += c;
  }
  return out;
}

std::array<double, 4> joined(const std::vector<PicturedFrame>& frames) {
  std::array<double, 4> box{INFINITY, INFINITY, -INFINITY, -INFINITY};
  for (const PicturedFrame& f : frames)
    if (f.box[0] <= f.box[2])
      box = {std::min(box[0], f.box[0]), std::min(box[1], f.box[1]), std::max(box[2], f.box[2]), std::max(box[3], f.box[3])};
  if (!(box[0] <= box[2])) box = {0, 0, 1, 1};
  if (box[2] - box[0] <= 0) box[2] = box[0] + 1;
  if (box[3] - box[1] <= 0) box[3] = box[1] + 1;
  return box;
}

}  // namespace

PicturedFrame pictured(const ScalingSum& sum) {
  PicturedFrame frame;
  frame.s = sum.scale().approx();
  frame.label = sum.scale().exact().den == "1" ? sum.scale().exact().num : sum.scale().exact().to_string();
  if (frame.label.size() > 14) frame.label = number(frame.s);
  frame.box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
  std::ostringstream path;
  path.precision(7);
  const auto see = [&](Point p) {
    frame.box = {std::min(frame.box[0], p.x), std::min(frame.box[1], -p.y), std::max(frame.box[2], p.x), std::max(frame.box[3], -p.y)};
  };
  const auto ring = [&](const SumRing& r) {
    char command = 'M';
    for (const SumVertex& v : r.vertices) {
      path << command << v.at.x << ' ' << -v.at.y;
      command = 'L';
      see(v.at);
    }
    path << 'Z';
  };
  for (const SumPart& part : sum.sum().parts) {
    ring(part.outer);
    for (const SumRing& hole : part.holes) ring(hole);
  }
  const auto line = [&](const SumSegment& s) {
    path << 'M' << s.from.at.x << ' ' << -s.from.at.y << 'L' << s.to.at.x << ' ' << -s.to.at.y;
    see(s.from.at);
    see(s.to.at);
  };
  for (const SumSegment& s : sum.sum().segments) line(s);
  for (const SumSegment& s : sum.sum().tight_segments) line(s);
  for (const auto* points : {&sum.sum().points, &sum.sum().tight_points})
    for (const SumVertex& v : *points) {
      frame.tight.push_back({v.at.x, -v.at.y});
      see(v.at);
    }
  frame.path = path.str();
  return frame;
}

std::string film_strip(const std::vector<PicturedFrame>& frames, std::size_t columns) {
  const std::array<double, 4> box = joined(frames);
  const double width = box[2] - box[0], height = box[3] - box[1], cell = 200, gap = 12, text = 16;
  const double factor = cell / std::max(width, height);
  const std::size_t n = std::max<std::size_t>(1, frames.size()), per_row = std::min(columns, n), rows = (n + per_row - 1) / per_row;
  const double cw = width * factor + gap, ch = height * factor + gap + text;
  std::ostringstream svg;
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << number(cw * double(per_row) + gap) << ' ' << number(ch * double(rows) + gap)
      << "\" font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double x = gap + cw * double(i % per_row), y = gap + ch * double(i / per_row);
    svg << "<g transform=\"translate(" << number(x) << ' ' << number(y) << ")\"><text y=\"10\">s = " << escaped(frames[i].label) << "</text>\n"
        << "<g transform=\"translate(0 " << number(text) << ") scale(" << number(factor) << ") translate(" << number(-box[0]) << ' ' << number(-box[1])
        << ")\"><path d=\"" << frames[i].path << "\" fill=\"#9ecae1\" fill-rule=\"evenodd\" stroke=\"#08519c\" stroke-width=\"" << number(0.8 / factor) << "\"/>";
    for (const Point& p : frames[i].tight)
      svg << "<circle cx=\"" << number(p.x) << "\" cy=\"" << number(p.y) << "\" r=\"" << number(2.5 / factor) << "\" fill=\"#d7301f\"/>";
    svg << "</g></g>\n";
  }
  svg << "</svg>\n";
  return svg.str();
}

std::string scrub_page(const std::vector<PicturedFrame>& frames, const std::vector<ScaleEvent>& events, const std::string& title) {
  const std::array<double, 4> box = joined(frames);
  const double margin = 0.03 * std::max(box[2] - box[0], box[3] - box[1]);
  nlohmann::json list = nlohmann::json::array(), ticks = nlohmann::json::array();
  for (const PicturedFrame& f : frames) {
    nlohmann::json tight = nlohmann::json::array();
    for (const Point& p : f.tight) tight.push_back({p.x, p.y});
    list.push_back({{"s", f.s}, {"label", f.label}, {"d", f.path}, {"tight", tight}});
  }
  for (const ScaleEvent& e : events)
    if (e.visible) ticks.push_back({{"s", e.approx}, {"topology", e.topology}, {"label", e.s.to_string().substr(0, 60)}});
  std::ostringstream html;
  html << "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>" << escaped(title) << "</title>\n"
       << "<style>body{font:14px sans-serif;margin:1em}svg#sum{width:100%;height:78vh;background:#fff}input{width:100%}#ticks{width:100%;height:18px}</style>\n"
       << "<h1 style=\"font-size:1.1em\">" << escaped(title) << "</h1>\n<svg id=\"sum\" viewBox=\"" << number(box[0] - margin) << ' ' << number(box[1] - margin)
       << ' ' << number(box[2] - box[0] + 2 * margin) << ' ' << number(box[3] - box[1] + 2 * margin)
       << "\"><path id=\"p\" fill=\"#9ecae1\" fill-rule=\"evenodd\" stroke=\"#08519c\" vector-effect=\"non-scaling-stroke\"/><g id=\"t\" fill=\"#d7301f\"></g></svg>\n"
       << "<svg id=\"ticks\" viewBox=\"0 0 1000 18\" preserveAspectRatio=\"none\"></svg>\n<input id=\"s\" type=\"range\" min=\"0\" max=\""
       << (frames.empty() ? 0 : frames.size() - 1) << "\" value=\"0\"><p id=\"l\"></p>\n<script>\nconst frames=" << list.dump() << ",ticks=" << ticks.dump()
       << ",r=" << number(0.006 * std::max(box[2] - box[0], box[3] - box[1])) << ";\n"
       << R"(const ns="http://www.w3.org/2000/svg",el=i=>document.getElementById(i);
function show(i){const f=frames[i];if(!f)return;el("p").setAttribute("d",f.d);el("l").textContent="s = "+f.label;
el("t").replaceChildren(...f.tight.map(q=>{const c=document.createElementNS(ns,"circle");c.setAttribute("cx",q[0]);c.setAttribute("cy",q[1]);c.setAttribute("r",r);return c}))}
el("s").oninput=e=>show(+e.target.value);show(0);
if(frames.length>1){const a=frames[0].s,b=frames[frames.length-1].s;for(const t of ticks){const x=1000*(t.s-a)/(b-a),l=document.createElementNS(ns,"line");
for(const [k,v] of [["x1",x],["x2",x],["y1",t.topology?0:8],["y2",18],["stroke",t.topology?"#d7301f":"#777"]])l.setAttribute(k,v);
const n=document.createElementNS(ns,"title");n.textContent="s = "+t.label;l.append(n);el("ticks").append(l)}}
</script></html>
)";
  return html.str();
}

}  // namespace dymsum::cli
