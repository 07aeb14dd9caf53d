#pragma once
#include <string>
#include <vector>

namespace hemomag::app {

/// `hemomag bench`: speed on this machine with these ranks, medians of interleaved repetitions.
/// Collective.
/// @return 0, or 2 if a name is unknown
int bench(const std::vector<std::string>& names, bool json);

}  // namespace hemomag::app
