#pragma once
#include <nlohmann/json_fwd.hpp>

#include "case/case.hpp"
#include "lammps/host.hpp"

namespace hemomag::case_ {

/// Add what fix hemo/profiles of the run found, under "profiles" (docs/output.md): null without
/// one. Collective.
void add_profiles(nlohmann::json& summary, const Case& c, lammps::Host& host);

}  // namespace hemomag::case_
