// pintle tradeoff: the cost of accuracy, for one scene and chosen quantities.
#include "framework/study/tradeoff/tradeoff_question.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "app/options.h"
#include "app/progress.h"
#include "app/run_end.h"
#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/output/results.h"
#include "framework/plots/tradeoff_plot.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

TradeWishes wishes(const Options& options) {
  return {options.quantities, options.wanted_error, options.wanted_time, options.budget, options.repeats};
}

}  // namespace

int tradeoff(const Options& options) {
  now_doing("reading the study");
  const TradeQuestion asked = read_trade_question(options.scene, wishes(options), overrides(options));
  const fs::path out = results_directory(options, "-tradeoff");
  require_place(out);
  const fs::path page = options.markdown, picture = fs::path(page).replace_extension(".svg");
  for (const fs::path& file : {page, picture})
    if (!page.empty()) require_file_place(file);
  now_doing("running the settings");
  TradeReport report;
  {
    StatusLine line(options.quiet || options.json);
    TradeListener listener;
    listener.progress = [&](const std::string& what, double share) {
      if (line.due()) line.show(what + " " + std::to_string(std::lround(100 * std::min(share, 1.0))) + " %");
    };
    listener.go_on = [] { return !asked_to_stop(); };
    report = run_tradeoff(asked, listener);
  }
  write_whole(options, out, [&](const fs::path& folder) {
    write_tradeoff(folder, out, asked.scene, report);
    write_text(folder / "tradeoff.svg", tradeoff_svg(report));
  });
  if (!options.markdown.empty()) {
    write_synced(picture, tradeoff_svg(report));
    write_synced(page, tradeoff_markdown(report, picture.filename().string()));
  }
  if (options.json)
    std::cout << tradeoff_json(report);
  else if (!options.quiet) {
    std::cout << tradeoff_text(report);
    print_rows(std::cout, {{"spent", number(report.seconds, 3) + " s"},
                           {"results", out.string() + (report.recommended ? ", ready to run: " + (out / "recommended.yaml").string()
                                                                          : "; no recommended.yaml, because nothing is recommended")}});
  }
  if (report.stopped) std::cerr << options.scene << ": " << stopped_by() << "; what was measured until then is in " << out.string() << "\n";
  if (report.stopped) return stopped;
  return report.recommended ? ok : run_failed;
}

}  // namespace pintle::app
