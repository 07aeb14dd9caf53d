#pragma once
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <mpi.h>

namespace hemomag::io {

/// Replace a text file as a whole: written beside it, renamed, both synced. @throws FileError with
/// path and reason
void replace_file(const std::string& path, const std::string& text);

/// Make a directory; an existing one is fine. @throws Error with path and reason
void make_directory(const std::string& path);

/// Copy a file as it is. @throws FileError with path and reason
void copy_file(const std::string& from, const std::string& to);

/// Whether a path leads to a file that can be read, not to a directory or a device.
bool is_readable(const std::string& path);

/// Name of a file without the path to it.
std::string name_of(const std::string& path);

/// Make sure that a file or directory is on the disk, whoever wrote it. @throws FileError
void sync_file(const std::string& path);

/// What rank 0 says, on every rank. Collective.
std::string told_by_rank_0(MPI_Comm comm, const std::string& text);

/// Rows of numbers under a header, each given to the system as soon as it is written. @throws
/// FileError with path and reason
class CsvFile {
public:
  CsvFile(const std::string& path, const std::string& header);
  /// Go on with a file that has been written before, from where it was `length` bytes long.
  static CsvFile resume(const std::string& path, long length);
  void row(const std::vector<double>& values);
  /// Everything written so far is on the disk. @return length in bytes
  long sync();

private:
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  CsvFile(const std::string& path, std::FILE* file) : path_(path), file_(file) {}
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// A `.series` index, by which ParaView knows the time of each file.
class SeriesIndex {
public:
  explicit SeriesIndex(std::string path) : path_(std::move(path)) {}
  /// Take up the first `count` entries of an index that has been written before. @throws FileError
  void resume(std::size_t count);
  void add(const std::string& name, double time_s);

private:
  std::string path_;
  std::vector<std::pair<std::string, double>> entries_;
};

}  // namespace hemomag::io
