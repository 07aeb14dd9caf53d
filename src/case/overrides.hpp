#pragma once
#include <string>

#include "case/toml_table.hpp"

namespace hemomag::case_ {

/// Put what `--set` says into a case: "key.path=value", entries of a list by their number.
/// @throws CaseError naming the override
void apply_override(Source& source, const std::string& override_text);

}  // namespace hemomag::case_
