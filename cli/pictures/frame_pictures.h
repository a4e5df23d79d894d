// Pictures of a planar sum that moves: a film strip, an animation, and a page that scrubs through the frames.
#pragma once

#include <string>
#include <vector>

#include "pictures/svg_paths.h"

namespace dymsum::cli {

/// What a picture needs of a frame.
struct PicturedFrame {
  double at = 0;        ///< where it stands in the motion
  std::string caption;  ///< "s = 3/2", "90 degrees"
  Drawn set;
};

/// A mark on the slider of a page.
struct PicturedTick {
  double at = 0;
  std::string caption;
  bool strong = false;
};

/// Pictures show every frame, of a long motion at most this many, evenly chosen.
inline constexpr std::size_t kMostPictures = 240;
/// Every how many frames there is a picture; 0 without files.
std::size_t picture_step(std::size_t frames, const std::vector<std::string>& files);

/// Whether a file's name asks for a page.
bool is_page(const std::string& file);
/// Usage errors for names that ask for none of these pictures.
void check_frame_pictures(const std::vector<std::string>& files);
/// All files, each as its name asks: .html a page, anim.svg an animation, other .svg a film strip.
void write_frame_pictures(const std::vector<std::string>& files, const std::vector<PicturedFrame>& frames,
                          const std::vector<PicturedTick>& ticks, const std::string& title);

/// The frames side by side in one scale of drawing, at most `columns` in a row; SVG text.
std::string film_strip(const std::vector<PicturedFrame>& frames, std::size_t columns);

/// The frames one after the other, for ever; SVG text with declarative animation and no script. What does not animate
/// shows the first frame.
std::string animation(const std::vector<PicturedFrame>& frames);

/// What a page shows besides its frames.
struct PageLegend {
  std::string set = "the sum", strong_tick = "the topology changes";
  Drawn still = {};  ///< dashed lines in every frame
  std::string still_name = {};
};

/// One HTML page with a slider over the frames and ticks; no network, no library.
std::string scrub_page(const std::vector<PicturedFrame>& frames, const std::vector<PicturedTick>& ticks,
                       const std::string& title, const PageLegend& words = {});

}  // namespace dymsum::cli
