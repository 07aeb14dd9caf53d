#include "case/run_lock.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/error.hpp"

namespace hemomag::case_ {
namespace {

constexpr const char* head = "process ";  // of the file's text

/// "process 1234 on host", as its owner wrote it.
std::string owner(int file) {
  char text[256];
  const ssize_t n = pread(file, text, sizeof text, 0);
  return n > 0 ? std::string(text, static_cast<std::size_t>(n)) : "another process";
}

}  // namespace

RunLock::RunLock(const std::string& directory)
    // The working directory changes while the run is on.
    : path_((std::filesystem::absolute(directory) / name).string()) {
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) throw FileError(path_ + ": opening failed: " + std::strerror(errno));
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    const bool taken = errno == EWOULDBLOCK;
    const std::string reason = taken ? owner(file_) : std::strerror(errno);
    close(file_);
    if (!taken) throw FileError(path_ + ": locking failed: " + reason);
    throw Error("--out " + directory + ": " + reason +
                " is at work in it; accepted: another directory, or this one when that has ended");
  }
  char host[128] = "";
  gethostname(host, sizeof host - 1);
  const std::string text = head + std::to_string(getpid()) + " on " + host;
  if (ftruncate(file_, 0) != 0 ||
      pwrite(file_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
    const int reason = errno;
    close(file_);
    throw FileError(path_ + ": writing failed: " + std::strerror(reason));
  }
}

bool RunLock::was_here(const std::string& directory) {
  std::ifstream file(directory + "/" + name);
  std::string text;
  std::getline(file, text);
  return text.rfind(head, 0) == 0;
}

/// The file stays: to remove it would let two others lock two files of the same name.
RunLock::~RunLock() { close(file_); }

}  // namespace hemomag::case_
