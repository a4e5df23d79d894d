// The frame of every HTML page: a title, a drawing, play button and slider, a legend; readable on a phone.
#pragma once

#include <string>
#include <vector>

namespace dymsum::cli {

/// A colour of the drawing and what it means.
struct LegendEntry {
  std::string colour, text;
};

/// A mark over the way of the slider's thumb.
struct SliderTick {
  double at = 0;  ///< from 0 to 1
  std::string label;
  bool strong = false;  ///< high and red, else low and grey
};
/// Script text that draws the ticks.
std::string slider_ticks(const std::vector<SliderTick>& ticks);

/// One page without network or library. `drawing` is the HTML of the picture, `extra` further controls, `data` JSON
/// text of the list of frames, which becomes the constant `frames`. The SVG element `ticks`, 1000 wide and 16 high,
/// stands over the way of the slider's thumb and is hidden while it is empty. `script` defines show(i), which draws
/// frame i and returns its caption; it can use el(ID), tick(x, strong, label), and, where it must draw again, again().
std::string page(const std::string& title, const std::string& drawing, const std::vector<LegendEntry>& legend,
                 const std::string& extra, const std::string& data, const std::string& script);

}  // namespace dymsum::cli
