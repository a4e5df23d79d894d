#include "pictures/marked_drawing.h"

namespace dymsum::cli {

MarkedDrawing::MarkedDrawing(const Box& seen) {
  constexpr double kSize = 1200, kMargin = 16;
  const Box box = seen.drawable();
  factor_ = kSize / box.size();
  origin_ = origin_of(box);
  svg_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << number(box.width() * factor_ + 2 * kMargin)
       << ' ' << number(box.height() * factor_ + 2 * kMargin)
       << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
       << "<g transform=\"translate(" << number(kMargin) << ' ' << number(kMargin) << ") scale(" << number(factor_)
       << ") translate(" << number(-(box.x0 - origin_.x)) << ' ' << number(-(box.y0 - origin_.y)) << ")\">\n";
}

void MarkedDrawing::add(const Drawn& set, const std::string& style) {
  svg_ << "<path d=\"" << path_data(set.chains, origin_) << "\" fill-rule=\"evenodd\" stroke-width=\""
       << number(1 / factor_) << "\" " << style << "/>\n";
}

void MarkedDrawing::mark(Point at, bool worst) {
  svg_ << "<circle cx=\"" << number(at.x - origin_.x) << "\" cy=\"" << number(-at.y - origin_.y) << "\" r=\""
       << number((worst ? 14 : 8) / factor_) << "\" fill=\"none\" stroke=\"" << kTightColour << "\" stroke-width=\""
       << number((worst ? 3 : 1.5) / factor_) << "\"/>\n";
}

void MarkedDrawing::join(Point from, Point to) {
  svg_ << "<path d=\"" << path_data({{{{from.x, -from.y}, {to.x, -to.y}}, false}}, origin_) << "\" stroke=\""
       << kTightColour << "\" stroke-width=\"" << number(2 / factor_) << "\"/>\n";
}

}  // namespace dymsum::cli
