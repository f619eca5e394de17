#include "app/communicator.h"

#include <cstdlib>
#include <string>

#include "app/mpi_communicator.h"
#include "framework/scene/error.h"
#include "meshes/module.h"

namespace pintle::app {

namespace {

/// The number of processes started by a launcher; 0 if there is none.
int launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"})
    if (const char* size = std::getenv(name)) return std::atoi(size);
  // srun sets these for the tasks of a step; they are not set in the script of a batch job.
  if (std::getenv("SLURM_STEP_NUM_TASKS") && std::getenv("SLURM_PROCID") && std::getenv("SLURM_LOCALID"))
    return std::atoi(std::getenv("SLURM_STEP_NUM_TASKS"));
  return std::getenv("PMIX_RANK") || std::getenv("PMI_RANK") ? 1 : 0;
}

}  // namespace

std::unique_ptr<Communicator> communicator() {
  const int expected = launched();
  if (expected == 0) return nullptr;
#ifdef PINTLE_WITH_MPI
  std::unique_ptr<Communicator> out(module_table<MpiTable>("mpi").make());
  if (out->size() == 1 && expected > 1)
    throw SceneError("the launcher started " + std::to_string(expected) +
                     " processes, but MPI sees only one: start them with mpirun, or with srun --mpi=pmix");
  return out;
#else
  if (expected > 1)
    throw SceneError("a launcher started " + std::to_string(expected) +
                     " processes, but this program was built without MPI: install Open MPI (libopenmpi-dev) and configure again, or start "
                     "it alone with --threads");
  return nullptr;
#endif
}

}  // namespace pintle::app
