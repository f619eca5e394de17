#pragma once

#include "framework/mechanism/model.h"

namespace pintle::app {

/// How many frames of its animation a run writes where the scene leaves it open: one at the start and at each
/// hundredth of it, of finely meshed bodies fewer, but eleven at least.
class FrameCount {
 public:
  explicit FrameCount(Scene&);           ///< before it is built: what frames need is kept
  void fit(const Model&, Scene&) const;  ///< after

 private:
  bool open_;
};

}  // namespace pintle::app
