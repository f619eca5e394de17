// A run as one page: what is embedded equals the tables, nothing of a scene is taken for HTML, and every example makes one.
#include <algorithm>

#include "framework/analysis/kinematics/kinematics.h"
#include "framework/build/inertia_defaults.h"
#include "framework/drawing/palette.h"
#include "framework/report/page.h"
#include "framework/report/run_report.h"
#include "tests/refusal.h"
#include "tests/report/page_reading.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using pintle_report_test::between;
using pintle_report_test::data_of;
using pintle_report_test::Folder;
using pintle_report_test::Json;
using pintle_report_test::numbers;
using pintle_report_test::plain_table;
using pintle_report_test::text_of;
using pintle_report_test::write_run;
using pintle_test::expect_refused;

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t out = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++out;
  return out;
}

const std::string pendulum = R"(
title: pendulum
gravity: [0, -9.81]
bodies:
  rod: {rigid: {mass: 1 kg, inertia: 0.1 kg m^2}, points: {O: [-0.5, 0]}}
joints:
  pin: {revolute: [ground, rod.O]}
start: {rod: {at: [0.5, 0]}}
run: {until: 0.2 s}
output: {every: 10 ms}
)";

/// The test vectors of RFC 4648, section 10.
TEST(Page, Base64IsThatOfTheStandard) {
  const std::pair<const char*, const char*> known[] = {
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [text, coded] : known) EXPECT_EQ(base64(std::string_view(text)), coded);
}

TEST(Page, EveryNumberOfTheTablesIsInIt) {
  const Folder folder;
  write_run(folder.path(), read_scene_text(pendulum, "pendulum.yaml"));
  const Json data = data_of(report_page(folder.path()));
  EXPECT_EQ(data["title"], "pendulum");
  for (const std::string table : {"trajectory", "ledger"}) {
    const auto file = plain_table(folder.path() / (table + ".csv"));
    const Json& sheet = data[table]["sheets"][0];
    EXPECT_EQ(data[table]["rows"], file.rows.size());
    ASSERT_EQ(sheet["columns"].size() + 1, file.header.size());
    const auto column_is = [&](const Json& coded, std::size_t c) {
      const auto values = numbers<double>(coded);
      ASSERT_EQ(values.size(), file.rows.size());
      for (std::size_t r = 0; r < values.size(); ++r) EXPECT_EQ(values[r], file.rows[r][c]) << file.header[c];
    };
    column_is(sheet["t"], 0);
    for (std::size_t c = 1; c < file.header.size(); ++c) {
      const Json& column = sheet["columns"][c - 1];
      EXPECT_EQ(column["name"].get<std::string>() + " [" + column["unit"].get<std::string>() + "]", file.header[c]);
      column_is(column["values"], c);
    }
  }
}

TEST(Page, HasTheColoursAndTheOutputsOfTheScene) {
  const Folder folder;
  write_run(folder.path(),
            read_scene_text(pendulum + "outputs: {height: 1 m + rod.y}\n", "pendulum.yaml", {{"bodies.rod.colour", "steelblue"}}));
  const Json data = data_of(report_page(folder.path()));
  EXPECT_EQ(data["model"]["bodies"][0]["colour"], "rgb(70, 130, 180)");
  EXPECT_EQ(data["model"]["outputs"], Json::array({"height"}));
  const auto text = [](const Rgb& c) {
    return "rgb(" + std::to_string(c[0]) + ", " + std::to_string(c[1]) + ", " + std::to_string(c[2]) + ")";
  };
  const Json& palette = data["model"]["palette"];
  ASSERT_EQ(palette["bodies"].size(), body_palette.size());
  for (std::size_t b = 0; b < body_palette.size(); ++b) EXPECT_EQ(palette["bodies"][b], text(body_palette[b]));
  for (std::size_t k = 0; k < giver_names.size(); ++k) EXPECT_EQ(palette["givers"][giver_names[k]], text(arrow_palette[k]));
}

constexpr const char* wheels_and_events = R"(
ground: {points: {A: [0, 0], B: [3, 0]}}
bodies:
  small: {rigid: {mass: 1, inertia: 1}, points: {O: [0, 0]}}
  large: {rigid: {mass: 1, inertia: 1}, points: {O: [0, 0]}, pose: {at: [3, 0]}}
joints: {a: {revolute: [ground.A, small.O]}, b: {revolute: [ground.B, large.O]}, mesh: {gear: [small.O, large.O], radii: [1, 2]}}
events:
  early: {when: t > 0.05 s, do: {row: true}}
  late: {when: t > 0.15 s, do: {row: true}}
start: {small: {speed: 1}}
run: {until: 0.2 s}
output: {every: 10 ms}
)";

TEST(Page, HasTheWheelsOfTheMechanismAndWhatItsEventsDid) {
  const Folder folder;
  write_run(folder.path(), read_scene_text(wheels_and_events, "wheels.yaml"));
  const Json data = data_of(report_page(folder.path()));
  const Json& wheels = data["model"]["wheels"];
  ASSERT_EQ(wheels.size(), 2U);
  EXPECT_NEAR(wheels[0]["radius"].get<double>(), 1, 1e-12);
  EXPECT_NEAR(wheels[1]["radius"].get<double>(), 2, 1e-12);
  const auto body_of = [&](const Json& wheel) { return data["model"]["markers"][wheel["marker"].get<std::size_t>()]["body"].get<int>(); };
  EXPECT_EQ(body_of(wheels[0]), 0);
  EXPECT_EQ(body_of(wheels[1]), 1);
  const Json& rows = data["actions"]["rows"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0][0], "early");
  EXPECT_NEAR(rows[1][1].get<double>(), 0.15, 1e-9);
  EXPECT_EQ(rows[1][2], "wrote a row");
  folder.write("actions.csv", "event,t [s],did\nearly,soon,nothing\n");
  expect_refused<std::runtime_error>([&] { report_page(folder.path()); }, {"actions.csv:2: a time that should be a number is not one"});
  fs::remove(folder.path() / "actions.csv");
  EXPECT_FALSE(data_of(report_page(folder.path())).contains("actions"));
}

/// Names in a scene are letters and digits, but titles are free, and so are the files of a folder that a stranger has sent.
TEST(Page, NothingOfTheResultsIsTakenForHtml) {
  const Folder folder;
  const std::string attack = "</script><script>alert(1)</script><!--<img src=x onerror=alert(2)>";
  std::string hostile = pendulum;
  hostile.replace(hostile.find("title: pendulum"), 15, "title: \"" + attack + "\"");
  write_run(folder.path(), read_scene_text(hostile, "hostile.yaml"));
  Json run = Json::parse(text_of(folder.path() / "run.json"));
  run["warnings"] = Json::array({attack});
  run["reason"] = attack;
  run[attack] = attack;
  folder.write("run.json", run.dump());
  folder.write("events.csv", "joint,begin [s],end [s]\n" + attack + ",0,1\n");
  folder.write("actions.csv", "event,t [s],did\n" + attack + ",0," + attack + "\n");
  const std::string page = report_page(folder.path());
  EXPECT_EQ(count(page, "<script"), 2U);
  EXPECT_EQ(count(page, "</script"), 2U);
  EXPECT_EQ(count(page, "<img"), 0U);
  EXPECT_EQ(count(page, "<!--"), 0U);
  EXPECT_EQ(between(page, "<title>", "</title>"), html_text(attack));
  const Json data = data_of(page);
  EXPECT_EQ(data["title"], attack);
  EXPECT_EQ(data["run"]["warnings"][0], attack);
  EXPECT_EQ(data["events"]["rows"][0][0], attack);
}

/// Placeholders would be found in what is put in for others; there are none.
TEST(Page, NamesThatNoNetworkIsNeeded) {
  const std::string text = page("x", "{}");
  EXPECT_NE(text.find("default-src 'none'"), std::string::npos);
  for (const char* const loads : {" src=", "<link", "@import", "url("}) EXPECT_EQ(text.find(loads), std::string::npos) << loads;
}

/// A million rows of the pendulum's table: its page keeps the one row that stands out, and its size.
TEST(Page, AMillionRowsMakeFiveMegabytes) {
  const Folder folder;
  write_run(folder.path(), read_scene_text(pendulum, "pendulum.yaml"));
  constexpr int rows = 1'000'000, peak = 612'345;
  for (const char* const table : {"trajectory.csv", "ledger.csv"}) {
    const fs::path file = folder.path() / table;
    const std::size_t columns = plain_table(file).header.size();
    std::ifstream in(file);
    std::string heading, text;
    std::getline(in, heading);
    text = heading + "\n";
    for (int i = 0; i < rows; ++i) {
      text += std::to_string(i);
      for (std::size_t c = 1; c < columns; ++c) text += i == peak ? ",9" : (i + static_cast<int>(c)) % 7 ? ",1" : ",0";
      text += '\n';
    }
    folder.write(table, text);
  }
  const std::string page = report_page(folder.path());
  EXPECT_LT(page.size(), 5'000'000U);
  const Json data = data_of(page);
  EXPECT_EQ(data["trajectory"]["rows"], rows);
  for (const std::string table : {"trajectory", "ledger"})
    for (const Json& sheet : data[table]["sheets"]) {
      const auto t = numbers<double>(sheet["t"]), values = numbers<double>(sheet["columns"][0]["values"]);
      const auto found = std::ranges::max_element(values) - values.begin();
      EXPECT_EQ(values[static_cast<std::size_t>(found)], 9);
      EXPECT_EQ(t[static_cast<std::size_t>(found)], peak);
      EXPECT_GT(t.size(), 500U);
    }
}

TEST(Page, ResultsThatAreMissingOrOfAnotherSceneAreRefused) {
  const Folder folder;
  const auto refused = [&](const std::vector<std::string>& parts) {
    expect_refused<std::runtime_error>([&] { report_page(folder.path()); }, parts);
  };
  refused({folder.path().string() + ": contains no results", "`pintle run`"});
  expect_refused<ResultsError>([&] { report_page(folder.path() / "none"); }, {"none: contains no results", "there is no such folder"});
  write_run(folder.path(), read_scene_text(pendulum, "pendulum.yaml"));
  const std::string table = pintle_report_test::text_of(folder.path() / "trajectory.csv");
  folder.write("trajectory.csv", "t [s],rod.x [m]\n0,1\n");
  refused({"trajectory.csv:1: has no column \"rod.y\""});
  fs::remove(folder.path() / "trajectory.csv");
  refused({"trajectory.csv: cannot be read (No such file"});
  folder.write("trajectory.csv", table);
  fs::remove(folder.path() / "ledger.csv");
  refused({"ledger.csv: cannot be read"});
  folder.write("run.json", "{\"scene\": {");
  refused({"run.json: is not JSON at byte"});
  folder.write("run.json", "{\"scene\": null}");
  refused({"run.json: contains no scene"});
}

TEST(Page, ASweepIsATableWithItsFirstColumnsChosen) {
  const Folder folder;
  folder.write(
      "sweep.csv",
      "case,\"clearance, radial [m]\",law,peak [N],status,reason\n1,1e-5,hertz,120.5,finished,\n2,2e-5,hunt,,failed,\"too deep, at 3\"\n");
  folder.write("sweep.json", R"({"title": "<marquee>", "varied": ["clearance, radial"], "measures": {"peak [N]": {"least": 120.5}}})");
  const std::string page = report_page(folder.path());
  const Json data = data_of(page)["tables"][0];
  EXPECT_EQ(data["rows"], Json::parse(R"([[1,1e-5,"hertz",120.5,"finished",null],[2,2e-5,"hunt",null,"failed","too deep, at 3"]])"));
  EXPECT_EQ(data["columns"][1], (Json{{"name", "clearance, radial"}, {"unit", "m"}}));
  EXPECT_EQ(data["x"], "clearance, radial");
  EXPECT_EQ(data["y"], "peak");
  EXPECT_EQ(count(page, "<marquee>"), 0U);
}

/// Of a long table the rows in which a column is least or greatest stay.
TEST(Page, ALongSweepKeepsItsExtremes) {
  const Folder folder;
  std::string text = "case,peak [N]\n";
  for (int i = 0; i < 20'000; ++i) text += std::to_string(i) + (i == 777 ? ",9\n" : i == 15'001 ? ",-4\n" : ",1\n");
  folder.write("sweep.csv", text);
  folder.write("sweep.json", "{}");
  const Json data = data_of(report_page(folder.path()))["tables"][0];
  EXPECT_EQ(data["all"], 20'000);
  EXPECT_LE(data["rows"].size(), 5004U);
  const auto there = [&](const Json& row) { return std::find(data["rows"].begin(), data["rows"].end(), row) != data["rows"].end(); };
  EXPECT_TRUE(there({777, 9}));
  EXPECT_TRUE(there({15'001, -4}));
  EXPECT_TRUE(there({19'999, 1}));
}

std::vector<std::string> examples() {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(fs::path(PINTLE_SOURCE_DIR) / "examples"))
    if (entry.path().extension() == ".yaml" && read_scene(entry.path()).has_run) out.push_back(entry.path().stem().string());
  std::ranges::sort(out);
  return out;
}

class EveryExample : public testing::TestWithParam<std::string> {};

/// Its first moments; their page has a drawing of every body and all columns of the table.
TEST_P(EveryExample, MakesAPage) {
  const Folder folder;
  const Scene scene =
      read_scene(fs::path(PINTLE_SOURCE_DIR) / "examples" / (GetParam() + ".yaml"), {{"run.until", "1 ms"}, {"output.every", "0.5 ms"}});
  const bool moved_by_drivers =
      std::ranges::any_of(scene.bodies, [](const SceneBody& b) { return !b.elastic && !(b.mass > 0 && b.inertia > 0); });
  if (moved_by_drivers) {
    const Scene ready = ready_for_kinematics(scene);
    const Model model = build(ready);
    write_kinematics(folder.path(), ready, model, kinematics(ready, model, assemble(ready, model)));
  } else {
    write_run(folder.path(), scene);
  }
  const Json data = data_of(report_page(folder.path()));
  EXPECT_EQ(data["trajectory"]["rows"], 3);
  EXPECT_EQ(data.contains("ledger"), !moved_by_drivers);
  std::size_t columns = 0;
  for (const Json& sheet : data["trajectory"]["sheets"]) columns += sheet["columns"].size();
  EXPECT_EQ(columns + 1, plain_table(folder.path() / "trajectory.csv").header.size());
  for (const Json& body : data["model"]["bodies"])
    EXPECT_TRUE(!body["outline"].empty() || !body["profiles"].empty() || body.contains("mesh")) << body["name"];
}
INSTANTIATE_TEST_SUITE_P(Report, EveryExample, testing::ValuesIn(examples()), [](const auto& i) { return i.param; });

}  // namespace

}  // namespace pintle
