#include "framework/analysis/simulate/end_short.h"

#include <algorithm>
#include <new>
#include <sstream>

#include "framework/common/file.h"

namespace pintle {

namespace {
/// Keeps only complete rows.
void trim(Table& table, std::size_t rows) { table.data.resize(std::min(table.data.size(), rows * table.columns())); }
}  // namespace

bool ended_short(const Run& run) { return run.status == Status::not_written || run.status == Status::out_of_memory; }

void end_short(Run& run, double t) {
  try {
    throw;
  } catch (const FileError& e) {
    run.status = Status::not_written;
    run.reason = e.what();
  } catch (const std::bad_alloc&) {
    const std::size_t rows = run.ledger.columns() > 0 ? std::min(run.trajectory.rows(), run.ledger.rows()) : run.trajectory.rows();
    trim(run.trajectory, rows), trim(run.ledger, rows);
    run.status = Status::out_of_memory;
    std::ostringstream s;
    s << "after t = " << t
      << " s there was not enough memory to continue; end other programs, raise the limit (ulimit -v), or make the model smaller";
    run.reason = s.str();
  }
}

}  // namespace pintle
