#pragma once

#include <memory>

#include "framework/study/sweep/communicator.h"

namespace pintle::app {

/// The processes that an MPI launcher (mpirun, srun) started beside this one; nothing if none did, and then MPI is not
/// touched. MPI ends with it.
/// @throws SceneError  a launcher started several, but the program was built without MPI, or MPI does not see them
std::unique_ptr<Communicator> communicator();

}  // namespace pintle::app
