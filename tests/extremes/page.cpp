// The page of the atlas of extremes.
//   extremes_page            runs every case, minutes of nightly ones included, writes docs/stability.md; returns 1 if a verdict is bad
//   extremes_page --quick    the same without the nightly ones, which the page then says
//   extremes_page --only X   axes whose name contains X, likewise; prints their part of the page and writes none
#include <cctype>
#include <cstring>
#include <iostream>
#include <map>
#include <sstream>

#include "tests/extremes/atlas.h"

namespace extremes {
namespace {

using paper::anchor;
using Rows = std::vector<Row>;

std::string capital(std::string s) {
  if (!s.empty()) s[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(s[0])));
  return s;
}

/// One line of a table: no bars, no line ends.
std::string in_cell(const std::string& s) {
  std::string out;
  for (const char c : s) out += c == '\n' ? std::string(" ") : c == '|' ? std::string("&#124;") : std::string(1, c);
  return out;
}

std::string figure(double x) { return x == 0 ? "0" : printed("%.2g", x); }

std::string label(const Case& c) { return c.label + (c.what.empty() ? "" : ", " + c.what); }

std::string line(const Row& r) {
  const Finding& x = r.found;
  const bool shown = x.bound >= 0;
  return label(*r.what) + " | " + word(x.end) + " | " + (shown ? figure(x.measured) : "–") + " | " + (shown ? figure(x.bound) : "–") +
         " | " + in_cell(x.said);
}

/// From the first to the last value at which it finishes, and what is met outside or amid.
std::string range(const Rows& rows, bool held) {
  std::vector<const Case*> in;
  for (const Row& r : rows)
    if ((r.found.end == End::finished) == held) in.push_back(r.what);
  if (in.empty()) return "–";
  const Case *low = in.front(), *high = in.front();
  for (const Case* c : in) {
    if (c->value < low->value) low = c;
    if (c->value >= high->value) high = c;
  }
  return low->label == high->label ? low->label : low->label + " to " + high->label;
}

std::string past(const Rows& rows) {
  std::map<End, std::vector<std::string>> labels;
  for (const Row& r : rows)
    if (r.found.end != End::finished) {
      auto& list = labels[r.found.end];
      if (list.empty() || list.back() != r.what->label) list.push_back(r.what->label);
    }
  std::string out;
  for (const auto& [end, list] : labels) {
    out += (out.empty() ? "" : "; ") + std::string(word(end)) + " at ";
    for (std::size_t i = 0; i < list.size(); ++i) out += (i ? ", " : "") + list[i];
  }
  return out.empty() ? "nothing stops it within the axis" : out;
}

double worst_share(const Rows& rows) {
  double out = 0;
  for (const Row& r : rows)
    if (r.found.bound > 0) out = std::max(out, r.found.measured / r.found.bound);
  return out;
}

std::string page_text(const std::vector<Rows>& tables, const std::string& left_out) {
  std::size_t cases = 0;
  for (const Rows& rows : tables) cases += rows.size();
  std::ostringstream md;
  md << "# How far it holds\n\n"
        "An atlas of extremes: each axis of a scene taken to its ends and past them. Written by the program `extremes_page` "
        "(tests/extremes), "
        "which runs "
     << cases
     << " cases; the same cases are the tests of the label `extremes` (`ctest -L extremes`) and, those of minutes, of `nightly` "
        "(`ctest -C nightly -L nightly`), which assert every verdict.\n\n"
        "- **Finished**: to its end, no warning, all numbers finite, the figure within its bound.\n"
        "- **Warned**: to its end, with a warning that names what is doubtful.\n"
        "- **Stopped**: the run ended before, or its ledger left its bound: with a status and a reason; all up to there is kept.\n"
        "- **Refused**: before the run, with file, line, value and remedy.\n"
        "- **Figure**: what is asserted, against a limit, a conservation law or a model that shares no code; **bound**: how much is "
        "allowed.\n\n"
     << (left_out.empty() ? "" : "Left out of this page, for they take minutes: " + left_out + ".\n\n")
     << "No case hangs, leaves a number that is not finite or ends without a reason: every run is judged for that as well.\n\n"
        "| axis | holds | of the bound, at worst | past it |\n|---|---|---|---|\n";
  for (const Rows& rows : tables) {
    const std::string& name = rows.front().axis->name;
    md << "| [" << name << "](#" << anchor(name) << ") | " << range(rows, true) << " | " << printed("%.0f %%", 100 * worst_share(rows))
       << " | " << in_cell(past(rows)) << " |\n";
  }
  for (const Rows& rows : tables) {
    const Axis& axis = *rows.front().axis;
    md << "\n## " << capital(axis.name) << "\n\n"
       << axis.text << "\n\nAsserted: " << axis.asserted << "\n\nBounds: " << axis.why
       << "\n\n| at | ended | figure | bound | what is said |\n|---|---|---|---|---|\n";
    for (const Row& r : rows) md << "| " << line(r) << " |\n";
  }
  return md.str();
}

}  // namespace
}  // namespace extremes

using namespace extremes;

int main(int argc, char** argv) try {
  const bool quick = argc == 2 && std::strcmp(argv[1], "--quick") == 0;
  const std::string only = argc == 3 && std::strcmp(argv[1], "--only") == 0 ? argv[2] : "";
  if (argc != 1 && !quick && only.empty()) {
    std::cerr << "extremes_page [--quick | --only NAME]\n";
    return 2;
  }
  int bad = 0;
  std::string left_out;
  std::vector<Rows> tables;
  for (const Axis& axis : atlas()) {
    if (axis.name.find(only) == std::string::npos) continue;
    Rows rows;
    for (const Case& c : axis.cases) {
      if (quick && c.nightly) {
        left_out += (left_out.empty() ? "" : "; ") + axis.name + " " + c.label;
        continue;
      }
      rows.push_back(row(axis, c));
      const std::string wrong = rows.back().wrong();
      std::cout << (wrong.empty() ? "ok    " : "FALSE ") << axis.name << " | " << line(rows.back())
                << printed(" | %.2f s", rows.back().seconds) << (wrong.empty() ? "" : "  <- " + wrong) << std::endl;
      bad += !wrong.empty();
    }
    if (!rows.empty()) tables.push_back(std::move(rows));
  }
  if (only.empty())
    paper::write(paper::source / "docs/stability.md", page_text(tables, left_out));
  else
    std::cout << page_text(tables, left_out);
  std::cout << bad << " bad verdicts\n";
  return bad > 0;
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
