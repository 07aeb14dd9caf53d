#pragma once
#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>

namespace hemomag {

/// A text without line ends and other control characters, which become question marks: keys and
/// names come from files, and a message is one line whatever they hold.
inline std::string on_one_line(std::string text) {
  const auto control = [](unsigned char c) { return std::iscntrl(c) != 0; };
  std::replace_if(text.begin(), text.end(), control, '?');
  return text;
}

/// Anything the user can cause and mend: bad input, an impossible parameter, a run that went
/// unstable. The message is one line that names the keyword, the value and what is accepted.
class Error : public std::runtime_error {
public:
  explicit Error(const std::string& message) : std::runtime_error(on_one_line(message)) {}
};

/// A file or the disk: path and reason.
class FileError : public Error {
public:
  using Error::Error;
};

}  // namespace hemomag
