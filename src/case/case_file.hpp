#pragma once
#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"

namespace hemomag::case_ {

/// Something wrong with a case file. what() is the one line for the user:
/// FILE:LINE:COL: key: what is wrong; what is accepted      (a `--set` override: --set key: ...)
class CaseError : public Error {
public:
  using Error::Error;
};

/// Read and check a case file. Every key is checked against the table of keys.hpp before anything
/// else happens.
/// @param overrides  "key.path=value" from --set; [[cell]] entries are cell.0, cell.1, ... or just
/// cell if there is one
/// @throws CaseError
Case read_case(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace hemomag::case_
