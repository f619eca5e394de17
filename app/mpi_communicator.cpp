// The only file that includes mpi.h.
#include "app/mpi_communicator.h"

#include <stdlib.h>

#include <cstdlib>

#include <mpi.h>

namespace pintle::app {

namespace {

int number_in(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : 0;
}

/// Whether the launcher has started all processes on this machine; false if that is unknown.
bool on_one_machine() {
  if (const int all = number_in("OMPI_COMM_WORLD_SIZE"); all > 0) return number_in("OMPI_COMM_WORLD_LOCAL_SIZE") == all;
  return number_in("SLURM_STEP_NUM_NODES") == 1;
}

/// Processes on one machine communicate through memory; otherwise Open MPI would make each of them listen on every network. Settings of the
/// user are kept.
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

}  // namespace

extern "C" [[gnu::visibility("default")]] const void* pintle_mpi() {
  static constexpr MpiTable table{PINTLE_VERSION, []() -> Communicator* { return new MpiCommunicator; }};
  return &table;
}

}  // namespace pintle::app
