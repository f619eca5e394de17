#pragma once

#include <filesystem>
#include <functional>

#include "app/options.h"
#include "framework/analysis/simulate/simulate.h"
#include "framework/output/results_directory.h"

namespace pintle::app {

/// To be called before anything is computed. @throws FileError  results cannot be written there
void require_place(const std::filesystem::path& out);

/// The same of a file that is written over if it is there. @throws std::runtime_error
void require_file_place(const std::filesystem::path& file);

/// What other runs left beside `out`, for who waits at the terminal.
void tell_leftovers(const Options&, const std::filesystem::path& out);

/// Writes results that have been computed: `write` fills a folder, which then becomes `out`. @throws FileError
void write_whole(const Options&, const std::filesystem::path& out, const std::function<void(const std::filesystem::path&)>& write);

/// The end of a run: `write` writes what is left, and the folder becomes what it is to be. Where anything of that fails the
/// folder stays, the run's status is not_written and its reason says where; `report` then writes that.
void finish_run(ResultsDirectory&, Run&, const std::function<void()>& write, const std::function<void()>& report);

/// Says on stderr how a run ended that did not finish, where nothing else says it.
int exit_code(const Options&, const Scene&, const Run&);

}  // namespace pintle::app
