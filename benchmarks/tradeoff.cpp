// Trades error against time in four mechanisms and writes docs/tradeoff.md and docs/tradeoff/*.svg: the results of
//   pintle tradeoff examples/studies/trade_*.yaml
// on one page.
//   tradeoff_page                 the unchanged studies: some minutes; use an idle machine
//   tradeoff_page --budget 20     each study within this many seconds, for a preview
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <iostream>

#include "framework/common/file.h"
#include "framework/common/printed.h"
#include "framework/common/text.h"
#include "framework/plots/tradeoff_plot.h"
#include "framework/scene/units/expression.h"
#include "framework/study/tradeoff/tradeoff.h"
#include "framework/study/tradeoff/tradeoff_words.h"

namespace {

using namespace pintle;
namespace fs = std::filesystem;

const fs::path source = PINTLE_SOURCE_DIR;

struct Mechanism {
  std::string name, sentence;  ///< what the mechanism is and what is asked of it
};
const std::vector<Mechanism> sections{
    {"rigid_clearance",
     "The paper's slider-crank of rigid bodies, crank free from 150 rad/s, clearance 0.1 mm at the gudgeon pin, 50 ms. Axes: tolerance, "
     "scheme, model of the clearance."},
    {"flexible_clearance",
     "The paper's slider-crank with a coupler that bends, clearance 0.01 mm, 20 ms. Axes: tolerance, scheme, modes of the coupler. The "
     "reference doubles the modes of the finest twice."},
    {"meshed_four_bar",
     "A driven four-bar whose coupler is a plate meshed by Gmsh, 0.25 s. Axes: tolerance, scheme, size of the mesh, modes of the coupler. "
     "Time includes meshing and reduction. The reference doubles modes and halves elements twice."},
    {"chain_200",
     "Two hundred rigid links hung at one end, let go from a slant, 1 s. Axes: tolerance, scheme, how the constraints are met."}};

TradeReport report_of(const Mechanism& section, double budget) {
  const StudyFile file = read_study("examples/studies/trade_" + section.name + ".yaml");
  TradePlan plan = read_tradeoff(file);
  if (budget > 0) plan.budget = budget;
  TradeListener listener;
  if (::isatty(STDERR_FILENO))
    listener.progress = [&](const std::string& what, double share) {
      std::cerr << "\r  " << section.name << ": " << what << " " << static_cast<int>(100 * share) << " %\033[K" << std::flush;
    };
  TradeReport r = run_tradeoff(
      plan, file.study.measures,
      [&](const Overrides& set, const std::vector<Measure>& m, const CaseLimits& l) { return run_case(file.study.scene, set, m, l); },
      listener);
  std::cerr << (::isatty(STDERR_FILENO) ? "\r\033[K  " : "  ") << section.name << ": " << static_cast<int>(r.seconds) << " s\n";
  return r;
}

std::string headline(const Mechanism& section, const TradeReport& r) {
  std::string anchor;
  for (const char c : r.plan.title) anchor += c == ' ' ? '-' : static_cast<char>(std::tolower(c));
  std::string row = "| [" + r.plan.title + "](#" + anchor + ") | " + (r.plan.error > 0 ? percent_text(r.plan.error) : "–") + " | ";
  if (!r.recommended) return row + "none | – | – | – |\n";
  const TradePoint &p = r.points[*r.recommended], &as_is = r.points.front();
  return row + setting_text(r.plan, p) + " | " + time_text(p.time) + " | " + error_text(p) + " | " +
         (as_is.usable ? time_text(as_is.time) + ", " + error_text(as_is) : as_is.status) + " | [trade_" + section.name +
         ".yaml](../examples/studies/trade_" + section.name + ".yaml) |\n";
}

}  // namespace

int main(int count, char** words) {
  const double budget = count > 2 && std::strcmp(words[1], "--budget") == 0 ? std::stod(words[2]) : 0;
  try {
    std::string table, body;
    double seconds = 0;
    fs::current_path(source);  // messages then name files as a reader of the page would
    fs::create_directories("docs/tradeoff");
    for (const Mechanism& section : sections) {
      const TradeReport r = report_of(section, budget);
      seconds += r.seconds;
      table += headline(section, r);
      const std::string figure = "tradeoff/" + section.name + ".svg";
      write_text(fs::path("docs") / figure, tradeoff_svg(r));
      std::string text = tradeoff_markdown(r, figure, "##");
      const std::size_t after = text.find("\n\n") + 2;
      body += text.substr(0, after) + section.sentence + "\n\n" + text.substr(after);
    }
    write_text("docs/tradeoff.md",
               "# Error against time, in four mechanisms\n\n"
               "What `pintle tradeoff` says of four studies: how much time an error costs, which setting to take, and what limits it. This "
               "page is written by the program "
               "`tradeoff_page` (benchmarks/tradeoff.cpp), words and advice included; the same for one study: `pintle tradeoff "
               "examples/studies/trade_rigid_clearance.yaml`. "
               "[Studies](studies.md#trade-offs) explains the terms.\n\n"
               "- **Time** is of reading, building and running, files excluded: median of repeated runs, one at a time, all settings turn "
               "about. It is of one machine on one day; ratios carry over.\n"
               "- **Error** is relative, of the worst of the study's quantities, against a reference that was refined until it stood "
               "still. What the reference itself may err by stands beside every error, "
               "and none below it is claimed.\n" +
                   printed("- Written in %.0f s of computing.\n\n", seconds) +
                   "| mechanism | error wanted | cheapest setting for it | time | error | the scene as it stands | study "
                   "|\n|---|---|---|---|---|---|---|\n" +
                   table + "\n" + body);
    return 0;
  } catch (const std::exception& e) {
    std::cerr << "tradeoff_page: " << e.what() << "\n";
    return 1;
  }
}
