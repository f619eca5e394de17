// The one file that includes mpi.h.
#include "app/communicator.h"

#include <stdlib.h>

#include <cstdlib>
#include <string>

#ifdef PINTLE_WITH_MPI
#include <mpi.h>
#endif

#include "framework/scene/error.h"

namespace pintle::app {

namespace {

/// As many as a launcher says it has started; 0 if there is no launcher.
int launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"})
    if (const char* size = std::getenv(name)) return std::atoi(size);
  // srun sets these for the tasks of a step; the script of a batch job has neither.
  if (std::getenv("SLURM_STEP_NUM_TASKS") && std::getenv("SLURM_PROCID") && std::getenv("SLURM_LOCALID"))
    return std::atoi(std::getenv("SLURM_STEP_NUM_TASKS"));
  return std::getenv("PMIX_RANK") || std::getenv("PMI_RANK") ? 1 : 0;
}

#ifdef PINTLE_WITH_MPI
int number_in(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : 0;
}

/// Whether the launcher put all processes on this machine, as far as it says.
bool on_one_machine() {
  if (const int all = number_in("OMPI_COMM_WORLD_SIZE"); all > 0) return number_in("OMPI_COMM_WORLD_LOCAL_SIZE") == all;
  return number_in("SLURM_STEP_NUM_NODES") == 1;
}

/// Processes of one machine talk through memory; Open MPI would have each of them listen on every network too. What the
/// user has set stays.
void keep_to_memory() {
  if (!on_one_machine()) return;
  ::setenv("OMPI_MCA_pml", "ob1", 0);
  ::setenv("OMPI_MCA_btl", "self,vader", 0);
}

class MpiCommunicator : public Communicator {
 public:
  MpiCommunicator() {
    keep_to_memory();
    int level = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiCommunicator() override { MPI_Finalize(); }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void send(int to, std::span<const std::int64_t> message) override {
    MPI_Send(message.data(), static_cast<int>(message.size()), MPI_INT64_T, to, 0, MPI_COMM_WORLD);
  }

  bool receive(int& from, std::vector<std::int64_t>& message) override {
    int there = 0, count = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &there, &status);
    if (!there) return false;
    MPI_Get_count(&status, MPI_INT64_T, &count);
    message.resize(static_cast<std::size_t>(count));
    from = status.MPI_SOURCE;
    MPI_Recv(message.data(), count, MPI_INT64_T, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return true;
  }

 private:
  int rank_ = 0, size_ = 1;
};
#endif

}  // namespace

std::unique_ptr<Communicator> communicator() {
  const int expected = launched();
  if (expected == 0) return nullptr;
#ifdef PINTLE_WITH_MPI
  auto out = std::make_unique<MpiCommunicator>();
  if (out->size() == 1 && expected > 1)
    throw SceneError("the launcher started " + std::to_string(expected) +
                     " processes, but MPI sees one: start them by mpirun, or by srun --mpi=pmix");
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
