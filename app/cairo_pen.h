#pragma once

#include "framework/plots/pen.h"

namespace pintle::app {

/// Interface of the module `cairo` (meshes/module.h), which draws plots as PNG and PDF.
struct CairoTable {
  const char* version;
  PlotPen* (*png)();
  PlotPen* (*pdf)();
};

}  // namespace pintle::app
