#include "pictures/page.h"

#include <nlohmann/json.hpp>

#include "pictures/svg_paths.h"

namespace dymsum::cli {
namespace {

constexpr const char* kStyle = R"(<style>
body { font: 15px sans-serif; color: #243447; background: #fff; margin: 0 auto; padding: .8rem; max-width: 60rem }
h1 { font-size: 1.1rem; margin: .2rem 0 .7rem; overflow-wrap: anywhere }
#drawing { display: block; width: 100%; height: min(70vh, 100vw); box-sizing: border-box; border: 1px solid #dfe5ea }
.track { flex: 1; min-width: 8rem }
#ticks { display: block; box-sizing: border-box; width: calc(100% - 16px); margin: 0 8px; height: 16px; overflow: visible }
#ticks:empty { display: none }
.row { display: flex; flex-wrap: wrap; gap: .4rem 1rem; align-items: center; margin: .6rem 0 }
.row button { font: inherit; min-width: 4.5rem; padding: .4rem .6rem }
.row input[type=range] { display: block; width: 100%; height: 2rem; margin: 0 }
.row output { flex-basis: 100%; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; min-height: 1.3em }
.key i { display: inline-block; width: .9em; height: .9em; margin-right: .35em; vertical-align: -.1em; border: 1px solid #0003 }
</style>)";

constexpr const char* kControls = R"(<div class="row"><button id="play" type="button">play</button>
<div class="track"><svg id="ticks" viewBox="0 0 1000 16" preserveAspectRatio="none"></svg><input id="slider" type="range" min="0" value="0" aria-label="frame"></div>
<output id="caption"></output></div>
)";

constexpr const char* kTick = R"(
function tick(x, strong, label) {
  const [line, title] = ['line', 'title'].map(name => document.createElementNS('http://www.w3.org/2000/svg', name));
  for (const [name, value] of Object.entries({x1: x, x2: x, y1: strong ? 0 : 8, y2: 16, stroke: strong ? '#d81e3a' : '#777777', 'stroke-width': 1.5, 'vector-effect': 'non-scaling-stroke'})) line.setAttribute(name, value);
  title.textContent = label;
  line.append(title);
  el('ticks').append(line);
}
)";

constexpr const char* kPlayer = R"(
const slider = el('slider'), play = el('play');
let timer = 0;
function again() { el('caption').textContent = frames.length ? show(+slider.value) : 'no frames'; }
function stop() { clearInterval(timer); timer = 0; play.textContent = 'play'; }
slider.max = Math.max(0, frames.length - 1);
slider.oninput = () => { stop(); again(); };
play.disabled = frames.length < 2;
play.onclick = () => {
  if (timer) return stop();
  timer = setInterval(() => { slider.value = (+slider.value + 1) % frames.length; again(); }, 80);
  play.textContent = 'pause';
};
window.addEventListener('resize', again);
again();
</script></body></html>
)";

/// Text that can stand inside a script element.
std::string in_script(std::string json) {
  for (std::size_t at = json.find("</"); at != std::string::npos; at = json.find("</", at + 2))
    json.insert(at + 1, "\\");
  return json;
}

}  // namespace

std::string page(const std::string& title, const std::string& drawing, const std::vector<LegendEntry>& legend,
                 const std::string& extra, const std::string& data, const std::string& script) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>" +
      escaped(title) + "</title>\n" + kStyle + "</head><body>\n<h1>" + escaped(title) + "</h1>\n" + drawing + "\n" +
      kControls;
  html += extra + "<div class=\"row key\">";
  for (const LegendEntry& entry : legend)
    html += "<span><i style=\"background:" + entry.colour + "\"></i>" + escaped(entry.text) + "</span>\n";
  html += "</div>\n<script>\nconst el = id => document.getElementById(id), frames = " + in_script(data) + ";\n";
  return html + kTick + script + kPlayer;
}

std::string slider_ticks(const std::vector<SliderTick>& ticks) {
  nlohmann::json list = nlohmann::json::array();
  for (const SliderTick& t : ticks) list.push_back({1000 * t.at, t.strong, t.label});
  return ticks.empty() ? "" : "\nfor (const t of " + in_script(list.dump()) + ") tick(...t);\n";
}

}  // namespace dymsum::cli
