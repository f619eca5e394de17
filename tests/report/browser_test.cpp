// Pages in a browser: what they show equals the tables, and nothing goes wrong in them. Skipped where there is no Chromium.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "framework/report/run_report.h"
#include "tests/report/page_reading.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using pintle_report_test::between;
using pintle_report_test::Folder;
using pintle_report_test::Json;
using pintle_report_test::plain_table;
using pintle_report_test::text_of;
using pintle_report_test::write_run;

bool there_is_a_browser() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

/// What the page reports about itself with #check in its address.
Json shown_by_browser(const Folder& folder, const fs::path& page) {
  const std::string dom = (folder.path() / "dom.html").string();
  const std::string command =
      "timeout 120 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
      "--disable-component-update --disable-sync --user-data-dir='" +
      (folder.path() / "profile").string() + "' --dump-dom 'file://" + page.string() + "#check' >'" + dom + "' 2>/dev/null";
  if (std::system(command.c_str()) != 0) return {};
  return Json::parse(between(text_of(dom), "id=\"shown\">", "</script>"), nullptr, false);
}

/// "−1.5 µm" of a column in m is −1.5e-6.
double shown_number(std::string text, const std::string& heading) {
  for (std::size_t at; (at = text.find("−")) != std::string::npos;) text.replace(at, 3, "-");
  const std::string unit = between(heading, " [", "]"), written = text.substr(text.find(' ') + 1);
  const std::pair<const char*, double> prefixes[] = {{"p", 1e-12}, {"n", 1e-9}, {"µ", 1e-6}, {"m", 1e-3},
                                                     {"k", 1e3},   {"M", 1e6},  {"G", 1e9}};
  for (const auto& [prefix, factor] : prefixes)
    if (written == prefix + unit) return factor * std::stod(text);
  return std::stod(text);
}

class Browser : public testing::TestWithParam<const char*> {};

/// At each of four times the values beside the curves are those of the row, to the digits written: seven, of the ledger five.
TEST_P(Browser, ShowsTheValuesOfTheTables) {
  if (!there_is_a_browser()) GTEST_SKIP() << "there is no chromium here; apt-get install chromium";
  const Folder folder;
  write_run(folder.path(),
            read_scene(fs::path(PINTLE_SOURCE_DIR) / "examples" / GetParam(), {{"run.until", "20 ms"}, {"output.every", "0.1 ms"}}));
  std::ofstream(folder.path() / "report.html") << report_page(folder.path());
  const Json page = shown_by_browser(folder, folder.path() / "report.html");
  ASSERT_TRUE(page.is_object()) << "the page has told nothing";
  EXPECT_TRUE(page["errors"].empty()) << page["errors"];
  ASSERT_EQ(page["shown"].size(), 4U);

  const auto trajectory = plain_table(folder.path() / "trajectory.csv");
  std::size_t compared = 0;
  for (const Json& moment : page["shown"]) {
    const auto row = std::ranges::find_if(trajectory.rows, [&](const auto& r) { return r[0] == moment["t"].get<double>(); });
    ASSERT_NE(row, trajectory.rows.end()) << moment["t"];
    for (const Json& value : moment["values"]) {
      if (!value[0].is_string()) continue;  // a sum that stands in no table
      const auto column =
          std::ranges::find_if(trajectory.header, [&](const std::string& h) { return h.starts_with(value[0].get<std::string>() + " ["); });
      if (column == trajectory.header.end()) continue;  // of the ledger
      const double true_value = (*row)[static_cast<std::size_t>(column - trajectory.header.begin())];
      EXPECT_EQ(std::stod(value[2].get<std::string>()), true_value) << *column;
      EXPECT_NEAR(shown_number(value[1], *column), true_value, 6e-7 * std::abs(true_value)) << *column << " is shown as " << value[1];
      ++compared;
    }
  }
  EXPECT_GE(compared, 12U);
}
INSTANTIATE_TEST_SUITE_P(Report, Browser, testing::Values("slider_crank_clearance.yaml", "flexible_slider_crank.yaml"), [](const auto& i) {
  const std::string file = i.param;
  return file.substr(0, file.find('.'));
});

/// A plate with two bores is filled by its three outlines, not triangle by triangle, which takes ten times as long.
TEST(BrowserShows, FillsAMeshedBodyByItsOutlines) {
  if (!there_is_a_browser()) GTEST_SKIP() << "there is no chromium here; apt-get install chromium";
  const Folder folder;
  write_run(folder.path(), read_scene(fs::path(PINTLE_SOURCE_DIR) / "examples" / "four_bar_flexible.yaml", {{"run.until", "5 ms"}}));
  std::ofstream(folder.path() / "report.html") << report_page(folder.path());
  const Json page = shown_by_browser(folder, folder.path() / "report.html");
  ASSERT_TRUE(page.is_object()) << "the page has told nothing";
  EXPECT_TRUE(page["errors"].empty()) << page["errors"];
  EXPECT_EQ(page["outlines"], Json::array({0, 3, 0}));
}

/// Two gears, and two events that come at a quarter and three quarters of the run.
TEST(BrowserShows, WheelsAndStepsToTheEventsOfTheScene) {
  if (!there_is_a_browser()) GTEST_SKIP() << "there is no chromium here; apt-get install chromium";
  const Folder folder;
  write_run(folder.path(), read_scene_text(R"(
ground: {points: {A: [0, 0], B: [3, 0]}}
bodies:
  small: {rigid: {mass: 1, inertia: 1}, points: {O: [0, 0]}}
  large: {rigid: {mass: 1, inertia: 1}, points: {O: [0, 0]}, pose: {at: [3, 0]}}
joints: {a: {revolute: [ground.A, small.O]}, b: {revolute: [ground.B, large.O]}, mesh: {gear: [small.O, large.O], radii: [1, 2]}}
events: {early: {when: t > 0.05 s, do: {row: true}}, late: {when: t > 0.15 s, do: {row: true}}}
forces: {motor: {torque: 1, on: small}}
run: {until: 0.2 s}
output: {every: 10 ms}
)",
                                           "wheels.yaml"));
  std::ofstream(folder.path() / "report.html") << report_page(folder.path());
  const Json page = shown_by_browser(folder, folder.path() / "report.html");
  ASSERT_TRUE(page.is_object()) << "the page has told nothing";
  EXPECT_TRUE(page["errors"].empty()) << page["errors"];
  EXPECT_EQ(page["rims"], Json::array({true, true}));
  std::vector<Json> places{page["scrubber marks"]};
  for (const Json& plot : page["plot marks"]) places.push_back(plot);
  ASSERT_GE(places.size(), 2U);
  for (const Json& marks : places) {
    ASSERT_EQ(marks.size(), 2U) << page;
    EXPECT_EQ(marks[0][0].get<std::string>().find("early: wrote a row"), 0U) << marks[0];
    EXPECT_EQ(marks[1][0].get<std::string>().find("late: wrote a row"), 0U) << marks[1];
    EXPECT_NEAR(std::stod(marks[0][1].get<std::string>()), 25, 1e-6);
    EXPECT_NEAR(std::stod(marks[1][1].get<std::string>()), 75, 1e-6);
  }
  const double expected[] = {0.15, 0.05, 0.05, 0.15};  // from the end: back, back, back where there is no more, on
  ASSERT_EQ(page["steps"].size(), std::size(expected));
  for (std::size_t k = 0; k < std::size(expected); ++k) EXPECT_NEAR(page["steps"][k].get<double>(), expected[k], 1e-9) << k;
}

}  // namespace

}  // namespace pintle
