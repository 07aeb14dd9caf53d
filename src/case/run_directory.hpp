#pragma once
#include <map>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/run.hpp"

namespace hemomag::case_ {

/// The files of a run directory before it runs: name and content.
using Files = std::map<std::string, std::string>;

/// A file that a case refers to, and the name of its copy in the run directory.
struct CaseFile {
  std::string key, path, copy;
};

std::vector<CaseFile> files_of(const Case& c);

/// @throws Error when it cannot be read
std::string whole_file(const std::string& path);

void add_copies(const Case& c, Files& files);

/// Whether the directory of a run or a packing may be written: it is not there or, with --force,
/// was made by this program and holds nothing that the case is made of. @throws Error with what is
/// in the way and what is accepted
void require_free(const Case& c, const RunOptions& options);

/// Everything that was there goes, but for the lock that the run holds. Without --force there must
/// be nothing else: another run may have come first. @throws Error, FileError
void write_directory(const RunOptions& options, const Files& files);

}  // namespace hemomag::case_
