#pragma once
#include <string>

#include "case/case.hpp"

namespace hemomag::case_ {

/// A run is resumed with the case it was started with. Only what does not touch the state may
/// change: the title, the tables run (its length and checkpoints) and output (intervals).
/// @param before  text of the case as run
/// @throws CaseError with the place and name of the first key that differs
void require_same_case(const Case& c, const std::string& before);

}  // namespace hemomag::case_
