#pragma once

#include "framework/analysis/simulate/simulate.h"

/// What makes the numbers of a run doubtful, told by the run itself.
namespace pintle {

/// A journal that went deeper into its wall than any contact law holds.
void warn_of_depth(const System&, Run&);
/// What is judged by rows is judged by those of this run, which goes on from a saved state.
void warn_of_gap(const System&, const Model&, const SavedState& from, Run&);
/// A massless link holds the journal at the wall whether the wall presses or not.
void warn_of_pushing(const System&, Run&);
/// A disc that rolls is held in contact, whether it presses or not.
void warn_of_lifting(const System&, Run&);
/// Explicit steps that stability held, not accuracy, and what would do with fewer. @param share  of the steps
void warn_of_stiffness(const Scene&, const Model&, double share, Run&);
/// Events of the scene that have not come in the run so far.
std::vector<std::string> never_came(const Scene&, const Run&);

}  // namespace pintle
