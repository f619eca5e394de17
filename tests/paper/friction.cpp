#include "tests/paper/page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "contact/normal_law.h"

namespace paper {

/// Means over a run's first `until` seconds, weighted by the normal force.
struct Attachment {
  double correction = 0;  ///< c_d
  double speed = 0;       ///< |sliding| [m/s]
  double middle = 0;      ///< share between v0 and v1
  double rest = 0;        ///< share below v0
};
Attachment attachment(const Run& r, double mu, double until) {
  const Vector t = column(r, "t [s]"), n = column(r, pin + "normal [N]"), s = column(r, pin + "sliding [m/s]"),
               T = column(r, pin + "friction [N]");
  Attachment g;
  double all = 0;
  for (std::size_t i = 0; i < t.size() && t[i] <= until; ++i) {
    const double speed = std::abs(s[i]);
    all += n[i];
    g.correction += std::abs(T[i]) / mu;
    g.speed += n[i] * speed;
    (speed < 1e-3 ? g.rest : speed < 1e-2 ? g.middle : all) += speed < 1e-2 ? n[i] : 0;
  }
  return {g.correction / all, g.speed / all, g.middle / all, g.rest / all};
}

double gone(const Run& r, double t) { return r.first.stored() - ledger_at(r, "stored [J]", t); }

void figure9(Page& page) {
  const std::array<const char*, 7> mus{"0", "0.01", "0.05", "0.1", "0.15", "0.2", "0.3"};
  const std::array<const char*, 2> scenes{"fig09_friction", "fig09_friction_geometric"};
  const std::array<const char*, 2> names{"surfaces", "place of contact"};
  std::array<std::vector<Curve>, 2> energy_curves, sliding;
  std::array<std::string, 2> losses;
  std::string parts, attachments, books, hits;
  for (std::size_t d = 0; d < 2; ++d)
    for (const char* e : {"0.9", "0.8"})
      for (const char* mu : mus) {
        const double m = std::stod(mu);
        const Run r = run(scenes[d],
                          [&](Scene& s) {
                            clearance(s).normal.restitution = std::stod(e);
                            s.output.every = 5e-6;
                            s.run.tolerance = 1e-11;
                          },
                          {{"mu", mu}});
        losses[d] += printed("| %s | %s |", e, mu);
        for (const double t : {5e-3, 10e-3, 15e-3, 20e-3, 30e-3, 50e-3, 100e-3}) losses[d] += printed(" %.3f |", gone(r, t));
        losses[d] += printed(" %zu |\n", r.impacts.size());
        if (m > 0) {
          parts += printed("| %s | %s | %s |", names[d], e, mu);
          attachments += printed("| %s | %s | %s |", names[d], e, mu);
          for (const double t : {10e-3, 20e-3, 100e-3}) {
            const double h = ledger_at(r, lost_h, t);
            parts += printed(" %.3f + %.3f = %.3f |", h, gone(r, t) - h, gone(r, t));
            const Attachment g = attachment(r, m, t);
            attachments += printed(" %.2f, %.3f, %.3f |", g.correction, m * g.correction, g.speed);
          }
          const Attachment g = attachment(r, m, 0.1);
          parts += "\n", attachments += printed(" %.1f %%, %.1f %% |\n", 100 * g.rest, 100 * g.middle);
        }
        if (d == 0 && e[2] == '9' && m > 0) {
          const Vector t = column(r, "t [s]"), slide = column(r, pin + "sliding [m/s]"), work = r.ledger.column(lost_f);
          hits += std::string("| ") + mu + " |";
          for (std::size_t k = 0; k < 3; ++k) {
            const auto b = static_cast<std::size_t>(std::ranges::lower_bound(t, r.impacts[k].begin) - t.begin()),
                       a = static_cast<std::size_t>(std::ranges::upper_bound(t, r.impacts[k].end) - t.begin());
            hits += printed(" %.3f → %.3f; %.4f |", slide[b], slide[a - 1], work[a] - work[b - 1]);
          }
          hits += "\n";
        }
        if (e[2] == '8' || m == 0.15) continue;
        const double own = ledger_at(r, lost_f, 0.1);
        energy_curves[d].push_back({mu, ms(r), energies(r)});
        if (m >= 0.05) sliding[d].push_back({mu, ms(r), while_touching(r, pin + "sliding [m/s]", d == 0 ? 1 : 1e3)});
        if (d == 1 && m > 0)
          books +=
              printed("| %s | %.3f | %.5f | %.3f | %.0f |\n", mu, own - r.unexplained, own, -r.unexplained, (own - r.unexplained) / own);
      }
  std::vector<Panel> panels;
  for (std::size_t d = 0; d < 2; ++d) {
    const std::string which = std::string(", speed of the ") + names[d], unit = d == 0 ? "sliding speed [m/s]" : "sliding speed [mm/s]";
    panels.push_back({"Fig. 9(a): energy for six mu" + which, "time [ms]", "kinetic and gravity [J]", energy_curves[d], {0, 100}});
    panels.push_back({"Fig. 9(a): the first 20 ms", "time [ms]", "kinetic and gravity [J]", energy_curves[d], {0, 20}, {19.5, 20.9}});
    panels.push_back({"Fig. 9(b): sliding for four mu" + which, "time [ms]", unit, sliding[d], {0, 40}});
    panels.push_back({"Fig. 9(c): the same, 20 to 30 ms", "time [ms]", unit, sliding[d], {20, 30}});
  }
  figure("fig09", panels);
  page.summary.push_back({"Fig. 9(a), energy for several μ, 2 mm, 300 rad/s", "loss grows with μ up to 0.1 and falls beyond",
                          "falls beyond 0.05 in windows of 5 and 10 ms with either sliding speed; beyond 0.1 in "
                          "windows of 15 and 20 ms with the speed of Eq. (22) and e = 0.8; "
                          "after 30 ms it grows with μ beyond 0.1, with either",
                          "a matter of the window; reason: see [friction](#friction)"});
  page.summary.push_back({"Figs. 9(b), (c), tangential speed", "falls as μ grows",
                          "mean sliding speed falls as μ grows, with either definition", "size depends on the definition, Eq. (22)"});
  const std::string head =
      "| e | μ | 5 ms | 10 ms | 15 ms | 20 ms | 30 ms | 50 ms | 100 ms | contacts in 100 ms "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n";
  page.text << "<a id=\"friction\"></a>\n\n## Fig. 9: friction\n\nFree crank from 300 rad/s, clearance 2 "
               "mm, v₀ = 1 mm/s, v₁ = 10 mm/s. Scenes "
               "[speed of the surfaces](../examples/paper/fig09_friction.yaml), "
               "[speed of the place of contact](../examples/paper/fig09_friction_geometric.yaml), with "
               "`--set mu=…`. The paper "
               "gives restitution 0.9 for the whole study and names no coefficient except 0.1; 0.8 is "
               "computed as well.\n\n"
               "![Energy and sliding speed with friction](paper/fig09.svg)\n\n"
               "The legend gives μ; restitution 0.9; sliding is drawn while the journal touches. Energy "
               "gone [J] since the start (here with what the contact stores counted as present), "
               "friction opposing the speed of the **surfaces** (the default):\n\n"
            << head << losses[0]
            << "\nThe same with the speed of the **place of contact** (`sliding: geometric`, Eq. 22 as "
               "printed):\n\n"
            << head << losses[1]
            << "\n**Does the loss fall beyond μ = 0.1?** In short windows, yes, and with both "
               "definitions. After 5 and 10 ms it is largest at 0.05 in all four sets, and with e = 0.8 "
               "falls from there to 0.3 "
               "step by step. With the speed of the place of contact and e = 0.8 it is largest at "
               "exactly 0.1 after 15 and 20 ms, as the paper prints. After 30 ms and more, friction "
               "beyond 0.1 "
               "always costs more energy, up to 0.3. So the printed statement holds for a window, not "
               "for the mechanism. How long the window of Fig. 9(a) is cannot be read from the text.\n\n"
               "**Where the loss goes.** Hysteresis + work of friction on the bodies = energy gone "
               "[J]:\n\n"
               "| speed of the | e | μ | after 10 ms | after 20 ms | after 100 ms "
               "|\n|---|---|---|---|---|---|\n"
            << parts
            << "\n**The reason given in the paper** is that c_d falls because the tangential speed falls "
               "as μ grows. Mean c_d; mean μ c_d, the coefficient that acts; mean sliding speed [m/s]; "
               "all weighted by the "
               "normal force. In the last column the shares of the normal force at speeds below v₀ and "
               "between v₀ and v₁:\n\n"
               "| speed of the | e | μ | 10 ms | 20 ms | 100 ms | below v₀, between (100 ms) "
               "|\n|---|---|---|---|---|---|---|\n"
            << attachments
            << "\nThe sliding speed does fall as μ grows, and c_d with it: a little with the speed of "
               "the surfaces, strongly with the speed of the place of contact. But the product μ c_d "
               "grows throughout, with either. "
               "So it is not the coefficient that falls.\n\n"
               "**What the program shows** is that friction ends the sliding itself, and its work is "
               "force times distance slid. First three hits, speed of the surfaces, e = 0.9: sliding "
               "speed at begin → end [m/s]; work of friction [J]:\n\n"
               "| μ | first | second | third |\n|---|---|---|---|\n"
            << hits
            << "\nIn the first hit this work is largest at μ = 0.1 and falls beyond: the greater force "
               "slows the sliding sooner, and from 0.2 on stops it within the hit. So far the printed "
               "observation and the falling tangential speed are right. "
               "Over the first 10 ms the work of friction stops growing (e = 0.9, from μ = 0.15) or "
               "falls (e = 0.8, beyond 0.15), while hysteresis gets less because friction has taken "
               "energy and the next hits come at other times and speeds. "
               "The largest loss at 0.1 after 15 and 20 ms (place of contact, e = 0.8) is a matter of "
               "hysteresis: 0.835 J at 0.1 against 0.710 at 0.05 and 0.800 at 0.2, while the work of "
               "friction falls from 0.05 on. "
               "Later, when the hits are over and the journal slides along the wall, the work of "
               "friction grows with μ and so does the loss.\n\n";
  page.text << "### Eq. (22): what the sliding speed of the place of contact leaves unexplained\n\n"
               "Eq. (22) moves the contact point with R ṅ, so the spin of journal and bearing "
               "drops out, and the tangential speed becomes depth "
               "times turning rate of n "
               "([derivation](theory/contact.md#sliding-speed-material-or-geometric)). The "
               "friction force acts on material "
               "points all the same. Work of friction in 100 ms, restitution 0.9 [J]:\n\n"
               "| μ | taken from the bodies | as its own speed shows | unexplained in the ledger | "
               "ratio |\n|---|---|---|---|---|\n"
            << books
            << "\nWith the speed of the surfaces the ledger of the same cases closes to 1e-8 of "
               "the initial energy. The scene with the other speed therefore "
               "sets its `ledger bound` high.\n\n";
}

void figure11(Page& page) {
  const Run far = run("fig11_concentric", output(5e-6)), near = run("fig11_near_wall", output(5e-6));
  const Curve a{"concentric", ms(far), energies(far)}, b{"near the wall", ms(near), energies(near)};
  const auto cut = [](Curve c, std::size_t n) {
    c.x.resize(n), c.y.resize(n);
    return c;
  };
  figure("fig11",
         {{"Fig. 10: the two starts, orbits for 5 ms",
           "x [mm]",
           "y [mm]",
           {cut(orbit("concentric", far, 1e3), 1001), cut(orbit("near the wall", near, 1e3), 1001), circle("clearance circle", 2)},
           {},
           {},
           true},
          {"Fig. 11: energy, 20 ms", "time [ms]", "kinetic and gravity [J]", {a, b}, {0, 20}},
          {"Fig. 11: energy, 100 ms", "time [ms]", "kinetic and gravity [J]", {a, b}, {0, 100}}},
         3);
  page.summary.push_back({"Figs. 10, 11, start concentric or 10 nm from the wall", "the concentric start loses more at the beginning",
                          printed("after 20 ms %.3f against %.3f J, after 100 ms %.3f against %.3f J", loss_at(far, 0.02),
                                  loss_at(near, 0.02), loss_at(far, 0.1), loss_at(near, 0.1)),
                          "none"});
  page.text << "## Figs. 10 and 11: where the journal starts\n\nFree crank from 300 rad/s, "
               "clearance 2 mm, friction 0.01, restitution 0.9. Scenes "
               "[concentric](../examples/paper/fig11_concentric.yaml), [near the "
               "wall](../examples/paper/fig11_near_wall.yaml).\n\n"
               "![Two starts](paper/fig11.svg)\n\n";
  page.text << printed(
      "The journal beside the wall (towards the crank, where the slider's inertia presses it) "
      "makes contact after %.2f µs at %.1f mm/s and never "
      "leaves: in 20 ms hysteresis takes %.4f J and friction %.4f J. The concentric one falls "
      "through 2 mm and hits %d times: %.4f J and %.4f J.\n\n",
      1e6 * near.impacts.front().begin, 1e3 * near.impacts.front().approach, ledger_at(near, lost_h, 0.02), ledger_at(near, lost_f, 0.02),
      static_cast<int>(std::ranges::count_if(far.impacts, [](const Impact& i) { return i.begin < 0.02; })), ledger_at(far, lost_h, 0.02),
      ledger_at(far, lost_f, 0.02));
  const auto both = [](double t) { return [t](const Run& r) { return printed("%.6f", loss_at(r, t)); }; };
  page.text << "Loss in 100 ms [J]:\n\n| start |" << converging_head << "| concentric |" << converging("fig11_concentric", {}, both(0.1))
            << "| near the wall |" << converging("fig11_near_wall", {}, both(0.1))
            << "\nThe concentric run with little friction and restitution 0.9 bounces some fifty "
               "times; beyond the fourteenth impact the speeds of single impacts "
               "no longer agree to six digits between tolerances, and of the loss only the digits "
               "that agree in the row above.\n\n";
}

}  // namespace paper
