#include "framework/analysis/simulate/energy_balance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "framework/common/text.h"
#include "framework/integration/implicit/alpha.h"

namespace pintle {

namespace {

/// Sliding friction whose force does no work does not determine its own energy; this says nothing about the other rows.
bool books_agree_with_model(const System& system) {
  return std::none_of(system.contacts.begin(), system.contacts.end(),
                      [](const ContactPair& c) { return c.friction && c.sliding == Sliding::geometric; });
}

std::string for_finer_books(const Scheme& scheme) { return scheme.fixed_step > 0 ? "shorten moreau.step" : "tighten run.tolerance"; }

// The error of a row may be as large as the energy-balance error beyond rounding, the energy that the scheme removed, and the tolerance of
// the energy in play together.
void warn_of_small_rows(const System& system, const Scheme& scheme, Run& run) {
  constexpr double doubtful = 0.05, noticed = 1e-6;  // of a row; of the energy in play: below it a force does no work
  if (run.greatest_integrals.size() != system.integrals.size() || !books_agree_with_model(system)) return;
  double warning = std::max(0.0, std::abs(run.worst_unexplained) - run.ledger_floor) + scheme.tolerance * run.energy_in_play;
  for (std::size_t i = 0; i < system.integrals.size(); ++i)
    if (system.integrals[i].account == Account::scheme) warning += run.greatest_integrals[i];
  std::size_t worst = 0, more = 0;
  double least = 0;
  for (std::size_t i = 0; i < system.integrals.size(); ++i) {
    const double size = run.greatest_integrals[i];
    if (system.integrals[i].account == Account::scheme || size <= std::max(noticed * run.energy_in_play, run.ledger_floor) ||
        warning <= doubtful * size)
      continue;
    if (more++ == 0 || size < least) worst = i, least = size;
  }
  if (more == 0) return;
  const std::string known = warning < least ? " is known to about " + number_text(100 * warning / least, 1) + " %" : " is not known";
  run.warnings.push_back("\"" + integral_name(system, system.integrals[worst]) + "\"" +
                         (more > 1 ? " (and " + std::to_string(more - 1) + " more of the ledger)" : "") + known + ": it reached " +
                         number_text(least, 3) + " J, but the energy balance of this run is accurate to " + number_text(warning, 2) +
                         " J; " + for_finer_books(scheme));
}

/// Why an impact at this contact may have added energy, and the remedy.
std::string reason_of_gain(const ContactPair& pair, const Scheme& scheme) {
  const std::string steps = "an error of the steps, which falls with their length; shorten moreau.step";
  std::string law = pair.rigid->poisson
                        ? "different restitutions can do so where several contacts are struck at once; give all of them the same"
                        : "Newton's law of restitution can do so with friction, or where several contacts are struck at "
                          "once; take restitution law: poisson";
  if (!(scheme.fixed_step > 0)) return law;
  return pair.friction ? steps + ", or if this does not help: " + law + " and another method" : steps;
}

// An impact takes energy from the motion, counted together for all contacts struck at one instant. Steps through an impact, or Newton's law
// with friction (Kane 1984), can add energy instead: the ledger still closes, because it counts a negative loss.
void warn_of_gains(const System& system, const Scheme& scheme, Run& run) {
  struct Struck {
    double lost = 0, least = 0;
    int where = -1;  ///< the contact that lost least
  };
  std::map<double, Struck> instants;
  for (const Impact& impact : run.impacts) {
    if (!is_rigid(system.contacts[static_cast<std::size_t>(impact.contact)])) continue;
    Struck& at = instants[impact.begin];
    at.lost += impact.lost;
    if (at.where < 0 || impact.lost < at.least) at.least = impact.lost, at.where = impact.contact;
  }
  double gained = 0;
  Struck worst;
  for (const auto& [begin, at] : instants) {
    gained += std::max(0.0, -at.lost);
    if (at.lost < worst.lost) worst = at;
  }
  if (!(gained > run.ledger_bound * run.energy_in_play + run.ledger_floor)) return;
  const auto where = static_cast<std::size_t>(worst.where);
  run.warnings.push_back("impacts added " + number_text(gained, 3) + " J to the motion, " + number_text(gained / run.energy_in_play, 2) +
                         " of the energy in play, most of it at \"" + system.contact_names[where] +
                         "\": " + reason_of_gain(system.contacts[where], scheme));
}

}  // namespace

// A step has an error c(hω)³, at most the tolerance; the second-order scheme then makes an error of up to (hω)² of the energy in its energy
// balance. Twice that is allowed, for parts that exchange energy. The leading term (hω)² is valid while hω is below a tenth, as at a
// tolerance of 1e-4: looser tolerances get no larger allowance.
double left_by_scheme(const Scheme& scheme) {
  constexpr double resolved = 0.1;  // hω, sixty steps a period
  return 2 * std::min(resolved * resolved, std::pow(scheme.tolerance / AlphaWeights(scheme.rho).error, 2.0 / 3));
}

void check_energy_balance(const Scene& scene, const Model& model, bool implicit, double floor, Run& run) {
  run.ledger_bound = scene.run.ledger_bound;
  run.ledger_floor = floor;
  const bool tighter = run.ledger_bound < RunOptions{}.ledger_bound;  // tighter than the default: requested, so it is applied
  if (implicit && !tighter) run.ledger_bound = std::max(run.ledger_bound, left_by_scheme(model.scheme));
  if (run.status != Status::finished) return;
  const double open = std::abs(run.worst_unexplained), allowed = run.ledger_bound * run.energy_in_play;
  const std::string found = "the ledger leaves " + number_text(run.worst_unexplained, 3) + " J unexplained, " +
                            number_text(open / run.energy_in_play, 3) + " of the energy in play";
  if (!(open <= allowed + floor)) {
    run.status = Status::ledger_over_bound;
    run.reason =
        found + "; bound " + number_text(run.ledger_bound, 3) + " (" + for_finer_books(model.scheme) + ", or raise run.ledger bound)";
    return;
  }
  constexpr double nothing = 1e-6;  // if the energy in play is only the energy-balance error, nothing has moved: rounding of heights
  const bool at_rest = run.energy_in_play - open <= nothing * run.energy_in_play;
  if (open > allowed && !at_rest)
    run.warnings.push_back(found + ", over the bound of " + number_text(run.ledger_bound, 3) +
                           ": it passes because rounding alone may leave " + number_text(floor, 2) +
                           " J in a mechanism of this mass and size; smaller energies cannot be determined");
  warn_of_small_rows(model.system, model.scheme, run);
  warn_of_gains(model.system, model.scheme, run);
}

}  // namespace pintle
