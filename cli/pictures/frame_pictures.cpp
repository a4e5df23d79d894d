#include "pictures/frame_pictures.h"

#include <algorithm>
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
void draw(std::ostringstream& svg, const PicturedFrame& frame, Point origin, double factor) {
  svg << "<path d=\"" << path_data(frame.set.chains, origin)
      << "\" fill=\"#9ecae1\" fill-rule=\"evenodd\" stroke=\"#08519c\" "
      << "stroke-width=\"" << number(0.8 / factor) << "\"/>" << tight_features(frame.set, origin, factor);
}

void open_svg(std::ostringstream& svg, double width, double height) {
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << number(width) << ' ' << number(height)
      << "\" font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
}

/// Opens a group for a drawing whose upper left corner comes to (x, y).
void open_drawing(std::ostringstream& svg, const Box& box, double factor, double x, double y) {
  const Point origin = origin_of(box);
  svg << "<g transform=\"translate(" << number(x) << ' ' << number(y) << ") scale(" << number(factor) << ") translate("
      << number(-(box.x0 - origin.x)) << ' ' << number(-(box.y0 - origin.y)) << ")\">";
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

void check_frame_pictures(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (!file.ends_with(".svg"))
      throw Stop(kUsage, "-o writes .svg (film strip), anim.svg (animation) or .html (the viewer): " + file);
}

void write_frame_pictures(const std::vector<std::string>& files, const std::vector<PicturedFrame>& frames) {
  constexpr std::size_t kColumns = 8;
  std::vector<std::string> texts;
  for (const std::string& file : files)
    texts.push_back(file.ends_with("anim.svg") ? animation(frames) : film_strip(frames, kColumns));
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
    draw(svg, frames[i], origin_of(box), factor);
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
    svg << "<text x=\"" << kGap << "\" y=\"" << kGap << "\">" << escaped(frames[i].caption) << "</text><rect x=\""
        << kGap << "\" y=\"" << kGap + 8 << "\" width=\"" << number(width * done)
        << "\" height=\"3\" fill=\"#08519c\"/>";
    open_drawing(svg, box, factor, kGap, kGap + kText);
    draw(svg, frames[i], origin_of(box), factor);
    svg << "</g></g>\n";
  }
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace dymsum::cli
