// Computations on threads of their own, so that signals are handled at once.
#include <unistd.h>

#include <atomic>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

#include "framework/common/stop_point.h"
#include "python/bindings.h"

namespace pintle::python {

namespace {

/// Computations that a signal has left under way. The interpreter waits for them before it ends.
class Left {
 public:
  void add(std::thread thread, std::future<void> end) {
    const std::lock_guard lock(mutex_);
    join(false);
    all_.emplace_back(std::move(thread), std::move(end));
  }
  void wait() {
    if (getpid() != owner_) return;  // a fork has no threads of its parent
    const std::lock_guard lock(mutex_);
    join(true);
  }

 private:
  void join(bool running_too) {
    std::erase_if(all_, [&](auto& one) {
      if (!running_too && one.second.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
      one.first.join();
      return true;
    });
  }

  const pid_t owner_ = getpid();
  std::mutex mutex_;
  std::vector<std::pair<std::thread, std::future<void>>> all_;
};

Left& left() {
  static Left& all = *new Left;  // outlives the module
  return all;
}

}  // namespace

void compute_aside(std::function<void()> compute) {
  constexpr std::chrono::milliseconds between{50};
  const auto stop = std::make_shared<std::atomic<bool>>(false);
  std::packaged_task<void()> task([compute = std::move(compute), stop] {
    stop_asked = stop.get();
    compute();
  });
  std::future<void> end = task.get_future();
  Watch watch;
  {
    const py::gil_scoped_release free;  // the end of a thread may need the interpreter
    std::thread thread(std::move(task));
    bool stopped = false;
    while (!stopped && end.wait_for(between) != std::future_status::ready) stopped = !watch();
    if (stopped) {
      *stop = true;
      left().add(std::move(thread), std::move(end));
    } else {
      thread.join();
    }
  }
  watch.raise();
  end.get();
}

void bind_aside(py::module_&) {
  left();
  py::module_::import("atexit").attr("register")(py::cpp_function([] {
    const py::gil_scoped_release free;
    left().wait();
  }));
}

}  // namespace pintle::python
