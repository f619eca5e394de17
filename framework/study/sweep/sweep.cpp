#include "framework/study/sweep/sweep.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <memory>
#include <thread>

#include "framework/common/file.h"
#include "framework/study/sweep/curves.h"
#include "framework/study/sweep/study_folder.h"
#include "framework/study/sweep/worker_pool.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using clock = std::chrono::steady_clock;

/// Messages between the processes: the first number of a message.
enum Word : std::int64_t {
  go,      ///< 0 to all: the folder is ready
  reject,  ///< 0 to all: there is nothing to do
  ask,     ///< to 0: number of idle threads; then the work done since the last message
  deal,    ///< 0 to one: whether these were the last; then numbers of cases
  leave,   ///< to 0: whether it was stopped; then the work done since the last message
  bye,     ///< 0 to one that is leaving
  halt     ///< 0 to all: stop
};

using Message = std::vector<std::int64_t>;
constexpr auto nap = std::chrono::milliseconds(2);  // short compared with the 50 ms of a portion
constexpr std::size_t most_dealt = 400;             // fits into a message that is sent without waiting for its receiver

void report(Message& to, const WorkerPool::Tally& since) {
  to.insert(to.end(),
            {static_cast<std::int64_t>(since.done), static_cast<std::int64_t>(since.trouble), static_cast<std::int64_t>(since.busy * 1e6)});
}

void send_all(Communicator& communicator, Word word) {
  for (int k = 1; k < communicator.size(); ++k) communicator.send(k, Message{word});
}

Message next_message(Communicator& communicator, int& from) {
  Message said;
  while (!communicator.receive(from, said)) std::this_thread::sleep_for(nap);
  return said;
}

void take_leave(Communicator& communicator, const Message& last) {
  communicator.send(0, last);
  for (int from = 0; next_message(communicator, from)[0] != bye;) {
  }
}

/// Number of cases to distribute at once: enough for about 50 ms, so that short ones do not wait for messages, but few enough to leave work
/// for all; towards the end one for each idle thread.
std::size_t portion(std::size_t left, std::size_t workers, std::size_t idle, const SweepCount& so_far) {
  if (left <= 2 * workers) return std::min(left, idle);
  const double each = so_far.done > 0 ? so_far.busy / static_cast<double>(so_far.done) : 1;
  const auto some = static_cast<std::size_t>(std::min(0.05 / std::max(each, 1e-6), 1.0 * most_dealt));
  return std::clamp<std::size_t>(some, 1, std::max<std::size_t>(left / (4 * workers), 1));
}

/// Process 0, or the only one: works, and distributes cases to the others.
class Leader {
 public:
  Leader(const Sweep& sweep, Journal& journal, const fs::path& folder, const SweepSettings& settings,
         const std::vector<std::size_t>& numbers, SweepEnd& end)
      : settings_(settings),
        end_(end),
        present_(settings.communicator ? settings.communicator->size() - 1 : 0),
        workers_(sweep, journal, folder, 0, settings.threads) {
    workers_.queue().add(numbers);
    if (present_ == 0) workers_.queue().close();
  }

  void lead() {
    end_.workers += workers_.workers() - settings_.threads;
    end_.shortage = workers_.shortage();
    while (!workers_.home() || present_ > 0) {
      while (present_ > 0 && listen()) {
      }
      look();
      tell();
      workers_.work_here([this] { tell(); });
      if (workers_.troubled()) stop();
      if (workers_.queue().left() == 0) workers_.queue().close();
      if (present_ > 0)
        std::this_thread::sleep_for(nap);
      else
        workers_.wait(std::chrono::milliseconds(100));
    }
    look();
    workers_.finish();
  }

 private:
  void tell() {
    if (clock::now() - told_ <= std::chrono::milliseconds(100)) return;
    told_ = clock::now();
    if (settings_.progress && !settings_.progress(end_.count)) stop();
  }

  void look() {
    count(workers_.tally());
    end_.count.seconds = std::chrono::duration<double>(clock::now() - begin_).count();
  }

  void count(const WorkerPool::Tally& more) {
    end_.count.done += more.done, end_.count.trouble += more.trouble, end_.count.busy += more.busy;
  }

  void stop() {
    workers_.stop();
    if (settings_.communicator && !halted_) send_all(*settings_.communicator, halt);
    halted_ = true;
  }

  bool listen() {
    int from = 0;
    Message said;
    if (!settings_.communicator->receive(from, said)) return false;
    count({static_cast<std::size_t>(said[2]), static_cast<std::size_t>(said[3]), 1e-6 * static_cast<double>(said[4])});
    if (said[0] == leave) {
      --present_;
      if (said[1] != 0) stop();
      settings_.communicator->send(from, Message{bye});
      return true;
    }
    const std::vector<std::size_t> some = workers_.queue().draw_some(
        portion(workers_.queue().left(), static_cast<std::size_t>(end_.workers), static_cast<std::size_t>(said[1]), end_.count));
    Message answer{deal, workers_.queue().left() == 0};
    for (std::size_t k : some) answer.push_back(static_cast<std::int64_t>(k));
    settings_.communicator->send(from, answer);
    return true;
  }

  const SweepSettings& settings_;
  SweepEnd& end_;
  int present_;  ///< other processes that have not left
  bool halted_ = false;
  clock::time_point begin_ = clock::now(), told_{};
  WorkerPool workers_;
};

/// Any other process: requests cases when a worker draws its last one, so that more arrive before that is finished.
class Follower {
 public:
  Follower(const Sweep& sweep, Journal& journal, const fs::path& folder, const SweepSettings& settings)
      : settings_(settings),
        communicator_(*settings.communicator),
        workers_(sweep, journal, folder, communicator_.rank(), settings.threads) {}

  /// @returns its leave message
  Message follow() {
    while (!workers_.home() || asked_) {
      Message said;
      if (int from = 0; communicator_.receive(from, said)) hear(said);
      look_up();
      workers_.work_here([this] { look_up(); });
      if (workers_.troubled()) stop();
      if (wants()) {
        Message question{ask, workers_.idle()};
        report(question, workers_.tally());
        communicator_.send(0, question);
        asked_ = true;
      }
      if (asked_)
        std::this_thread::sleep_for(nap / 2);
      else
        workers_.wait(std::chrono::milliseconds(20));
    }
    workers_.finish();
    Message last{leave, stopped_};
    report(last, workers_.tally());
    return last;
  }
  const std::string& shortage() const { return workers_.shortage(); }

 private:
  void look_up() {
    if (settings_.progress && !settings_.progress({})) stop();
  }

  void stop() {
    stopped_ = true;
    workers_.stop();
  }

  bool wants() {
    return !asked_ && !stopped_ && !workers_.queue().closed() && workers_.queue().left() == 0 && (!told_to_wait_ || workers_.idle() > 0);
  }

  void hear(const Message& said) {
    if (said[0] == halt) return stop();
    asked_ = false;
    const std::vector<std::size_t> numbers(said.begin() + 2, said.end());
    told_to_wait_ = numbers.empty();
    if (!stopped_) workers_.queue().add(numbers);
    if (said[1] != 0) workers_.queue().close();
  }

  const SweepSettings& settings_;
  Communicator& communicator_;
  bool asked_ = false, told_to_wait_ = false, stopped_ = false;
  WorkerPool workers_;
};

SweepEnd run_as_follower(const Sweep& sweep, const fs::path& folder, const SweepSettings& settings) {
  Communicator& communicator = *settings.communicator;
  if (rejected(communicator)) return {};
  Message last{leave, 1, 0, 0, 0};
  SweepEnd end;
  std::exception_ptr trouble;
  try {
    if (!fs::exists(journal_path(folder, 0)))
      throw std::runtime_error(folder.string() + ": process " + std::to_string(communicator.rank()) +
                               " does not see it; name a directory with --out that all machines share");
    Journal journal(journal_path(folder, communicator.rank()), sweep.journal_print());
    Follower follower(sweep, journal, folder, settings);
    last = follower.follow();
    end.shortage = follower.shortage();
  } catch (...) {
    trouble = std::current_exception();
  }
  take_leave(communicator, last);  // after the journal is closed, because process 0 then reads it
  if (trouble) std::rethrow_exception(trouble);
  return end;
}

void write_tables(const Sweep& sweep, const fs::path& folder, const SweepEnd& end) {
  std::error_code ignored;
  if (!end.whole) {
    write_synced(folder / "sweep-so-far.csv", sweep_csv(sweep, end.rows));
    return;
  }
  fs::remove(folder / "sweep-so-far.csv", ignored);
  const std::string warnings = warnings_csv(end.rows);
  if (warnings.empty())
    fs::remove(folder / "warnings.csv", ignored);
  else
    write_synced(folder / "warnings.csv", warnings);
  write_synced(folder / table_name(sweep), sweep_csv(sweep, end.rows));
  write_synced(folder / "timings.csv", timings_csv(end.rows));
  const fs::path of_session = folder / "sweep.json";  // of the last one that ran a case
  if (end.count.done > 0 || !fs::exists(of_session) || fs::is_empty(of_session)) write_synced(of_session, sweep_json(sweep, end));
}

}  // namespace

std::uint64_t Sweep::journal_print() const { return part ? part_file(*this).print : print; }

const char* table_name(const Sweep& sweep) { return sweep.part ? "sweep-part.csv" : "sweep.csv"; }

void reject_all(Communicator& communicator) { send_all(communicator, reject); }

bool rejected(Communicator& communicator) {
  int from = 0;
  return next_message(communicator, from)[0] == reject;
}

void stay_away(Communicator& communicator) { take_leave(communicator, {leave, 1, 0, 0, 0}); }

SweepEnd run_sweep(const Sweep& sweep, const fs::path& folder, const SweepSettings& settings) {
  Communicator* communicator = settings.communicator;
  if (communicator && communicator->rank() > 0) return run_as_follower(sweep, folder, settings);

  SweepEnd end;
  end.workers = settings.threads * (communicator ? communicator->size() : 1);
  std::unique_ptr<Journal> journal;
  std::vector<std::size_t> numbers;
  try {
    journal = open_study_folder(sweep, folder, end.notes);
    std::vector<bool> ended(sweep.cases.size() + 1, false);
    for (const Row& row : read_journals(folder, sweep.journal_print(), sweep.cases.size(), &end.notes)) {
      if (!sweep.has(row.number))
        throw SceneError(folder.string(), {},
                         "its journal holds case " + std::to_string(row.number) + ", which does not belong to " + part_text(*sweep.part) +
                             "; remove the folder and run the part again");
      const std::string fault = fault_of_curves(folder, row);
      if (!fault.empty()) end.notes.push_back(fault + "; its case is run again");
      ended[row.number] = fault.empty() && !lacked_memory(row);
    }
    for (std::size_t k = 1; k < ended.size(); ++k)
      if (sweep.has(k) && !ended[k]) numbers.push_back(k);
  } catch (...) {
    if (communicator) reject_all(*communicator);
    throw;
  }
  end.count.cases = sweep.size();
  end.count.before = sweep.size() - numbers.size();
  if (communicator) send_all(*communicator, go);
  {
    Leader leader(sweep, *journal, folder, settings, numbers, end);
    leader.lead();
  }
  journal.reset();
  end.rows = read_journals(folder, sweep.journal_print(), sweep.cases.size());
  end.whole = end.rows.size() == sweep.size();
  write_tables(sweep, folder, end);
  return end;
}

}  // namespace pintle
