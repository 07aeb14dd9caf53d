#pragma once
#include "case/case.hpp"
#include "case/toml_table.hpp"

namespace hemomag::case_ {

/// Read [magnetic], its one field or its [[magnetic.source]] entries. @throws CaseError
void read_magnetic(Case& c, const Source& source);

}  // namespace hemomag::case_
