#pragma once
#include <string>

#include "case/case.hpp"

namespace hemomag::case_ {

/// A run is resumed with the case it was started with. Only what does not touch the state may
/// change: the title, the tables run (its length and checkpoints) and output (intervals); and
/// whether average_from is given or the default, which the caller compares as a value.
/// @param before  text of the case as run
/// @throws CaseError with the place and name of the first key that differs
void require_same_case(const Case& c, const std::string& before);

/// An output that the checkpoint knows nothing of begins anew: there must be nothing in the run
/// directory that it would replace.
/// @param before  text of the case in the checkpoint
/// @param out     the run directory
/// @throws CaseError with the key and the file that is there
void require_room_for_output(const Case& c, const std::string& before, const std::string& out);

}  // namespace hemomag::case_
