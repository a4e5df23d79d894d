#include "pictures/features_page.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "inputs.h"
#include "pictures/page.h"
#include "pictures/shape_pictures.h"
#include "pictures/svg_paths.h"
#include "report.h"

namespace dymsum::cli {
namespace {

using nlohmann::json;

constexpr std::size_t kFrames = 100, kMostBridges = 150, kMostBars = 80;
constexpr double kBarStep = 9;

constexpr const char* kShowBridges = R"(
const ns = 'http://www.w3.org/2000/svg';
function made(name, attributes) {
  const e = document.createElementNS(ns, name);
  for (const k in attributes) e.setAttribute(k, attributes[k]);
  return e;
}
function line(a, b, c, d, colour, width) {
  return made('line', {x1: a, y1: b, x2: c, y2: d, stroke: colour, 'stroke-width': width, 'vector-effect': 'non-scaling-stroke'});
}
function show(i) {
  const f = frames[i], s = el('drawing').viewBox.baseVal, r = 3 * Math.max(s.width / el('drawing').clientWidth, s.height / el('drawing').clientHeight);
  el('discs').replaceChildren(...f.bridges.map(b => made('circle', {cx: b.c[0], cy: b.c[1], r: f.at / 2})));
  el('bridges').replaceChildren(...f.bridges.flatMap(b => [line(...b.l, b.gap ? '#e8a33d' : '#2a7d2a', 1.8)].concat(b.m ? [line((b.l[0] + b.l[2]) / 2, (b.l[1] + b.l[3]) / 2, ...b.m, '#888888', 0.7)] : [])));
  el('minima').replaceChildren(...f.bridges.filter(b => b.m).map(b => made('circle', {cx: b.m[0], cy: b.m[1], r: r})));
  const x = 1000 * f.at / frames[frames.length - 1].at;
  el('cursor').setAttribute('x1', x);
  el('cursor').setAttribute('x2', x);
  return f.label;
}
for (const t of ticks) tick(t.at, true, t.label);
)";

/// Seven digits are what a picture needs.
double short_number(double v) { return std::strtod(number(v).c_str(), nullptr); }

class FeaturesPage {
 public:
  FeaturesPage(const ShapeFeatures& features, double last, const std::vector<std::uint32_t>& kept)
      : features_(features), kept_(kept), is_kept_(features.bars().size(), false) {
    for (const std::uint32_t bar : kept) is_kept_[bar] = true;
    shape_ = cli::drawn(features.region());  // not that of discs
    box_ = shape_.box.drawable();
    origin_ = origin_of(box_);
    for (const FeatureBar& bar : features.bars())
      if (bar.death) last_ = std::max(last_, bar.death_alpha);
    last_ = last > 0 ? last : last_ > 0 ? 1.08 * last_ : box_.size();
    vertices_ = vertices_of(features.region());
  }

  json frames(const Progress& progress) const {
    json list = json::array();
    for (std::size_t i = 0; i < kFrames; ++i) {
      throw_if_interrupted();
      progress("frames", static_cast<double>(i) / kFrames);
      list.push_back(frame(last_ * static_cast<double>(i) / (kFrames - 1)));
    }
    return list;
  }

  /// Where kept bars end.
  json ticks() const {
    json list = json::array();
    for (const std::uint32_t bar : kept_) {
      const FeatureBar& b = features_.bars()[bar];
      if (b.death && b.death_alpha <= last_)
        list.push_back({{"at", short_number(1000 * b.death_alpha / last_)},
                        {"label", "bar " + std::to_string(bar) + " ends at " + number(b.death_alpha)}});
    }
    return list;
  }

  std::string drawing() const {
    const double margin = 0.03 * box_.size();
    std::ostringstream svg;
    svg << "<svg id=\"drawing\" viewBox=\"" << number(box_.x0 - origin_.x - margin) << ' '
        << number(box_.y0 - origin_.y - margin) << ' ' << number(box_.width() + 2 * margin) << ' '
        << number(box_.height() + 2 * margin) << "\"><g id=\"discs\" fill=\"#6baed6\" fill-opacity=\"0.12\"></g>"
        << "<path fill=\"#cfd5dc\" fill-rule=\"evenodd\" stroke=\"#333333\" vector-effect=\"non-scaling-stroke\" d=\""
        << path_data(shape_.chains, origin_)
        << "\"/><g id=\"bridges\"></g><g id=\"minima\" fill=\"#d81e3a\"></g></svg>";
    return svg.str();
  }

  /// The longest bars, kept ones first, over the way of the slider.
  std::string bars() const {
    std::vector<std::uint32_t> order = kept_;
    for (const std::uint32_t bar : features_.lasting(Rational(0)))
      if (!is_kept_[bar]) order.push_back(bar);
    const std::size_t shown = std::min(order.size(), kMostBars);
    const double height = kBarStep * static_cast<double>(std::max<std::size_t>(shown, 1));
    std::ostringstream svg;
    svg << "<svg viewBox=\"0 0 1000 " << number(height) << "\" preserveAspectRatio=\"none\" style=\"display:block;"
        << "width:100%;height:" << number(std::min(height, 420.0)) << "px\">";
    for (std::size_t i = 0; i < shown; ++i) svg << bar(order[i], kBarStep * static_cast<double>(i));
    svg << "<line id=\"cursor\" y1=\"0\" y2=\"" << number(height)
        << "\" stroke=\"#08519c\" stroke-width=\"1.5\" vector-effect=\"non-scaling-stroke\"/></svg>";
    if (shown < order.size()) svg << "<p>the " << shown << " longest of " << order.size() << " bars</p>";
    return svg.str();
  }

 private:
  double x_of(Point p) const { return short_number(p.x - origin_.x); }
  double y_of(Point p) const { return short_number(-p.y - origin_.y); }

  std::string bar(std::uint32_t index, double y) const {
    const FeatureBar& b = features_.bars()[index];
    const double from = 1000 * b.birth_alpha / last_, to = b.death ? 1000 * b.death_alpha / last_ : 1000;
    const char* colour = !is_kept_[index] ? "#c8ced6" : b.born == FeatureBar::Birth::corner ? "#d81e3a" : "#e8a33d";
    return "<rect x=\"" + number(from) + "\" y=\"" + number(y) + "\" width=\"" + number(std::max(1.0, to - from)) +
           "\" height=\"" + number(0.6 * kBarStep) + "\" fill=\"" + colour + "\"/>";
  }

  json frame(double alpha) const {
    std::vector<AlphaBridge> bridges = require(features_.bridges(require(Rational::of(alpha))));
    const std::size_t all = bridges.size(), shown = std::min(all, kMostBridges);
    const auto first = [&](const AlphaBridge& a, const AlphaBridge& b) {
      if (is_kept_[a.bar] != is_kept_[b.bar]) return static_cast<bool>(is_kept_[a.bar]);
      return a.length > b.length;
    };
    std::stable_sort(bridges.begin(), bridges.end(), first);
    json list = json::array();
    for (std::size_t i = 0; i < shown; ++i) {
      const AlphaBridge& b = bridges[i];
      json one = {{"l", {x_of(b.from.at), y_of(b.from.at), x_of(b.to.at), y_of(b.to.at)}},
                  {"c", {x_of(b.centre), y_of(b.centre)}}};
      if (b.gap) one["gap"] = true;
      if (b.minimum) one["m"] = {x_of(vertices_[*b.minimum]), y_of(vertices_[*b.minimum])};
      list.push_back(std::move(one));
    }
    std::string label = "alpha = " + number(alpha) + ", " + counted(all, "bridge");
    if (shown < all) label += ", " + std::to_string(shown) + " of them shown";
    return {{"at", alpha}, {"label", label}, {"bridges", list}};
  }

  const ShapeFeatures& features_;
  const std::vector<std::uint32_t>& kept_;
  std::vector<bool> is_kept_;
  std::vector<Point> vertices_;
  Drawn shape_;
  Box box_;
  Point origin_;
  double last_ = 0;
};

}  // namespace

std::string features_page(const ShapeFeatures& features, double last, const std::vector<std::uint32_t>& kept,
                          const std::string& title, const Progress& progress) {
  const FeaturesPage made(features, last, kept);
  const std::vector<LegendEntry> legend = {{"#2a7d2a", "bridge of a pocket"},
                                           {"#e8a33d", "gap between rings"},
                                           {"#d81e3a", "deepest vertex; bar that is kept; tick: where it ends"},
                                           {"#c8ced6", "other bars"},
                                           {"#6baed6", "discs at bridges"}};
  const std::string frames = made.frames(progress).dump();
  return page(title, made.drawing(), legend, made.bars(), frames,
              "const ticks = " + made.ticks().dump() + ";" + kShowBridges);
}

}  // namespace dymsum::cli
