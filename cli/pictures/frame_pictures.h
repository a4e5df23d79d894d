// Pictures of a planar sum that moves: a film strip and an animation.
#pragma once

#include <string>
#include <vector>

#include "pictures/svg_paths.h"

namespace dymsum::cli {

/// What a picture needs of a frame.
struct PicturedFrame {
  std::string caption;  ///< "s = 3/2", "90 degrees"
  Drawn set;
};

/// Pictures show every frame, of a long motion at most this many, evenly chosen.
inline constexpr std::size_t kMostPictures = 240;
/// Every how many frames there is a picture; 0 without files.
std::size_t picture_step(std::size_t frames, const std::vector<std::string>& files);

/// Usage errors for names that ask for none of these pictures.
void check_frame_pictures(const std::vector<std::string>& files);
/// All files, each as its name asks: anim.svg an animation, other .svg a film strip.
void write_frame_pictures(const std::vector<std::string>& files, const std::vector<PicturedFrame>& frames);

/// The frames side by side in one scale of drawing, at most `columns` in a row; SVG text.
std::string film_strip(const std::vector<PicturedFrame>& frames, std::size_t columns);

/// The frames one after the other, for ever; SVG text with declarative animation and no script. What does not animate
/// shows the first frame.
std::string animation(const std::vector<PicturedFrame>& frames);

}  // namespace dymsum::cli
