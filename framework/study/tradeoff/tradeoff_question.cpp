#include "framework/study/tradeoff/tradeoff_question.h"

#include <algorithm>
#include <limits>
#include <new>

#include "framework/scene/text_file.h"
#include "framework/scene/yaml/yaml_node.h"
#include "framework/study/tradeoff/share_and_duration.h"

namespace pintle {

namespace {

/// Whether a file is a study, which names a scene, and not a scene, which has bodies.
bool names_a_scene(const std::filesystem::path& file) {
  constexpr std::size_t most_bytes = std::size_t{100} << 20;
  const Yaml tree = parse_yaml(read_text_file(file, most_bytes), file.string());
  return std::ranges::find(tree.items, "scene", &Yaml::key) != tree.items.end();
}

std::vector<Measure> wanted_quantities(const std::filesystem::path& file, const TradeWishes& wishes) {
  const std::string option = wishes.dashes + "quantity";
  std::vector<Measure> out;
  for (const std::string& quantity : wishes.quantities) {
    if (std::ranges::find(out, quantity, &Measure::words) != out.end())
      throw SceneError(option + " \"" + quantity + "\": is given twice; remove one");
    out.emplace_back(Measure{quantity, quantity, Place{0, option}, file.string()});
  }
  return out;
}

template <class Read>
void apply_wish(const std::string& option, const std::string& text, double& value, Read read) {
  if (text.empty()) return;
  try {
    value = read(text);
  } catch (const ExpressionError& e) {
    throw SceneError(option + " " + text + ": " + e.what());
  }
}

TradeQuestion of_study(const std::filesystem::path& path, const TradeWishes& wishes, const Overrides& set) {
  StudyFile file = read_study(path);
  if (!file.study.scene.situations.empty()) file.root().at("situations").fail("is a key of sweep, fit and sensitivity; remove it here");
  require_measures(file);
  TradeQuestion out;
  out.scene = file.study.scene;
  out.scene.common.insert(out.scene.common.end(), set.begin(), set.end());
  file.study.scene = out.scene;
  out.measures = wishes.quantities.empty() ? file.study.measures : wanted_quantities(path, wishes);
  const bool own = file.root().has("tradeoff") || file.root().has("sweep");
  out.plan = own ? read_tradeoff(file) : suggested_plan(out.scene);
  if (!file.study.title.empty()) out.plan.title = file.study.title;
  return out;
}

TradeQuestion of_scene(const std::filesystem::path& path, const TradeWishes& wishes, const Overrides& set) {
  TradeQuestion out;
  out.scene = read_case_source(path, set);
  if (wishes.quantities.empty())
    throw SceneError(path.string() + ": no quantity is named; say what matters, for example " + wishes.dashes +
                     "quantity \"peak force at JOINT\" or " + wishes.dashes + "quantity \"energy lost\" (docs/studies.md)");
  out.measures = wanted_quantities(path, wishes);
  validate(out.measures, common_scene(out.scene));
  out.plan = suggested_plan(out.scene);
  return out;
}

}  // namespace

TradeQuestion read_trade_question(const std::filesystem::path& path, const TradeWishes& wishes, const Overrides& set) {
  TradeQuestion out = names_a_scene(path) ? of_study(path, wishes, set) : of_scene(path, wishes, set);
  validate_measures(out.scene, out.plan, out.measures);
  apply_wish(wishes.dashes + "error", wishes.error, out.plan.error, read_share);
  apply_wish(wishes.dashes + "time", wishes.time, out.plan.time, read_duration);
  apply_wish(wishes.dashes + "budget", wishes.budget, out.plan.budget, read_duration);
  if (wishes.repeats > 0) out.plan.repeats = wishes.repeats;
  if (out.plan.title.empty()) out.plan.title = path.stem().string();
  return out;
}

TradeReport run_tradeoff(const TradeQuestion& question, const TradeListener& listener) {
  const CaseRunner run = [&](const Overrides& set, const std::vector<Measure>& measures, const CaseLimits& limits) {
    try {
      return run_case(question.scene, set, measures, limits);
    } catch (const std::bad_alloc&) {
      Outcome none;
      none.status = "failed", none.reason = "there was not enough memory";
      none.values.assign(measures.size(), std::numeric_limits<double>::quiet_NaN()), none.units.resize(measures.size());
      return none;
    }
  };
  return run_tradeoff(question.plan, question.measures, run, listener);
}

}  // namespace pintle
