// The results of a run as one page.
#include "app/report.h"

#include <iostream>

#include "app/options.h"
#include "app/progress.h"
#include "app/run_end.h"
#include "app/waiting.h"
#include "framework/common/file.h"
#include "framework/output/results_directory.h"
#include "framework/report/csv_reader.h"
#include "framework/report/run_report.h"
#include "framework/report/table_report.h"

namespace pintle::app {

namespace fs = std::filesystem;

void write_report(const fs::path& directory, const fs::path& file, double megabytes, bool quiet) {
  now_doing("writing the report");
  const Waiting waiting(quiet);
  write_text(file, report_page(directory, report_limits(1e6 * megabytes)));
}

int report(const Options& options) {
  is_lost_if_stopped("the page was not written");
  const fs::path directory = without_slash(options.scene);
  const fs::path file = options.out.empty() ? directory / "report.html" : fs::path(options.out);
  if (!fs::exists(directory) && !leftovers(directory).empty()) throw ResultsError(directory.string() + ": " + no_such_folder(directory));
  const bool there = fs::is_directory(directory), shown = there && (time_of_last_row(directory) || has_table_page(directory));
  if (fs::exists(directory / "part.json"))
    throw ResultsError(directory.string() + ": holds a part of a sweep; join all its parts by pintle merge, and report the result");
  const std::string why = there && !shown ? why_without("motion", directory) : "";
  if (!why.empty()) throw ResultsError(directory.string() + ": has nothing to show: " + why);
  if (!options.out.empty()) require_file_place(file);
  tell_if_unfinished(directory);
  write_report(directory, file, options.megabytes, options.quiet);
  if (!options.quiet)
    std::cout << "  " << file.string() << "  " << number(static_cast<double>(fs::file_size(file)) / 1e6, 3)
              << " MB; open it in a browser\n";
  return ok;
}

}  // namespace pintle::app
