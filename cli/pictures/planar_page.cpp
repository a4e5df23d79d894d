// The page of a planar sum that moves.
#include <nlohmann/json.hpp>
#include <sstream>

#include "pictures/frame_pictures.h"
#include "pictures/page.h"

namespace dymsum::cli {
namespace {

constexpr const char* kShowRegion = R"(
const ns = 'http://www.w3.org/2000/svg';
function made(name, attributes) {
  const e = document.createElementNS(ns, name);
  for (const k in attributes) e.setAttribute(k, attributes[k]);
  return e;
}
function show(i) {
  const f = frames[i], s = el('drawing').viewBox.baseVal, r = 4 * Math.max(s.width / el('drawing').clientWidth, s.height / el('drawing').clientHeight);
  el('sum').setAttribute('d', f.d);
  el('segments').setAttribute('d', f.tight);
  el('tight').replaceChildren(...f.dots.map(q => made('circle', {cx: q[0], cy: q[1], r: r})));
  return f.label;
}
// Frames stand equally far apart on the slider, whatever lies between them.
function place(at) {
  for (let k = 0; k + 1 < frames.length; ++k) {
    const share = (at - frames[k].at) / (frames[k + 1].at - frames[k].at);
    if (share >= 0 && share <= 1) return 1000 * (k + share) / (frames.length - 1);
  }
  return -1;
}
for (const t of ticks) {
  const x = place(t.at);
  if (x >= 0) tick(x, t.strong, t.label);
}
)";

constexpr const char* kStillColour = "#555555";

std::string still_path(const Drawn& still, Point origin) {
  if (still.chains.empty()) return "";
  return "<path fill=\"none\" stroke=\"" + std::string(kStillColour) +
         "\" stroke-dasharray=\"5 4\" vector-effect=\"non-scaling-stroke\" d=\"" + path_data(still.chains, origin) +
         "\"/>";
}

}  // namespace

std::string scrub_page(const std::vector<PicturedFrame>& frames, const std::vector<PicturedTick>& marks,
                       const std::string& title, const PageLegend& words) {
  Box box = words.still.box;
  for (const PicturedFrame& f : frames) box.see(f.set.box);
  box = box.drawable();
  const double margin = 0.03 * box.size();
  const Point origin = origin_of(box);
  nlohmann::json list = nlohmann::json::array(), ticks = nlohmann::json::array();
  for (const PicturedFrame& f : frames) {
    nlohmann::json dots = nlohmann::json::array();
    for (const Point& p : f.set.dots) dots.push_back({p.x - origin.x, p.y - origin.y});
    list.push_back({{"at", f.at},
                    {"label", f.caption},
                    {"d", path_data(f.set.chains, origin)},
                    {"tight", path_data(f.set.tight, origin)},
                    {"dots", dots}});
  }
  for (const PicturedTick& t : marks) ticks.push_back({{"at", t.at}, {"strong", t.strong}, {"label", t.caption}});
  std::ostringstream drawing;
  drawing << "<svg id=\"drawing\" viewBox=\"" << number(box.x0 - origin.x - margin) << ' '
          << number(box.y0 - origin.y - margin) << ' ' << number(box.width() + 2 * margin) << ' '
          << number(box.height() + 2 * margin)
          << "\"><path id=\"sum\" fill=\"#9ecae1\" fill-rule=\"evenodd\" stroke=\"#08519c\" "
             "vector-effect=\"non-scaling-stroke\"/>"
          << still_path(words.still, origin) << "<path id=\"segments\" fill=\"none\" stroke=\"" << kTightColour
          << "\" stroke-width=\"2.5\" stroke-linecap=\"round\" vector-effect=\"non-scaling-stroke\"/><g id=\"tight\" "
             "fill=\""
          << kTightColour << "\"></g></svg>";
  std::vector<LegendEntry> legend = {{"#9ecae1", words.set}, {kTightColour, "tight features"}};
  if (!words.still_name.empty()) legend.push_back({kStillColour, "dashed: " + words.still_name});
  if (!marks.empty()) {
    legend.push_back({"#777777", "low tick: an event"});
    legend.push_back({kTightColour, "high tick: " + words.strong_tick});
  }
  return page(title, drawing.str(), legend, "", list.dump(), "const ticks = " + ticks.dump() + ";" + kShowRegion);
}

}  // namespace dymsum::cli
