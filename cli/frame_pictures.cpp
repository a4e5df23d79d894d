#include "frame_pictures.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "exit_code.h"
#include "outputs.h"
#include "progress_bar.h"

namespace dymsum::cli {
namespace {

Box joined(const std::vector<PicturedFrame>& frames) {
  Box box;
  for (const PicturedFrame& f : frames) box.see(f.set.box);
  return box.drawable();
}

/// A frame in the units of its own drawing, `factor` of which make a unit of the picture.
void draw(std::ostringstream& svg, const PicturedFrame& frame, double factor) {
  svg << "<path d=\"" << frame.set.path << "\" fill=\"#9ecae1\" fill-rule=\"evenodd\" stroke=\"#08519c\" "
      << "stroke-width=\"" << number(0.8 / factor) << "\"/>";
  for (const Point& p : frame.set.dots)
    svg << "<circle cx=\"" << number(p.x) << "\" cy=\"" << number(p.y) << "\" r=\"" << number(2.5 / factor)
        << "\" fill=\"#d7301f\"/>";
}

void open_svg(std::ostringstream& svg, double width, double height) {
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << number(width) << ' ' << number(height)
      << "\" font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
}

/// Opens a group for a drawing whose upper left corner comes to (x, y).
void open_drawing(std::ostringstream& svg, const Box& box, double factor, double x, double y) {
  svg << "<g transform=\"translate(" << number(x) << ' ' << number(y) << ") scale(" << number(factor) << ") translate("
      << number(-box.x0) << ' ' << number(-box.y0) << ")\">";
}

/// Shows a group during the i-th of n equal parts of `seconds`, again and again.
void show_during(std::ostringstream& svg, std::size_t i, std::size_t n, double seconds) {
  const std::string from = number(double(i) / double(n)), to = number(double(i + 1) / double(n));
  const bool first = i == 0, last = i + 1 == n;
  svg << "<animate attributeName=\"visibility\" values=\"" << (first ? "" : "hidden;") << "visible"
      << (last ? "" : ";hidden") << "\" keyTimes=\"0" << (first ? "" : ";" + from) << (last ? "" : ";" + to)
      << "\" calcMode=\"discrete\" dur=\"" << number(seconds) << "s\" repeatCount=\"indefinite\"/>";
}

}  // namespace

std::size_t picture_step(std::size_t frames, const std::vector<std::string>& files) {
  return files.empty() ? 0 : (frames + kMostPictures - 1) / kMostPictures;
}

bool is_page(const std::string& file) { return file.ends_with(".html"); }

void check_frame_pictures(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (!file.ends_with(".svg") && !is_page(file))
      throw Stop(kUsage, "-o writes .svg (film strip), anim.svg (animation) or .html (page with a slider): " + file);
}

void write_frame_pictures(const std::vector<std::string>& files, const std::vector<PicturedFrame>& frames,
                          const std::vector<PicturedTick>& ticks, const std::string& title) {
  constexpr std::size_t kColumns = 8;
  std::vector<std::string> texts;
  for (const std::string& file : files) {
    texts.push_back(is_page(file)                 ? scrub_page(frames, ticks, title)
                    : file.ends_with("anim.svg") ? animation(frames)
                                                  : film_strip(frames, kColumns));
  }
  throw_if_interrupted();
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(files[i], texts[i]);
}

std::string film_strip(const std::vector<PicturedFrame>& frames, std::size_t columns) {
  constexpr double kCell = 200, kGap = 12, kText = 16;
  const Box box = joined(frames);
  const double factor = kCell / box.size();
  const std::size_t n = std::max<std::size_t>(1, frames.size()), per_row = std::min(columns, n);
  const std::size_t rows = (n + per_row - 1) / per_row;
  const double cell_width = box.width() * factor + kGap, cell_height = box.height() * factor + kGap + kText;
  std::ostringstream svg;
  open_svg(svg, cell_width * double(per_row) + kGap, cell_height * double(rows) + kGap);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double x = kGap + cell_width * double(i % per_row), y = kGap + cell_height * double(i / per_row);
    svg << "<text x=\"" << number(x) << "\" y=\"" << number(y + 10) << "\">" << escaped(frames[i].caption)
        << "</text>\n";
    open_drawing(svg, box, factor, x, y + kText);
    draw(svg, frames[i], factor);
    svg << "</g>\n";
  }
  svg << "</svg>\n";
  return svg.str();
}

std::string animation(const std::vector<PicturedFrame>& frames) {
  constexpr double kSize = 600, kGap = 16, kText = 20, kFrameSeconds = 0.08, kLeastSeconds = 2;
  const Box box = joined(frames);
  const double factor = kSize / box.size(), width = box.width() * factor;
  const double seconds = std::max(kLeastSeconds, kFrameSeconds * double(frames.size()));
  std::ostringstream svg;
  open_svg(svg, width + 2 * kGap, box.height() * factor + 2 * kGap + kText);
  svg << "<rect x=\"" << kGap << "\" y=\"" << kGap + 8 << "\" width=\"" << number(width)
      << "\" height=\"3\" fill=\"#e3e8ec\"/>\n";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    svg << "<g class=\"frame\" visibility=\"" << (i == 0 ? "visible" : "hidden") << "\">";
    if (frames.size() > 1) show_during(svg, i, frames.size(), seconds);
    const double done = frames.size() > 1 ? double(i) / double(frames.size() - 1) : 1;
    svg << "<text x=\"" << kGap << "\" y=\"" << kGap << "\">" << escaped(frames[i].caption)
        << "</text><rect x=\"" << kGap << "\" y=\"" << kGap + 8 << "\" width=\"" << number(width * done)
        << "\" height=\"3\" fill=\"#08519c\"/>";
    open_drawing(svg, box, factor, kGap, kGap + kText);
    draw(svg, frames[i], factor);
    svg << "</g></g>\n";
  }
  svg << "</svg>\n";
  return svg.str();
}

std::string scrub_page(const std::vector<PicturedFrame>& frames, const std::vector<PicturedTick>& marks,
                       const std::string& title) {
  const Box box = joined(frames);
  const double margin = 0.03 * box.size();
  nlohmann::json list = nlohmann::json::array(), ticks = nlohmann::json::array();
  for (const PicturedFrame& f : frames) {
    nlohmann::json tight = nlohmann::json::array();
    for (const Point& p : f.set.dots) tight.push_back({p.x, p.y});
    list.push_back({{"at", f.at}, {"label", f.caption}, {"d", f.set.path}, {"tight", tight}});
  }
  for (const PicturedTick& t : marks) ticks.push_back({{"at", t.at}, {"strong", t.strong}, {"label", t.caption}});
  std::ostringstream html;
  html << "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>" << escaped(title) << "</title>\n"
       << "<style>body{font:14px sans-serif;margin:1em}svg#sum{width:100%;height:78vh;background:#fff}"
          "input{width:100%}#ticks{width:100%;height:18px}</style>\n"
       << "<h1 style=\"font-size:1.1em\">" << escaped(title) << "</h1>\n<svg id=\"sum\" viewBox=\""
       << number(box.x0 - margin) << ' ' << number(box.y0 - margin) << ' '
       << number(box.width() + 2 * margin) << ' ' << number(box.height() + 2 * margin)
       << "\"><path id=\"p\" fill=\"#9ecae1\" fill-rule=\"evenodd\" stroke=\"#08519c\" "
          "vector-effect=\"non-scaling-stroke\"/><g id=\"t\" fill=\"#d7301f\"></g></svg>\n"
       << "<svg id=\"ticks\" viewBox=\"0 0 1000 18\" preserveAspectRatio=\"none\"></svg>\n"
          "<input id=\"s\" type=\"range\" min=\"0\" max=\""
       << (frames.empty() ? 0 : frames.size() - 1) << "\" value=\"0\"><p id=\"l\"></p>\n<script>\nconst frames="
       << list.dump() << ",ticks=" << ticks.dump()
       << ",r=" << number(0.006 * box.size()) << ";\n"
       << R"(const ns="http://www.w3.org/2000/svg",el=i=>document.getElementById(i);
function show(i){const f=frames[i];if(!f)return;el("p").setAttribute("d",f.d);el("l").textContent=f.label;
el("t").replaceChildren(...f.tight.map(q=>{const c=document.createElementNS(ns,"circle");
for(const [k,v] of [["cx",q[0]],["cy",q[1]],["r",r]])c.setAttribute(k,v);return c}))}
el("s").oninput=e=>show(+e.target.value);show(0);
if(frames.length>1){const a=frames[0].at,b=frames[frames.length-1].at;for(const t of ticks){
const x=1000*(t.at-a)/(b-a),l=document.createElementNS(ns,"line"),c=t.strong?"#d7301f":"#777";
for(const [k,v] of [["x1",x],["x2",x],["y1",t.strong?0:8],["y2",18],["stroke",c]])l.setAttribute(k,v);
const n=document.createElementNS(ns,"title");n.textContent=t.label;l.append(n);el("ticks").append(l)}}
</script></html>
)";
  return html.str();
}

}  // namespace dymsum::cli
