#pragma once

#include "framework/analysis/simulate/simulate.h"

/// Warnings about doubtful results, from what the run has recorded.
namespace pintle {

/// Penetration deeper than any contact law is valid for.
void warn_of_depth(const System&, Run&);
/// Says which checks over all rows cover only this run, because it continues from a saved state.
void warn_of_gap(const System&, const Model&, const SavedState& from, Run&);
/// A massless link that pushes: it keeps the journal at the wall even where a wall would have to pull.
void warn_of_pushing(const System&, Run&);
/// A rolling disc that would lift off: the joint keeps it in contact even where it would have to pull.
void warn_of_lifting(const System&, Run&);
/// Explicit steps limited by stability instead of accuracy, with a remedy. @param share  of the steps
void warn_of_stiffness(const Scene&, const Model&, double share, Run&);
/// Joint forces that generalised-α computes at this tolerance with errors of up to tens of per cent. @param implicit  it made the run, or
/// its last part
void warn_of_coarse_forces(const Model&, bool implicit, Run&);
/// Events of the scene that have not occurred in the run so far.
std::vector<std::string> never_came(const Scene&, const Run&);

}  // namespace pintle
