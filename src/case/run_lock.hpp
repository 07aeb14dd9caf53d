#pragma once
#include <string>

namespace hemomag::case_ {

/// Keeps other runs out of a run directory as long as it lives. The system gives the lock back when
/// the process ends, however it ends: there are no stale ones.
class RunLock {
public:
  static constexpr const char* name = "lock";  ///< of its file, in the directory

  /// @throws Error naming the process that works in the directory; FileError when it cannot be
  /// written to
  explicit RunLock(const std::string& directory);
  ~RunLock();
  /// Whether a directory has had one.
  static bool was_here(const std::string& directory);
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

private:
  std::string path_;
  int file_ = -1;
};

}  // namespace hemomag::case_
