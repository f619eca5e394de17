#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "files/files.h"
#include "framework/common/file_names.h"
#include "framework/common/nearest.h"
#include "framework/scene/units/table.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

std::string decimal(double value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << value;
  return out.str();
}

}  // namespace

double unit_factor(const Node& group, std::string_view key, const Dimension& expected) {
  if (!group.has(key)) return 1;
  const Node node = group.at(key);
  const std::string text = node.text("a unit such as ms or N m");
  try {
    const Quantity unit = read_quantity(text);
    if (!same(unit.dimension, expected) || (bare(unit.dimension) && !bare(expected)))
      node.fail("\"" + text + "\" measures " + describe(unit.dimension) + "; expected a unit of " + describe(expected));
    return unit.value;
  } catch (const ExpressionError&) {
    node.fail(node.shown() + " is not a unit; write one such as ms or N*m");
  }
}

namespace {

// The law as text that filled_in can convert back to keys: flow YAML, which is JSON.
std::string table_text(const std::string& file, bool linear, double time_unit, double value_unit, const Dimension& expected) {
  const auto escaped = [](const std::string& s) {
    std::string out;
    for (const char c : s) {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
    return out;
  };
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  out << "{\"table\": \"" << escaped(file) << "\", \"interpolation\": \"" << (linear ? "linear" : "spline") << "\"";
  if (time_unit != 1) out << ", \"time unit\": \"" << time_unit << " s\"";
  if (value_unit != 1) out << ", \"value unit\": \"" << value_unit << " " << si_unit(expected) << "\"";
  out << "}";
  return out.str();
}

void must_cover(const Node& node, const std::string& file, const Samples& samples, double until) {
  const double begin = samples.t.front(), end = samples.t.back();
  if (begin <= 0 && end >= until * (1 - 1e-12)) return;
  node.fail("the table " + file + " runs from " + decimal(begin) + " s to " + decimal(end) + " s, but the run from 0 to " + decimal(until) +
            " s; lengthen the table or shorten run.until");
}

Law read_table_law(const Node& node, const Dimension& expected, Smoothness smoothness, const std::filesystem::path& folder, double until) {
  const bool driver = smoothness == Smoothness::driver;
  const char* keys = driver ? "drivers.*.law" : "forces.*.torque";
  if (driver) check_keys(node, keys);
  const std::string file = node.at("table").file("the name of a file beside the scene");
  bool linear = false;
  if (node.has("interpolation")) {
    const Node choice = node.at("interpolation");
    linear = choice.one_of(choices(keys, "interpolation")) == "linear";
    if (linear && driver) choice.fail("\"linear\" makes the speed of a driver jump; write spline");
  }
  const double time_unit = unit_factor(node, "time unit", dimension::time);
  const double value_unit = unit_factor(node, "value unit", expected);
  Samples samples = read_samples(table_file(node, folder), time_unit, value_unit, node.place().key);
  must_cover(node, file, samples, until);
  const std::string text = table_text(file, linear, time_unit, value_unit, expected);
  if (linear) return {Polyline(std::move(samples)), text, false};
  return {Spline(std::move(samples)), text, false};
}

}  // namespace

std::filesystem::path table_file(const Node& node, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const Node named = node.at("table");
  const std::string file = named.file("the name of a file beside the scene");
  fs::path path;
  try {
    path = contained_file(file, folder);
  } catch (const FileRejected& rejected) {
    named.fail(rejected.what());
  }
  std::error_code error;
  if (fs::exists(path, error)) return path;  // other errors are reported where it is read
  std::vector<std::string> beside;
  const fs::path place = path.has_parent_path() ? path.parent_path() : ".";
  for (auto entry = fs::directory_iterator(place, error); !error && entry != fs::directory_iterator(); entry.increment(error))
    if (ending_of(entry->path()) == ending_of(path)) beside.push_back(entry->path().filename().string());
  std::ranges::sort(beside);  // the order of directory entries is undefined
  const std::string near = nearest(path.filename().string(), beside);
  named.fail("\"" + file + "\": there is no such file; check the path" +
             (near.empty() ? "" : ". Did you mean \"" + (fs::path(file).parent_path() / near).string() + "\"?"));
}

void must_be_finite(const Node& node, const Law& law, Smoothness smoothness, double until) {
  constexpr int looks = 64;
  for (int i = 0; i <= looks; ++i) {
    const double t = until * i / looks;
    const Jet jet = law.at(t);
    if (!std::isfinite(jet.value))
      node.fail(node.shown() + " is not a finite number at t = " + decimal(t) + " s; it must be from 0 to run.until");
    if (smoothness == Smoothness::driver && !(std::isfinite(jet.rate) && std::isfinite(jet.accel)))
      node.fail(node.shown() + " has no finite speed and acceleration at t = " + decimal(t) + " s; a driver needs both");
  }
}

std::string checked_name(const Node& node) {
  std::string name = node.name();
  const bool bad_end = name.empty() || name.front() == ' ' || name.back() == ' ';
  if (bad_end || name.size() > 80 || name.find_first_of(".,;\"'[]{}/\\\n\r\t") != std::string::npos)
    node.fail("\"" + name + "\" cannot be a name; use letters, digits, spaces, - and _, at most 80");
  return name;
}

PointRef read_point_ref(const Node& node) {
  const std::string remedy = "a point such as crank.A, or a body such as ground", text = node.text(remedy);
  PartName name = node.part(remedy);
  PointRef ref{std::move(name.part), std::move(name.point), node.place()};
  if (ref.body.empty() || text.back() == '.' || ref.point.find('.') != std::string::npos)
    node.fail(node.shown() + " is not a point; write body.point such as crank.A, or a body");
  return ref;
}

void check_own_point(const Node& node, const std::string& name, const SceneBody& body) {
  std::vector<std::string> known;
  for (const ScenePoint& p : body.points) known.push_back(p.name);
  if (known.empty()) node.fail("\"" + name + "\" is not a point: " + body.name + " has none; add points: {" + name + ": [0, 0]}");
  if (std::ranges::find(known, name) == known.end()) node.fail(body.name + " has no point \"" + name + "\"." + did_you_mean(name, known));
}

std::string read_own_point(const Node& node, const SceneBody& body) {
  std::string name = node.text("the name of a point of the body");
  check_own_point(node, name, body);
  return name;
}

std::vector<double> read_quantities(const Node& node, std::size_t n, const Dimension& expected, Rule must, const std::string& remedy) {
  std::vector<double> out;
  for (const Node& item : node.items(n, remedy)) out.push_back(item.quantity(expected, must));
  return out;
}

std::pair<PointRef, PointRef> read_ends(const Node& node, const std::string& remedy) {
  const auto two = node.items(2, remedy);
  return {read_point_ref(two[0]), read_point_ref(two[1])};
}

Law read_time_law(const Node& node, const Dimension& expected, Smoothness smoothness, const std::filesystem::path& folder, double until) {
  Law law = node.is_map() ? read_table_law(node, expected, smoothness, folder, until) : node.law(expected);
  must_be_finite(node, law, smoothness, until);
  return law;
}

void read_optional(const Node& group, std::string_view key, const Dimension& expected, Rule must, double& value) {
  if (group.has(key)) value = group.at(key).quantity(expected, must);
}

}  // namespace pintle
