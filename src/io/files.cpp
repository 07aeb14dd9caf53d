#include "io/files.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/error.hpp"

namespace hemomag::io {
namespace {

[[noreturn]] void fail(const std::string& path, const char* doing) {
  throw FileError(path + ": " + doing + " failed: " + std::strerror(errno));
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
  sync_file(std::filesystem::absolute(path).parent_path().string());
}

void make_directory(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw FileError(path + ": creating the directory failed: " + error.message());
}

void copy_file(const std::string& from, const std::string& to) {
  std::error_code error;
  std::filesystem::copy_file(from, to, error);
  if (error) throw FileError(to + ": copying " + from + " failed: " + error.message());
}

bool is_readable(const std::string& path) {
  std::error_code error;  // a name that is too long is no file either
  return std::filesystem::is_regular_file(path, error) && std::ifstream(path);
}

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

void sync_file(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY);
  if (file < 0) fail(path, "opening");
  const bool synced = fsync(file) == 0;
  const int reason = errno;
  close(file);
  errno = reason;
  if (!synced) fail(path, "syncing");
}

std::string told_by_rank_0(MPI_Comm comm, const std::string& text) {
  auto length = static_cast<unsigned long>(text.size());
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG, 0, comm);
  std::string told = text;
  told.resize(length);
  MPI_Bcast(told.data(), static_cast<int>(length), MPI_CHAR, 0, comm);
  return told;
}

CsvFile::CsvFile(const std::string& path, const std::string& header)
    : path_(path), file_(std::fopen(path.c_str(), "w")) {
  if (!file_) fail(path_, "opening");
  if (std::fprintf(file_.get(), "%s\n", header.c_str()) < 0 || std::fflush(file_.get()) != 0)
    fail(path_, "writing");
}

CsvFile CsvFile::resume(const std::string& path, long length) {
  std::error_code error;
  const auto found = std::filesystem::file_size(path, error);
  if (error || found < static_cast<std::uintmax_t>(length))
    throw FileError(path + ": is shorter than when the checkpoint was written (" +
                    std::to_string(length) + " bytes); put back what was there");
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(length), error);
  CsvFile file(path, error ? nullptr : std::fopen(path.c_str(), "a"));
  if (!file.file_) fail(path, "opening");
  return file;
}

long CsvFile::sync() {
  if (std::fflush(file_.get()) != 0 || fsync(fileno(file_.get())) != 0) fail(path_, "syncing");
  return std::ftell(file_.get());
}

void CsvFile::row(const std::vector<double>& values) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::fprintf(file_.get(), k == 0 ? "%.9g" : ",%.9g", values[k]) < 0) fail(path_, "writing");
  if (std::fputc('\n', file_.get()) == EOF || std::fflush(file_.get()) != 0) fail(path_, "writing");
}

void SeriesIndex::resume(std::size_t count) {
  std::ifstream file(path_);
  entries_.clear();
  try {
    const auto index = nlohmann::json::parse(file);
    for (const auto& entry : index.at("files"))
      if (entries_.size() < count) entries_.emplace_back(entry.at("name"), entry.at("time"));
  } catch (const nlohmann::json::exception&) {
  }
  if (entries_.size() < count)
    throw FileError(path_ + ": has fewer entries than when the checkpoint was written (" +
                    std::to_string(count) + "); put back what was there");
}

void SeriesIndex::add(const std::string& name, double time_s) {
  entries_.emplace_back(name, time_s);
  nlohmann::json index{{"file-series-version", "1.0"}, {"files", nlohmann::json::array()}};
  for (const auto& [file, time] : entries_)
    index["files"].push_back({{"name", file}, {"time", time}});
  replace_file(path_, index.dump(1) + "\n");
}

}  // namespace hemomag::io
