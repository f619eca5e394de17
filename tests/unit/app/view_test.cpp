// `pintle view`, asked as a browser would: over its socket, by hand.
#include <arpa/inet.h>
#include <signal.h>
#include <sys/socket.h>

#include <chrono>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/program.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle_test;
using Json = nlohmann::json;

constexpr const char* crank = R"(
title: A crank
ground: {points: {O: [0, 0]}}
bodies: {crank: {rigid: {mass: 1, inertia: 1}, points: {O: [0, 0], A: [2, 0]}}}
joints: {main: {revolute: [ground.O, crank.O]}}
run: {until: 1}
)";

/// The program, on a scene in a folder of its own, until the end of the test.
class View : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(PINTLE_BESIDE).empty()) GTEST_SKIP() << "pintle-view was not built: apt-get install libcpp-httplib-dev pkgconf";
    scene_ = folder_.write("scene.yaml", crank);
    child_ = start(folder_.path() / "log", {PINTLE_PROGRAM, "view", scene_.string(), "--allow-path", elsewhere_.path().string()});
    using clock = std::chrono::steady_clock;
    for (const auto begin = clock::now(); clock::now() - begin < std::chrono::minutes(2);) {
      const std::string said = contents(folder_.path() / "log.out");
      if (const std::size_t at = said.find("http://127.0.0.1:"); at != std::string::npos && said.find('\n', at) != std::string::npos) {
        const std::string address = said.substr(at + 17, said.find('\n', at) - at - 17);
        port_ = std::stoi(address);
        root_ = address.substr(address.find('/'));
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    FAIL() << "it has named no address: " << contents(folder_.path() / "log.err");
  }
  void TearDown() override {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    wait_for(child_, folder_.path() / "log");
  }

  /// @returns all that comes back   @param name  of the host, in the header; empty: as it is
  std::string answer(const std::string& method, const std::string& path, const std::string& body = "", std::string name = "",
                     const std::string& more = "") const {
    if (name.empty()) name = host();
    return answered(method + " " + path + " HTTP/1.1\r\nHost: " + name + "\r\nConnection: close\r\n" + more +
                    "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  }
  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  int connected() const {
    const int to = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port_));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(to, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    return to;
  }
  /// All that comes back until the connection is closed.
  std::string answered(const std::string& request) const {
    const int to = connected();
    std::string out;
    EXPECT_EQ(write(to, request.data(), request.size()), static_cast<ssize_t>(request.size()));
    char some[4096];
    for (ssize_t n = 0; (n = read(to, some, sizeof some)) > 0;) out.append(some, static_cast<std::size_t>(n));
    close(to);
    return out;
  }
  static std::string status(const std::string& answer) { return answer.substr(9, 3); }
  static Json json(const std::string& answer) { return Json::parse(answer.substr(answer.find("\r\n\r\n") + 4), nullptr, false); }
  Json now(long known = 0) const { return json(answer("GET", root_ + "now?known=" + std::to_string(known))); }

  Folder folder_, elsewhere_;
  fs::path scene_;
  pid_t child_ = -1;
  int port_ = 0;
  std::string root_;
};

TEST_F(View, ShowsTheSceneAndItsFreedomUnderItsAddressAlone) {
  EXPECT_EQ(status(answer("GET", root_)), "200");
  EXPECT_EQ(status(answer("GET", root_ + "view.js")), "200");
  for (const std::string path : {"/", "/now", "/view.js", "/0123456789abcdef0123456789abcdef/", "/../../etc/passwd"})
    EXPECT_EQ(status(answer("GET", path)), "404") << path;
  EXPECT_EQ(status(answer("GET", root_ + "../../../../etc/passwd")), "404");
  EXPECT_EQ(status(answer("GET", root_, "", "evil.example")), "404");  // another name for this machine
  EXPECT_EQ(status(answer("POST", root_ + "again", "{}", "", "Origin: http://evil.example\r\n")), "404");
  EXPECT_NE(status(answer("PUT", root_ + "now", "x")), "200");
  EXPECT_GE(root_.size(), 32U);

  const Json scene = now();
  ASSERT_TRUE(scene.is_object());
  EXPECT_EQ(scene["title"], "A crank");
  EXPECT_EQ(scene["error"], "");
  EXPECT_EQ(scene["mobility"], 1);
  EXPECT_EQ(scene["freedoms"].size(), 1U);
  EXPECT_FALSE(scene["lines"].empty());
  EXPECT_EQ(now(scene["version"]), (Json{{"version", scene["version"]}}));  // nothing new
}

TEST_F(View, TurnsTheCrankToWhereItIsDragged) {
  const Json scene = now();
  const Json dragged =
      json(answer("POST", root_ + "drag", Json{{"version", scene["version"]}, {"body", 0}, {"point", {2, 0}}, {"to", {0, 7}}}.dump()));
  ASSERT_TRUE(dragged.is_object());
  EXPECT_NEAR(dragged["bodies"][0]["angle"].get<double>(), std::acos(-1.0) / 2, 1e-3);
  const Json back = json(answer("POST", root_ + "again", "{}"));
  EXPECT_NEAR(back["bodies"][0]["angle"].get<double>(), 0, 1e-9);
  const std::string body_99 = Json{{"version", back["version"]}, {"body", 99}, {"point", {0, 0}}, {"to", {0, 0}}}.dump();
  for (const std::string& nonsense : Words{"", "{", "[]", body_99, R"({"body": 0, "point": [0, 0], "to": [0, 0]})",
                                           R"({"version": 1, "body": 0, "point": [], "to": "far"})"})
    EXPECT_EQ(status(answer("POST", root_ + "drag", nonsense)), "400") << nonsense;
  EXPECT_EQ(status(answer("POST", root_ + "again", "what")), "400");
  const Json late{{"version", 0}, {"body", 0}, {"point", {2, 0}}, {"to", {0, 7}}};  // of a drawing that is no more
  EXPECT_EQ(status(answer("POST", root_ + "drag", late.dump())), "200");
  EXPECT_NE(status(answer("POST", root_ + "drag", std::string(1 << 17, ' '))), "200");
}

TEST_F(View, ReadsTheSceneAgainWhenItIsSavedAndKeepsTheLastThatWasRight) {
  const Json first = now();
  std::string text = crank;
  text.replace(text.find("A crank"), 7, "A new one");
  const auto save = [&](const std::string& what, int seconds) {
    folder_.write("scene.yaml", what);
    fs::last_write_time(scene_, fs::last_write_time(scene_) + std::chrono::seconds(seconds));  // whatever the clock's grain is
  };
  save(text, 1);
  const Json second = now(first["version"]);
  EXPECT_EQ(second["title"], "A new one");
  save("bodies: {", 2);
  const Json wrong = now(second["version"]);
  EXPECT_NE(wrong["error"].get<std::string>().find("scene.yaml:"), std::string::npos) << wrong["error"];
  EXPECT_EQ(wrong["title"], "A new one");
  save(crank, 3);
  EXPECT_EQ(now(wrong["version"])["error"], "");
}

TEST_F(View, SaysThatASceneIsGoneAndShowsItAgainWhenItIsBack) {
  folder_.write("other.yaml", crank);
  fs::last_write_time(folder_.path() / "other.yaml", fs::last_write_time(scene_) + std::chrono::hours(1));
  const Json first = now();
  fs::remove(scene_);
  const Json gone = now(first["version"]);
  ASSERT_TRUE(gone.contains("error")) << gone;
  EXPECT_NE(gone["error"].get<std::string>().find("scene.yaml"), std::string::npos) << gone["error"];
  EXPECT_EQ(gone["title"], "A crank");  // the last drawing stays
  folder_.write("scene.yaml", crank);
  EXPECT_EQ(now(gone["version"])["error"], "");
}

TEST_F(View, ReadsTheSceneAgainWhenAFileInAnotherFolderIsSaved) {
  fs::create_directory(elsewhere_.path() / "curves");
  const auto save = [&](const std::string& name, const std::string& text, int seconds) {
    const fs::path file = elsewhere_.write(name, text);
    fs::last_write_time(file, fs::last_write_time(scene_) + std::chrono::seconds(seconds));
  };
  const std::string drives = "drivers: {motor: {angle: [ground, crank], law: {table: curves/turn.csv}}}\n";
  const Json first = now();
  folder_.write("scene.yaml", "include: " + (elsewhere_.path() / "motor.yaml").string() + crank);
  fs::last_write_time(scene_, fs::last_write_time(scene_) + std::chrono::seconds(1));  // whatever the clock's grain is
  const Json missing = now(first["version"]);
  EXPECT_NE(missing["error"].get<std::string>().find("motor.yaml"), std::string::npos) << missing["error"];
  save("motor.yaml", drives, 1);
  const Json no_table = now(missing["version"]);
  EXPECT_NE(no_table["error"].get<std::string>().find("turn.csv"), std::string::npos) << no_table["error"];
  save("curves/turn.csv", "0, 0\n1, 1\n", 1);
  const Json right = now(no_table["version"]);
  EXPECT_EQ(right["error"], "");
  EXPECT_EQ(right["drivers"], Json{"motor"});
  save("curves/turn.csv", "0, 0\n", 2);
  const Json short_table = now(right["version"]);
  EXPECT_NE(short_table["error"], "");
  EXPECT_EQ(now(short_table["version"]), (Json{{"version", short_table["version"]}}));
}

TEST_F(View, SlipsOfItsOptionsAreToldWithWhatWasMeant) {
  const Ended end = pintle_test::run(folder_.path() / "slip", {PINTLE_PROGRAM, "view", scene_.string(), "--prot", "80"});
  EXPECT_EQ(end.code, 2);
  EXPECT_EQ(end.complained.find("pintle: view has no option --prot. Did you mean \"--port\"?"), 0U) << end.complained;
}

TEST_F(View, AnswersItsOwnPageAlone) {
  const auto from = [&](const std::string& site) { return status(answer("GET", root_, "", "", "Sec-Fetch-Site: " + site + "\r\n")); };
  EXPECT_EQ(from("same-origin"), "200");
  EXPECT_EQ(from("none"), "200");  // an address that the user has typed
  for (const std::string site : {"cross-site", "same-site"}) {
    EXPECT_EQ(from(site), "404") << site;
    EXPECT_EQ(status(answer("POST", root_ + "again", "{}", "", "Sec-Fetch-Site: " + site + "\r\n")), "404") << site;
  }
}

TEST_F(View, RefusesOtherMethodsWithoutWaitingForABody) {
  const auto said = [&](const std::string& method) {
    return answered(method + " " + root_ + "now HTTP/1.1\r\nConnection: close\r\nHost: " + host() + "\r\n\r\n");
  };
  for (const std::string method : {"PUT", "PATCH", "DELETE", "OPTIONS"}) EXPECT_EQ(status(said(method)), "405") << method;
  EXPECT_EQ(status(said("POST")), "411");
}

/// As many as a browser and a scanner of ports may leave open; none of them has been given up when the page is answered.
TEST_F(View, AnswersWhileOthersSayNothing) {
  std::vector<int> silent;
  for (int k = 0; k < 13; ++k) {
    silent.push_back(connected());
    EXPECT_EQ(write(silent.back(), "GET ", 4), 4);
  }
  EXPECT_EQ(status(answer("GET", root_)), "200");
  char any = 0;
  for (const int one : silent) {
    EXPECT_LT(recv(one, &any, 1, MSG_DONTWAIT), 0) << "it was answered, or closed";
    close(one);
  }
}

TEST_F(View, WritesNothingAndEndsByCtrlC) {
  now();
  long files = 0;
  for (const auto& entry : fs::directory_iterator(folder_.path())) files += entry.path().filename().string().starts_with("log") ? 0 : 1;
  EXPECT_EQ(files, 1);
  kill(child_, SIGINT);
  EXPECT_EQ(wait_for(std::exchange(child_, -1), folder_.path() / "log").code, 0);
}

}  // namespace
