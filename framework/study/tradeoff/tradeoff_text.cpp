#include <algorithm>
#include <cmath>

#include "framework/common/printed.h"
#include "framework/study/tradeoff/tradeoff.h"
#include "framework/study/tradeoff/tradeoff_words.h"

namespace pintle {

namespace {

using Row = std::vector<std::string>;

std::string error_cell(double error, double warning) {
  if (std::isnan(error)) return "–";
  return error > warning ? printed(error < 0.995 ? "%.2g ± %.1g" : "%.0f ± %.1g", 100 * error, 100 * warning)
                         : printed("< %.1g", 100 * warning);
}

Row heading(const TradeReport& r) {
  Row out;
  for (const FidelityAxis& axis : r.plan.axes) out.push_back(axis.name);
  out.insert(out.end(), {"time", "least to most"});
  for (const std::string& q : r.quantities) out.push_back(q + ", error %");
  out.insert(out.end(), {"of the model %", ""});
  return out;
}

Row cells(const TradeReport& r, std::size_t i) {
  const TradePoint& p = r.points[i];
  Row out;
  for (std::size_t a = 0; a < r.plan.axes.size(); ++a)
    out.push_back(p.at.empty() ? (a == 0 ? "as it stands" : "") : r.plan.axes[a].values[p.at[a]].label);
  out.push_back(time_text(p.time));
  out.push_back(p.times.size() > 1 ? printed("%.2g to %.2g", p.least / p.time, p.most / p.time) : "1 run");
  for (std::size_t q = 0; q < r.quantities.size(); ++q)
    out.push_back(r.reference.of[q].constant ? "–" : error_cell(p.errors[q], p.warnings_of[q]));
  double model = NAN;
  for (const double m : p.model) model = std::isnan(model) ? m : std::max(model, m);
  out.push_back(std::isnan(model) ? "–" : printed(model < 0.995 ? "%.2g" : "%.0f", 100 * model));
  out.push_back(r.recommended == i ? "recommended" : p.front && r.tells() ? "front" : "");
  return out;
}

/// The front and the unchanged scene, by time; all usable points if there are few.
std::vector<std::size_t> shown(const TradeReport& r, std::size_t most) {
  std::vector<std::size_t> out;
  std::size_t usable = 0;
  for (const TradePoint& p : r.points) usable += p.usable;
  for (std::size_t i = 0; i < r.points.size(); ++i)
    if (r.points[i].usable && (usable <= most || r.points[i].front || i == 0 || r.recommended == i)) out.push_back(i);
  std::ranges::sort(out, {}, [&](std::size_t i) { return r.points[i].time; });
  return out;
}

/// Number of characters on the screen, not bytes.
std::size_t width(const std::string& s) {
  return static_cast<std::size_t>(std::ranges::count_if(s, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string markdown_row(const Row& row) {
  std::string s = "|";
  for (const std::string& c : row) {
    s += " ";
    for (const char x : c) s += x == '|' ? std::string("\\|") : std::string(1, x);
    s += " |";
  }
  return s + "\n";
}

}  // namespace

std::string tradeoff_text(const TradeReport& r) {
  std::string s = r.plan.title + "\n";
  std::vector<Row> rows{heading(r)};
  if (r.front.empty())
    rows.clear();
  else
    for (const std::size_t i : shown(r, 12)) rows.push_back(cells(r, i));
  std::vector<std::size_t> widths;
  for (const Row& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (widths.size() <= c) widths.push_back(0);
      widths[c] = std::max(widths[c], width(row[c]));
    }
  for (const Row& row : rows) {
    std::string line = "  ";
    for (std::size_t c = 0; c < row.size(); ++c) line += row[c] + std::string(widths[c] - width(row[c]) + 2, ' ');
    s += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  for (const std::string& said : r.said) s += "  " + said + "\n";
  return s;
}

std::string tradeoff_markdown(const TradeReport& r, const std::string& figure, const std::string& heading_marks) {
  std::string s = heading_marks + " " + r.plan.title + "\n\n";
  if (!figure.empty()) s += "![" + r.plan.title + "](" + figure + ")\n\n";
  for (const std::string& said : r.said) s += "- " + said + "\n";
  if (r.front.empty()) return s + "\n";
  s += "\n" + markdown_row(heading(r)) + "|";
  for (std::size_t i = 0; i < heading(r).size(); ++i) s += "---|";
  s += "\n";
  for (const std::size_t i : shown(r, 16)) s += markdown_row(cells(r, i));
  std::size_t ran = 0;
  for (const TradePoint& p : r.points) ran += p.usable;
  s += printed(
           "\nOf %zu settings, %zu ran to their end with a value. Time: median of the timed runs, including reading and building, "
           "excluding files; beside it the least and the greatest relative to the median. ",
           r.points.size(), ran) +
       "Error: relative, ± the uncertainty of the reference; < if the error is below that uncertainty.\n\n";
  return s;
}

}  // namespace pintle
