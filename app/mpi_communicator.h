#pragma once

#include "framework/study/sweep/communicator.h"

namespace pintle::app {

/// Interface of the module `mpi` (meshes/module.h), which links MPI, so that other runs need not load it.
struct MpiTable {
  const char* version;
  Communicator* (*make)();  ///< starts MPI; deleting ends it
};

}  // namespace pintle::app
