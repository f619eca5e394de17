// The three models of the clearance on the paper's clearances: what each costs, and what it gets wrong.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "tests/paper/page.h"

namespace paper {
namespace {

struct Modelled {
  Run run = {};
  double peak = 0;            ///< joint force [N]
  double lost = 0;            ///< [J]
  double carried = 0;         ///< root mean square of the joint force [N]
  Vector x = {}, speed = {};  ///< slider [m], crank [rad/s]
  double pushed = 0;          ///< share of the outputs
  double seconds = 0;         ///< least of several runs
};

/// Least and greatest of what the cases show.
struct Range {
  double least = 1e300, most = -1e300;
  void see(double x) { least = std::min(least, x), most = std::max(most, x); }
};

const std::array models{ClearanceModel::contact, ClearanceModel::massless_link, ClearanceModel::spring_damper};

Modelled with_model(const std::string& scene, ClearanceModel model, int repeats) {
  const auto once = [&] {
    return run(scene, [&](Scene& s) {
      clearance(s).model = model;
      output(5e-5)(s);
      s.output.frames = 0;
    });
  };
  Modelled m{.run = once()};
  m.seconds = m.run.seconds;
  for (int i = 1; i < repeats; ++i) m.seconds = std::min(m.seconds, once().seconds);
  const Vector force = column(m.run, pin + "normal [N]");
  m.peak = largest(force);
  for (const Impact& i : m.run.impacts) m.peak = std::max(m.peak, i.peak_force);
  double squares = 0;
  for (const double N : force) squares += N * N;
  m.carried = std::sqrt(squares / static_cast<double>(force.size()));
  m.lost = m.run.last.lost;
  m.x = column(m.run, "slider.x [m]");
  m.speed = column(m.run, "crank.speed [rad/s]");
  m.pushed = static_cast<double>(std::ranges::count_if(force, [](double N) { return N < 0; })) / static_cast<double>(force.size());
  return m;
}

double farthest(const Vector& a, const Vector& b) {
  double m = 0;
  for (std::size_t i = 0; i < a.size(); ++i) m = std::max(m, std::abs(a[i] - b[i]));
  return m;
}

}  // namespace

void clearance_models(Page& page) {
  page.text << "## Three models of the clearance\n\n"
               "The paper names three (§1, §3) and takes the third: the massless link, the spring–damper, and the momentum exchange with "
               "continuous contact. Here its cases without friction (Figs. 4 and 5) by each, from 150 rad/s over 50 ms, tolerance 1e-11; "
               "one word changes "
               "the model: `--set \"joints.gudgeon pin.clearance.model=massless link\"`. The spring and the damper are those that the "
               "scene's contact law gives ([theory](theory/contact.md#two-simpler-models)). *Away* is the greatest distance from the "
               "contact's run at one time. Times are the "
               "least of three runs, as ratios.\n\n"
               "| clearance, model | evaluations | steps | time | contacts begun | peak joint force | rms joint force | lost | slider away "
               "| crank speed away | link pushes |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|\n";
  Range link_cost, link_peak, link_pushed, link_away, spring_cost, spring_peak, spring_lost, spring_away, begun;
  for (const auto& [scene, radial] :
       {std::pair{"fig05_clearance_001", 1e-5}, std::pair{"fig05_clearance_010", 1e-4}, std::pair{"fig05_clearance_050", 5e-4}}) {
    const Modelled contact = with_model(scene, models[0], 3);
    for (const ClearanceModel model : models) {
      const Modelled m = model == ClearanceModel::contact ? contact : with_model(scene, model, 3);
      const double cost = static_cast<double>(m.run.counts.evaluations) / static_cast<double>(contact.run.counts.evaluations);
      const double away = farthest(m.x, contact.x);
      const bool is_link = model == ClearanceModel::massless_link;
      page.text << printed("| %.2f mm, %s | %ld | %ld | %.2f | %zu | %.0f N | %.1f N | %.3f mJ | %.1f µm | %.3g rad/s | %s |\n",
                           1e3 * radial, model_name(model), m.run.counts.evaluations, m.run.counts.steps, m.seconds / contact.seconds,
                           m.run.impacts.size(), m.peak, m.carried, 1e3 * m.lost, 1e6 * away, farthest(m.speed, contact.speed),
                           is_link ? printed("%.1f %%", 100 * m.pushed).c_str() : "");
      if (is_link) {
        link_cost.see(cost), link_peak.see(100 * m.peak / contact.peak), link_pushed.see(100 * m.pushed), link_away.see(away / radial);
      } else if (model == ClearanceModel::spring_damper) {
        spring_cost.see(cost), spring_peak.see(100 * m.peak / contact.peak), spring_lost.see(100 * m.lost / contact.lost),
            spring_away.see(away / radial);
      } else {
        begun.see(static_cast<double>(m.run.impacts.size()));
      }
    }
  }
  page.text << printed(
                   "\nThe massless link takes %.2f to %.2f of the contact's evaluations. It leaves out impacts: it shows %.0f to %.0f %% "
                   "of the peak force, loses "
                   "nothing, and as the crank keeps what impacts would take, the slider comes to be %.1f to %.1f clearances away. ",
                   link_cost.least, link_cost.most, link_peak.least, link_peak.most, link_away.least, link_away.most)
            << (link_pushed.most > 0
                    ? printed("It pushed in up to %.1f %% of the outputs, where a journal would have left the wall.\n\n", link_pushed.most)
                    : printed("It never pushed: by its own force no contact would be lost, while the contact model, which starts in the "
                              "middle of the "
                              "clearance, began %.0f to %.0f contacts.\n\n",
                              begun.least, begun.most))
            << printed(
                   "The spring–damper takes %.2f to %.2f of the evaluations%s. It shows %.0f to %.0f %% of the peak force and %.0f to %.0f "
                   "%% of the loss; the "
                   "slider comes to be %.1f to %.1f clearances away. Its force begins and ends with a corner, and its stiffness does not "
                   "grow with the depth: the hardest impacts, which "
                   "make the peak, meet a spring matched to typical ones.\n\n",
                   spring_cost.least, spring_cost.most, spring_cost.least > 1 ? ", so it saves nothing" : "", spring_peak.least,
                   spring_peak.most, spring_lost.least, spring_lost.most, spring_away.least, spring_away.most);
}

int check_models() {
  int wrong = 0;
  for (const ClearanceModel model : models) {
    const Run r = run("fig05_clearance_010", [&](Scene& s) {
      clearance(s).model = model;
      output(1e-4, 0.02, 1e-9)(s);
    });
    const bool fine = r.status == Status::finished && std::abs(r.worst_unexplained) < 1e-7 * energy(r.first) &&
                      (r.last.lost > 0) == (model != ClearanceModel::massless_link);
    std::cout << (fine ? "ok    " : "FALSE ") << "fig05_clearance_010 by " << model_name(model) << ": " << status_text(r.status)
              << ", loses " << 1e3 * r.last.lost << " mJ\n";
    wrong += !fine;
  }
  return wrong;
}

}  // namespace paper
