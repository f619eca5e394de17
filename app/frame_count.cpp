#include "app/frame_count.h"

#include <algorithm>

namespace pintle::app {

namespace {

constexpr int usual_frames = 101, least_frames = 11;
constexpr long drawn_points = 3'000'000;  ///< points of flexible bodies in all frames: about 200 MB

}  // namespace

FrameCount::FrameCount(Scene& scene) : open_(scene.output.frames < 0) {
  if (open_) scene.output.frames = usual_frames;
}

void FrameCount::fit(const Model& model, Scene& scene) const {
  if (!open_) return;
  long points = 1;
  for (const FlexibleDrawing& body : model.drawings) points += static_cast<long>(body.points().cols());
  scene.output.frames = static_cast<int>(std::clamp<long>(drawn_points / points, least_frames, usual_frames));
}

}  // namespace pintle::app
