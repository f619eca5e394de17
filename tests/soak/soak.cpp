// Random mechanisms, one after another, each in a process of its own: every one must end with a status and closed books, or
// with a reason.
//   soak --count 60 --seed 1      sixty seeds from the first
//   soak --minutes 10 --seed 1    as many as ten minutes allow
//   soak --print 17               the scene of a seed, as a file that `pintle run` takes
//   soak --shrink 17              the scene of a seed that fails, with all lines left out that the failure does not need
//   soak --list                   a line a seed, not only for failures
//   soak --method dopri5          that method instead of a random one; stands before --print and --shrink
//   soak --ask statics            that alone, instead of a run and one other in turn; before --shrink; `agree`: by two methods
//   soak --agree                  besides, of every mechanism whether two methods agree
//   soak --steps 500              so many steps at most
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <vector>

#include "tests/soak/judge.h"
#include "tests/soak/mechanism.h"

namespace {

constexpr double run_seconds = 5;      // then a run is asked to stop
constexpr unsigned dead_seconds = 30;  // then it hangs

/// The verdict of a child process, which may crash or hang.
soak::Verdict in_child(const std::string& scene, soak::Question question, bool twice) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to a child process");
  std::cout.flush();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    close(ends[0]);
    const itimerval computing{{0, 0}, {dead_seconds, 0}};
    setitimer(ITIMER_PROF, &computing, nullptr);
    alarm(20 * dead_seconds);
    const soak::Verdict v = soak::judge(scene, question, twice, run_seconds);
    std::ostringstream s;
    s << v.good << '\0' << v.outcome << '\0' << v.detail << '\0' << v.steps << '\0' << v.seconds << '\0';
    const std::string text = s.str();
    for (std::size_t sent = 0; sent < text.size();) {
      const ssize_t n = write(ends[1], text.data() + sent, text.size() - sent);
      if (n <= 0) _exit(1);
      sent += static_cast<std::size_t>(n);
    }
    _exit(0);
  }
  close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(ends[0], buffer, sizeof buffer)) > 0;) text.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGALRM || WTERMSIG(status) == SIGPROF)) return {false, "hangs", "", 0, dead_seconds};
  if (WIFSIGNALED(status)) return {false, std::string("crashes: ") + strsignal(WTERMSIG(status)), "", 0, 0};
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return {false, "ends without a verdict", "", 0, 0};
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, '\0');) parts.push_back(part);
  return {parts.at(0) == "1", parts.at(1), parts.at(2), std::stod(parts.at(3)), std::stod(parts.at(4))};
}

/// The scene with another value of a key of `run`; as it is if the value is empty.
std::string with(std::string scene, const std::string& key, const std::string& value) {
  if (value.empty()) return scene;
  const std::size_t begin = scene.find(key + ": ", scene.find("\nrun: ")) + key.size() + 2;
  const std::size_t end = scene[begin] == '{' ? scene.find("}}", begin) + 2 : scene.find_first_of(",}", begin);
  return scene.replace(begin, end - begin, value);
}

soak::Question question(const std::string& name) {
  for (int k = 0; k < 6; ++k)
    if (name == soak::question_names[k]) return static_cast<soak::Question>(k);
  throw std::invalid_argument("there is no question \"" + name + "\": run, statics, kinematics, inverse, linearize or agree");
}

std::string shrunk(const std::string& scene, soak::Question question, const std::string& outcome) {
  std::vector<std::string> lines;
  std::istringstream in(scene);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  const auto joined = [&](std::size_t without, std::size_t count) {
    std::string out;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (i < without || i >= without + count) out += lines[i] + "\n";
    return out;
  };
  for (bool less = true; less;) {
    less = false;
    for (const std::size_t count : {std::size_t{4}, std::size_t{2}, std::size_t{1}})
      for (std::size_t i = 0; i + count <= lines.size();) {
        if (in_child(joined(i, count), question, false).outcome == outcome) {
          lines.erase(lines.begin() + static_cast<long>(i), lines.begin() + static_cast<long>(i + count));
          less = true;
        } else {
          ++i;
        }
      }
  }
  return joined(0, 0);
}

}  // namespace

int main(int argc, char** argv) try {
  std::uint64_t seed = 1;
  long count = -1;
  double minutes = 0;
  bool list = false, agree = false;
  std::string method, steps;
  std::vector<soak::Question> asked;  // empty: a run, and one other in turn
  const auto scene_of = [&](std::uint64_t n) { return with(with(soak::random_scene(n), "method", method), "max steps", steps); };
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--list") {
      list = true;
      continue;
    }
    if (word == "--agree") {
      agree = true;
      continue;
    }
    if (i + 1 == argc) throw std::invalid_argument("what is " + word + "? See the head of tests/soak/soak.cpp");
    const char* value = argv[++i];
    if (word == "--seed")
      seed = std::stoull(value);
    else if (word == "--count")
      count = std::stol(value);
    else if (word == "--minutes")
      minutes = std::stod(value);
    else if (word == "--method")
      method = value;
    else if (word == "--ask")
      asked = {question(value)};
    else if (word == "--steps")
      steps = value;
    else if (word == "--print")
      return std::cout << scene_of(std::stoull(value)), 0;
    else if (word == "--shrink") {
      if (asked.empty()) asked = {soak::Question::run};
      const std::string scene = scene_of(std::stoull(value));
      const soak::Verdict v = in_child(scene, asked.front(), false);
      std::cout << "# " << v.outcome << "\n" << shrunk(scene, asked.front(), v.outcome);
      return 0;
    } else
      throw std::invalid_argument("what is " + word + "? See the head of tests/soak/soak.cpp");
  }
  if (count < 0 && !(minutes > 0)) count = 60;

  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  struct Class {
    long seeds = 0;
    std::uint64_t first = 0;
    double steps = 0, slowest = 0;
    bool good = true;
  };
  std::map<std::string, Class> classes;
  long done = 0, failures = 0;
  for (; count >= 0 ? done < count : elapsed() < 60 * minutes; ++done, ++seed) {
    const std::string scene = scene_of(seed);
    std::vector<soak::Question> questions = asked;
    if (asked.empty()) questions = {soak::Question::run, static_cast<soak::Question>(1 + seed % 4)};
    if (agree) questions.push_back(soak::Question::agree);
    for (const soak::Question q : questions) {
      soak::Verdict v = in_child(scene, q, seed % 8 == 0);
      if (q != soak::Question::run) v.outcome = std::string(soak::question_names[static_cast<int>(q)]) + ": " + v.outcome;
      Class& c = classes[v.outcome];
      if (c.seeds++ == 0) c.first = seed;
      c.steps += v.steps, c.slowest = std::max(c.slowest, v.seconds), c.good = v.good;
      if (!v.good) ++failures;
      if (!v.good || list)
        std::cout << (v.good ? "" : "FAILURE ") << "seed " << seed << ": " << v.outcome << (v.detail.empty() ? "" : ": " + v.detail)
                  << std::endl;
    }
  }
  std::cout << "\n  seeds  first     steps  slowest  outcome\n";
  for (const auto& [outcome, c] : classes)
    std::cout << std::setw(7) << c.seeds << std::setw(7) << c.first << std::setw(10) << static_cast<long>(c.steps) << std::setw(8)
              << std::setprecision(2) << c.slowest << "s  " << (c.good ? "" : "FAILURE ") << outcome << "\n";
  std::cout << done << " seeds, " << failures << " failures, " << std::setprecision(3) << elapsed() << " s\n";
  return failures > 0;
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 2;
}
