#pragma once

#include "framework/study/sweep/communicator.h"

namespace pintle::app {

/// What the module `mpi` offers (meshes/module.h), the one that links MPI: a start does not pay for it.
struct MpiTable {
  const char* version;
  Communicator* (*make)();  ///< starts MPI; deleting ends it
};

}  // namespace pintle::app
