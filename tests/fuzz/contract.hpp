#pragma once
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

#include "base/error.hpp"

// What every fuzz target asserts: whatever a file holds, reading it gives a value or throws the
// project's own Error with a message of one line. Another exception is a defect, and so are a
// crash, more than 10 s and more than 2 GB, for which libFuzzer and ctest look.

namespace hemomag::fuzz {

[[noreturn]] inline void defect(const std::string& what) {
  std::fprintf(stderr, "broken promise: %s\n", what.c_str());
  std::abort();
}

inline void require(bool holds, const char* promise) {
  if (!holds) defect(promise);
}

template <class Use> void value_or_error(Use use) {
  try {
    use();
  } catch (const Error& e) {
    const std::string_view message = e.what();
    require(!message.empty(), "an error has a message");
    const auto control = [](unsigned char c) { return std::iscntrl(c) != 0; };
    require(std::none_of(message.begin(), message.end(), control), "a message is one line");
  } catch (const std::exception& e) {
    defect(std::string("an exception that is no Error: ") + e.what());
  }
}

/// A directory in memory, where there is such, for files that readers want by name.
class Directory {
public:
  Directory() {
    const std::filesystem::path memory = "/dev/shm";
    const auto parent =
        access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
    path_ = parent / ("hemomag_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~Directory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// @return the path of the file
  std::string write(const std::string& name, std::string_view bytes) const {
    const auto path = path_ / name;
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path.string();
  }

private:
  std::filesystem::path path_;
};

inline const Directory& directory() {
  static const Directory one;
  return one;
}

inline std::string_view bytes(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace hemomag::fuzz
