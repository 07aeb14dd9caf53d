#pragma once
#include "case/case.hpp"
#include "case/toml_table.hpp"

namespace hemomag::case_ {

/// Read [magnetic], its one field or its [[magnetic.source]] entries. @throws CaseError
void read_magnetic(Case& c, const Source& source);

/// Make the case as run refer to the copies of its tables (table_copy). @return whether it has any
bool point_at_table_copies(Source& source, const Case& c);

}  // namespace hemomag::case_
