// Published problems of plane elements and beams, from examples/verification.
//   verification_page          computes all, writes docs/verification.md and
//   docs/verification/*.svg verification_page --check  computes all but times; returns 1 if one
//   leaves its bounds
#include "tests/verification/page.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <sstream>

namespace verification {

double error(const Row& r) {
  double worst = 0;
  for (std::size_t i = 0; i < r.target.size(); ++i) {
    const double e = i < r.ours.size() ? r.ours[i] / r.target[i] - 1 : NAN;
    if (!(std::abs(e) <= std::abs(worst))) worst = e;
  }
  return worst;
}

const std::vector<std::string>& plane_elements() {
  static const std::vector<std::string> names{
      "triangle3", "triangle6", "quadrilateral4-plain", "quadrilateral4", "quadrilateral8", "quadrilateral8-reduced", "quadrilateral9"};
  return names;
}

bool is_linear(const std::string& element) { return element == "triangle3" || element.starts_with("quadrilateral4"); }

namespace {

std::string listed(const Values& values) {
  std::string out;
  for (const double v : values) out += (out.empty() ? "" : ", ") + printed("%.6g", v);
  return out;
}

std::string percent(double share) { return std::abs(share) < 1e-8 ? printed("%.0e", share) : printed("%+.3g %%", 100 * share); }

std::string line(const Row& r) {
  return r.element + " | " + r.mesh + (r.what.empty() ? "" : ", " + r.what) + " | " + listed(r.ours) + " | " + listed(r.target) + " | " +
         percent(error(r));
}

std::string page_text(const Problems& problems, const std::string& money) {
  std::ostringstream md;
  md << "# Published problems\n\n"
        "What Pintle's elements and eigensolver make of problems whose answers are known. This "
        "page "
        "is written by the program `verification_page` (tests/verification) from the scenes in "
        "examples/verification; the test `Verification.PublishedProblemsAreMet` judges every row "
        "that has a bound. A problem is run by hand with `pintle modes` or `pintle static` and its "
        "scene; "
        "the element is the word after `element:`.\n\n"
        "- **Error**: of the value that errs most, relative.\n"
        "- **Bound**: how much error the test allows, argued in each section; a dash: shown, not "
        "judged.\n"
        "- **Closed, exact**: solved by other means than elements "
        "(tests/verification/closed_forms.cpp), "
        "beside or instead of the printed value.\n"
        "- quadrilateral4 has incompatible modes, quadrilateral4-plain has none; quadrilateral8 is "
        "integrated at "
        "3 × 3 points, quadrilateral8-reduced at 2 × 2.\n\n"
        "| problem | element | mesh | ours | target | error |\n|---|---|---|---|---|---|\n";
  for (const Problem& p : problems)
    for (const Row& r : p.rows)
      if (r.headline) md << "| [" << p.title << "](#" << anchor(p.title) << "), " << p.unit << " | " << line(r) << " |\n";
  md << "\n" << money;
  for (const Problem& p : problems) {
    md << "\n## " << p.title << "\n\n"
       << p.text << "\n\nBounds: " << p.why << "\n\n| element | mesh | ours [" << p.unit
       << "] | target | error | bound |\n|---|---|---|---|---|---|\n";
    for (const Row& r : p.rows)
      md << "| " << line(r) << " | " << (r.allowed > 0 ? percent(r.allowed).substr(r.allowed < 1e-8 ? 0 : 1) : "–") << " |\n";
  }
  return md.str();
}

int check(const Problems& problems) {
  int failures = 0;
  for (const Problem& p : problems)
    for (const Row& r : p.rows) {
      const bool holds = r.allowed <= 0 || (std::abs(error(r)) <= r.allowed && r.ours.size() == r.target.size());
      std::cout << (r.allowed <= 0 ? "shown " : holds ? "ok    " : "FALSE ") << p.title << ": " << line(r) << " | " << r.allowed << "\n";
      failures += !holds;
    }
  return failures > 0;
}

}  // namespace
}  // namespace verification

using namespace verification;

int main(int argc, char** argv) try {
  const bool judge = argc == 2 && std::strcmp(argv[1], "--check") == 0;
  if (argc != 1 && !judge) {
    std::cerr << "verification_page [--check]\n";
    return 2;
  }
  Problems problems;
  const std::string money = accuracy_for_money(problems, !judge);
  plate_problems(problems);
  beam_problems(problems);
  static_problems(problems);
  if (judge) return check(problems);
  paper::write(paper::source / "docs/verification.md", page_text(problems, money));
  return check(problems);
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
