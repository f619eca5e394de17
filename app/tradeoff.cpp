// pintle tradeoff: the cost of accuracy, for one scene and the quantities that matter to its user.
#include "framework/study/tradeoff/tradeoff.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <new>

#include "app/options.h"
#include "app/progress.h"
#include "app/run_end.h"
#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/output/results.h"
#include "framework/plots/tradeoff_plot.h"
#include "framework/scene/text_file.h"
#include "framework/scene/yaml/yaml_node.h"
#include "framework/study/tradeoff/share_and_duration.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

struct Asked {
  CaseSource scene;
  std::vector<Measure> measures;
  TradePlan plan;
};

/// A study names a scene; a scene has bodies.
bool is_study(const fs::path& file) {
  constexpr std::size_t most_bytes = std::size_t{100} << 20;
  const Yaml tree = parse_yaml(read_text_file(file, most_bytes), file.string());
  return std::ranges::find(tree.items, "scene", &Yaml::key) != tree.items.end();
}

std::vector<Measure> asked_quantities(const Options& options) {
  std::vector<Measure> out;
  for (const std::string& words : options.quantities) {
    if (std::ranges::find(out, words, &Measure::words) != out.end())
      throw SceneError("--quantity \"" + words + "\": is given twice; remove one");
    out.emplace_back(Measure{words, words, Place{0, "--quantity"}, options.scene});
  }
  return out;
}

template <class Read>
void wanted(const std::string& option, const std::string& text, double& value, Read read) {
  if (text.empty()) return;
  try {
    value = read(text);
  } catch (const ExpressionError& e) {
    throw SceneError(option + " " + text + ": " + e.what());
  }
}

Asked understood(const Options& options) {
  Asked asked;
  const Overrides set = overrides(options);
  if (is_study(options.scene)) {
    StudyFile file = read_study(options.scene);
    if (!file.study.scene.situations.empty()) file.root().at("situations").fail("is a key of sweep, fit and sensitivity; remove it here");
    require_measures(file);
    file.study.scene.common.insert(file.study.scene.common.end(), set.begin(), set.end());
    asked.scene = file.study.scene;
    asked.measures = options.quantities.empty() ? file.study.measures : asked_quantities(options);
    const bool own = file.root().has("tradeoff") || file.root().has("sweep");
    asked.plan = own ? read_tradeoff(file) : suggested_plan(asked.scene);
    if (!file.study.title.empty()) asked.plan.title = file.study.title;
  } else {
    asked.scene = read_case_source(options.scene, set);
    if (options.quantities.empty())
      throw SceneError(options.scene +
                       ": no quantity is named; say what matters, for example --quantity \"peak force at JOINT\" or --quantity \"energy "
                       "lost\" (docs/studies.md)");
    asked.measures = asked_quantities(options);
    validate(asked.measures, common_scene(asked.scene));
    asked.plan = suggested_plan(asked.scene);
  }
  validate_measures(asked.scene, asked.plan, asked.measures);
  wanted("--error", options.wanted_error, asked.plan.error, read_share);
  wanted("--time", options.wanted_time, asked.plan.time, read_duration);
  wanted("--budget", options.budget, asked.plan.budget, read_duration);
  if (options.repeats > 0) asked.plan.repeats = options.repeats;
  if (asked.plan.title.empty()) asked.plan.title = fs::path(options.scene).stem().string();
  return asked;
}

}  // namespace

int tradeoff(const Options& options) {
  now_doing("reading the study");
  const Asked asked = understood(options);
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
    const CaseRunner run = [&](const Overrides& set, const std::vector<Measure>& measures, const CaseLimits& limits) {
      try {
        return run_case(asked.scene, set, measures, limits);
      } catch (const std::bad_alloc&) {
        Outcome none;
        none.status = "failed", none.reason = "there was not enough memory";
        none.values.assign(measures.size(), std::numeric_limits<double>::quiet_NaN()), none.units.resize(measures.size());
        return none;
      }
    };
    report = run_tradeoff(asked.plan, asked.measures, run, listener);
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
