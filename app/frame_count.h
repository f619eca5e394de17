#pragma once

#include "framework/mechanism/model.h"

namespace pintle::app {

/// Default number of animation frames of a run: one at the start and at each hundredth of it, fewer for finely meshed bodies, but at least
/// eleven.
class FrameCount {
 public:
  explicit FrameCount(Scene&);           ///< before the scene is built: data for frames are then kept
  void fit(const Model&, Scene&) const;  ///< after it is built

 private:
  bool open_;
};

}  // namespace pintle::app
