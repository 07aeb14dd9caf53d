#include "io/files.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/error.hpp"

namespace hemomag::io {
namespace {

[[noreturn]] void fail(const std::string& path, const char* doing) {
  throw Error(path + ": " + doing + " failed: " + std::strerror(errno));
}

}  // namespace

void replace_file(const std::string& path, const std::string& text) {
  const std::string fresh = path + ".new";
  std::FILE* file = std::fopen(fresh.c_str(), "w");
  if (!file) fail(fresh, "opening");
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size() &&
                       std::fflush(file) == 0 && fsync(fileno(file)) == 0;
  const int reason = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed) {
    if (!written) errno = reason;
    fail(fresh, "writing");
  }
  if (std::rename(fresh.c_str(), path.c_str()) != 0) fail(path, "renaming");
}

void make_directory(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw Error(path + ": creating the directory failed: " + error.message());
}

CsvFile::CsvFile(const std::string& path, const std::string& header)
    : path_(path), file_(std::fopen(path.c_str(), "w")) {
  if (!file_) fail(path_, "opening");
  if (std::fprintf(file_.get(), "%s\n", header.c_str()) < 0 || std::fflush(file_.get()) != 0)
    fail(path_, "writing");
}

void CsvFile::row(const std::vector<double>& values) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::fprintf(file_.get(), k == 0 ? "%.9g" : ",%.9g", values[k]) < 0) fail(path_, "writing");
  if (std::fputc('\n', file_.get()) == EOF || std::fflush(file_.get()) != 0) fail(path_, "writing");
}

void SeriesIndex::add(const std::string& name, double time_s) {
  entries_.emplace_back(name, time_s);
  nlohmann::json index{{"file-series-version", "1.0"}, {"files", nlohmann::json::array()}};
  for (const auto& [file, time] : entries_)
    index["files"].push_back({{"name", file}, {"time", time}});
  replace_file(path_, index.dump(1) + "\n");
}

}  // namespace hemomag::io
