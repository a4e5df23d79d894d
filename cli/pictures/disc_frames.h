// A page of a disc that grows.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dymsum/growing_disc.h"
#include "pictures/frame_pictures.h"

namespace dymsum::cli {

using DiscMaker = std::function<Result<DiscSet>(const DiscRadius&)>;

struct DiscFrames {
  std::string title, set;
  Region region;
  std::vector<PicturedFrame> frames;
  std::vector<DiscEvent> events;
};

/// The set at radii from 0 to `last`, evenly, and exactly at the events between, if these are few enough for a page.
/// Stops with what making one of them does.
void append_frames(DiscFrames& frames, const DiscMaker& make, double last, std::size_t count, const Progress& progress);
/// A slider over the radius, with a tick for every event on the way.
std::string disc_page(const DiscFrames& frames);

}  // namespace dymsum::cli
