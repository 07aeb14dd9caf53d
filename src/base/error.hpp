#pragma once
#include <stdexcept>
#include <string>

namespace hemomag {

/// Anything the user can cause and mend: bad input, an impossible parameter, a run that went
/// unstable. The message is one line that names the keyword, the value and what is accepted.
class Error : public std::runtime_error {
public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

/// A file or the disk: path and reason.
class FileError : public Error {
public:
  using Error::Error;
};

}  // namespace hemomag
