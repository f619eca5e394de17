// Why a trade-off study recommends nothing.
#include <algorithm>
#include <cmath>

#include "framework/common/printed.h"
#include "framework/study/tradeoff/tradeoff_words.h"

namespace pintle {

namespace {

void say_remedy(const TradeReport& r, std::vector<std::string>& said) {
  const double asked = r.plan.error > 0 ? r.plan.error : useful_warning;
  std::string s, fine;
  bool chaotic = false;
  double ensembles = 0;
  for (std::size_t q = 0; q < r.quantities.size(); ++q) {
    const QuantityReference& x = r.reference.of[q];
    if (!x.constant && x.warning() <= asked) fine += (fine.empty() ? "" : ", ") + r.quantities[q];
    if (x.warning() <= asked || !x.chaotic) continue;
    chaotic = true;
    ensembles = std::max(ensembles, std::ceil(r.plan.ensemble * std::pow(1.5 * x.warning() / asked, 2)));
  }
  if (r.reference.short_of_time && r.plan.budget > 0) s = "more time: --budget " + duration_text(4 * r.plan.budget);
  if (chaotic && ensembles <= 100000)
    s += (s.empty() ? "" : "; ") + printed("larger ensembles (ensemble: %.0f in a study), each that much more expensive", ensembles);
  if (chaotic)
    s += (s.empty() ? "" : "; ") + std::string("a mean or rms over a longer time, or an earlier time, before the motions diverge");
  else
    s += (s.empty() ? "" : "; ") +
         std::string(
             "a quantity that depends less on details: a mean, an rms or an energy rather than a peak, or one taken over a "
             "longer time or before it becomes uncertain");
  if (!fine.empty()) s += "; or asking for " + fine + " only, which is known well enough";
  said.push_back("What would help: " + s + "." +
                 (r.reference.short_of_time || r.plan.budget <= 0 || chaotic
                      ? ""
                      : " A larger budget would not help: the limit is the refinement, not the time."));
}

}  // namespace

void say_unknown(const TradeReport& r, std::vector<std::string>& said) {
  const double asked = r.plan.error > 0 ? r.plan.error : useful_warning;
  std::string s;
  for (std::size_t q = 0; q < r.quantities.size(); ++q)
    if (const QuantityReference& x = r.reference.of[q]; !x.constant && x.warning() > asked)
      s += (s.empty() ? "" : ", ") + r.quantities[q] + " to " + percent_text(x.warning());
  said.push_back(
      "Nothing is recommended: the reference determines " + s + " only, and " +
      (r.plan.error > 0 ? "an error of " + percent_text(asked) + " was requested" : "advice needs " + percent_text(asked) + " or better") +
      ".");
  const auto misses = static_cast<std::size_t>(
      std::ranges::count_if(r.points, [&](const TradePoint& p) { return p.usable && verdict(p, asked) == Verdict::misses; }));
  if (misses > 0 && misses < r.ran())
    said.push_back(printed("Of the %s that ran, %zu certainly have a larger error than %s; for the others this is unknown.",
                           settings_text(r.ran()).c_str(), misses, percent_text(asked).c_str()));
  else
    said.push_back(misses == 0 ? "It is unknown for every setting that ran whether its error is smaller or larger."
                               : "All " + settings_text(r.ran()) + " that ran certainly have a larger error.");
  say_remedy(r, said);
}

void say_none_meets(const TradeReport& r, std::vector<std::string>& said) {
  double least = INFINITY, most = 0;
  std::vector<std::size_t> best, open;
  for (const TradePoint& p : r.points)
    if (p.usable) least = std::min(least, p.at_most());
  for (std::size_t i = 0; i < r.points.size(); ++i) {
    const TradePoint& p = r.points[i];
    if (p.usable && p.at_least() <= least) best.push_back(i), most = std::max(most, p.at_most());
    if (p.usable && verdict(p, r.plan.error) == Verdict::unknown) open.push_back(i);
  }
  said.push_back("Nothing is recommended: " + (r.ran() == r.listed() ? std::string("no setting") : "none" + of_how_many(r)) +
                 " is shown to have an error of at most " + percent_text(r.plan.error) + ".");
  if (best.size() == 1)
    said.push_back("The most accurate is " + setting_text(r.plan, r.points[best.front()]) + ", " + cost_text(r, best.front()) + ".");
  else
    said.push_back(printed("The %zu most accurate ones cannot be distinguished: the error of each is at most %s.", best.size(),
                           percent_text(most).c_str()));
  if (!open.empty())
    said.push_back(printed("For %s this is unknown, because the error of the reference itself may be %s.",
                           settings_text(open.size()).c_str(), percent_text(r.warning()).c_str()));
  said.push_back(std::string("What would help: ") +
                 (r.cut ? "more time, --budget " + duration_text(4 * r.plan.budget) + ", for the settings that did not run; or " : "") +
                 "finer values on the axes.");
}

void say_constant(const TradeReport& r, std::vector<std::string>& said) {
  for (std::size_t q = 0; q < r.quantities.size(); ++q) {
    const QuantityReference& x = r.reference.of[q];
    if (!x.constant) continue;
    const std::string value = x.value == 0 ? "0" : printed("%.6g", x.value) + (r.units[q].empty() ? "" : " " + r.units[q]);
    said.push_back(r.quantities[q] + " is " + value + " in every run, for any setting, so it cannot rank the settings" +
                   (r.tells() ? "; what follows is based on the others."
                              : ". Nothing is recommended; name a quantity whose value varies in this scene."));
  }
}

}  // namespace pintle
