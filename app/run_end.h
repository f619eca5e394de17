#pragma once

#include <filesystem>
#include <functional>

#include "app/options.h"
#include "framework/analysis/simulate/simulate.h"
#include "framework/output/results_directory.h"

namespace pintle::app {

/// Call it before anything is computed. @throws FileError  results cannot be written there
void require_place(const std::filesystem::path& out);

/// The same for a file that may be overwritten. @throws std::runtime_error
void require_file_place(const std::filesystem::path& file);

/// Reports what other runs have left next to `out`, if stderr is a terminal.
void tell_leftovers(const Options&, const std::filesystem::path& out);

/// Says on stderr if a run that fills this folder has not ended, and how far it came.
void tell_if_unfinished(const std::filesystem::path& directory);

/// Writes computed results: `write` fills a folder, which is then renamed to `out`. @throws FileError
void write_whole(const Options&, const std::filesystem::path& out, const std::function<void(const std::filesystem::path&)>& write);

/// End of a run: `write` writes the remaining data, and the folder gets its final name. If any of this fails, the folder is kept, the run's
/// status is not_written and its reason says where the results are; `report` then writes this.
void finish_run(ResultsDirectory&, Run&, const std::function<void()>& write, const std::function<void()>& report);

/// Reports on stderr how an unfinished run ended, if nothing else reports it.
int exit_code(const Options&, const Scene&, const Run&);

}  // namespace pintle::app
