// Plots of result columns: in the terminal, or as a picture.
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include "app/cairo_pen.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/waiting.h"
#include "app/run_end.h"
#include "framework/common/file.h"
#include "framework/common/file_names.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/output/results_directory.h"
#include "framework/plots/plot.h"
#include "framework/plots/terminal_plot.h"
#include "framework/report/description.h"
#include "framework/report/sheets.h"
#include "framework/scene/units/signal_words.h"
#include "framework/scene/yaml/reader.h"
#include "meshes/module.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

/// A column of a table, with its own times.
struct PlottedColumn {
  ColumnName name;
  std::vector<double> t, values;
  std::string heading() const { return name.name + (name.unit.empty() ? "" : " [" + name.unit + "]"); }
};

/// The tables in a folder whose first column is a time.
std::vector<fs::path> tables_in(const fs::path& directory) {
  if (!fs::is_directory(directory)) throw ResultsError(directory.string() + ": " + no_such_folder(directory));
  std::vector<fs::path> out;
  for (const char* const name : {"trajectory.csv", "ledger.csv"})
    if (fs::exists(directory / name)) out.push_back(directory / name);
  const std::string why = time_of_last_row(directory) ? "" : why_without("rows over time", directory);
  if (!why.empty()) throw ResultsError(directory.string() + ": has nothing to plot: " + why);
  if (out.empty())
    throw ResultsError(directory.string() + ": holds neither trajectory.csv nor ledger.csv; name a folder that `pintle run` has written");
  return out;
}

/// Signals of the scene of a run; none if it can no longer be read.
std::vector<std::string> signals_of(const fs::path& directory) {
  std::vector<std::string> out;
  try {
    const std::optional<Description> run = description(directory, "run");
    if (!run) return out;
    const std::string file = run->json.value("file", std::string());
    for (const auto& [name, word] : signal_words(read_scene_text(run->json["scene"].dump(), file, {}, fs::path(file).parent_path())))
      if (word.what != SignalWord::column) out.push_back(name);
  } catch (const std::runtime_error&) {
  } catch (const nlohmann::json::exception&) {
  }
  return out;
}

[[noreturn]] void refuse_column(const fs::path& directory, const std::string& name, const std::vector<std::string>& known) {
  const std::vector<std::string> signals = signals_of(directory);
  std::vector<std::string> all = known;
  all.insert(all.end(), signals.begin(), signals.end());
  const bool is_signal = std::ranges::find(signals, name) != signals.end();
  const std::string near = is_signal ? name : nearest(name, all);
  std::string message = directory.string() + ": has no column " + pintle::quoted(name);
  if (near.empty())
    throw SceneError(message + "." + did_you_mean(name, known) + " The first line of trajectory.csv and of ledger.csv names them all");
  if (!is_signal) message += "; did you mean " + pintle::quoted(near) + "?";
  if (std::ranges::find(known, near) != known.end()) throw SceneError(message);
  std::string label = near;
  std::ranges::replace(label, '.', ' ');
  throw SceneError(message + (is_signal ? ", which is" : " That is") + " a signal of its scene; to write it as a column, add `outputs: {" +
                   label + ": " + near + "}` to the scene and run it again");
}

/// The table with a column of this name, with or without its unit.
fs::path table_with(const std::vector<fs::path>& tables, std::string& name) {
  std::vector<std::string> known;
  for (const fs::path& table : tables) {
    const CsvReader file(table);
    for (const std::string& heading : file.header()) {
      known.push_back(column_name(heading).name);
      if (name != heading && name != known.back()) continue;
      name = known.back();
      return table;
    }
  }
  refuse_column(tables.front().parent_path(), name, known);
}

/// @param evenly  true: at evenly spaced rows, so that columns have the same times; false: the extremes of each interval
PlottedColumn read_column(const fs::path& table, const std::string& name, bool evenly, const WorkShare& work) {
  constexpr std::size_t points = 4000;
  const std::size_t columns = CsvReader(table).header().size();
  const ReducedTable reduced = reduced_by_column(table, {2 * points * columns, 2 * points}, {name}, work);
  const auto found_in = [&](const Sheet& sheet) -> std::optional<PlottedColumn> {
    for (std::size_t c = 0; c < sheet.columns.size(); ++c)
      if (sheet.columns[c].name == name) return PlottedColumn{sheet.columns[c], sheet.t, sheet.values[c]};
    if (name == "t") return PlottedColumn{{"t", "s"}, sheet.t, sheet.t};
    return {};
  };
  if (evenly && !reduced.whole) return found_in(reduced.poses).value();
  for (const Sheet& sheet : reduced.sheets)
    if (auto found = found_in(sheet)) return *found;
  throw ResultsError(table.string() + ": has no column " + pintle::quoted(name));
}

/// One panel per column for the terminal; one per unit for a picture.
std::vector<Panel> panels_of(const Options& options, bool one_each) {
  const std::vector<fs::path> tables = tables_in(without_slash(options.scene));
  std::string against = options.against.empty() ? "t" : options.against;
  const Waiting waiting(options.quiet);
  double read = 0;
  const auto part = [&read, all = 1.0 + static_cast<double>(options.quantities.size())] {
    const double before = read++;
    return WorkShare{before / all, read / all};
  };
  const PlottedColumn x = read_column(table_with(tables, against), against, true, part());
  std::vector<Panel> out;
  std::map<std::string, std::size_t> of_unit;
  for (std::string name : options.quantities) {
    const fs::path table = table_with(tables, name);
    const PlottedColumn y = read_column(table, name, against != "t", part());
    if (against != "t" && y.t != x.t)
      throw SceneError("--against " + against + ": is in another table than " + pintle::quoted(name) +
                       ", with other rows; name one of the same");
    const std::string unit = one_each ? std::to_string(out.size()) : y.name.unit;
    if (!of_unit.contains(unit)) {
      of_unit[unit] = out.size();
      out.push_back({.title = y.heading(),
                     .x_label = x.heading(),
                     .y_label = "[" + y.name.unit + "]",
                     .curves = {},
                     .equal = against != "t" && y.name.unit == x.name.unit});
    }
    Panel& panel = out[of_unit[unit]];
    if (!panel.curves.empty()) panel.title.clear();
    panel.curves.push_back({.label = y.heading(), .x = against == "t" ? y.t : x.values, .y = y.values});
  }
  return out;
}

int terminal_columns() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? std::clamp<int>(size.ws_col, 40, 200) : 100;
}

std::string drawn(const std::vector<Panel>& panels, const std::string& ending) {
  if (ending == ".svg") return svg(panels);
#ifdef PINTLE_WITH_CAIRO
  const auto& cairo = module_table<CairoTable>("cairo");
  const std::unique_ptr<PlotPen> pen(ending == ".pdf" ? cairo.pdf() : cairo.png());
  return picture(*pen, panels);
#else
  throw SceneError("plots are written as " + ending +
                   " by cairo, which this program was built without: write .svg, or install libcairo2-dev and configure again");
#endif
}

}  // namespace

int plot(const Options& options) {
  now_doing("reading the results");
  is_lost_if_stopped("nothing was plotted");
  tell_if_unfinished(options.scene);
  if (options.out.empty()) {
    for (const Panel& panel : panels_of(options, true)) std::cout << terminal_plot(panel, terminal_columns(), 19);
    return ok;
  }
  const fs::path file = options.out;
  require_file_place(file);
  write_text(file, drawn(panels_of(options, false), ending_of(file)));
  if (!options.quiet) std::cout << "  " << file.string() << "\n";
  return ok;
}

}  // namespace pintle::app
