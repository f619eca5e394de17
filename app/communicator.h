#pragma once

#include <memory>

#include "framework/study/sweep/communicator.h"

namespace pintle::app {

/// The processes that an MPI launcher (mpirun, srun) started with this one; nullptr if there is none, and then MPI is not used. Its
/// destruction ends MPI.
/// @throws SceneError  a launcher started several, but the program was built without MPI, or MPI does not see them
std::unique_ptr<Communicator> communicator();

}  // namespace pintle::app
