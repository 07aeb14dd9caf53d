#pragma once
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace hemomag::io {

/// Replace a text file as a whole: written beside it, synced, renamed. @throws Error with path and
/// reason
void replace_file(const std::string& path, const std::string& text);

/// Make a directory; an existing one is fine. @throws Error with path and reason
void make_directory(const std::string& path);

/// Rows of numbers under a header, each on disk as soon as it is written. @throws Error with path
/// and reason
class CsvFile {
public:
  CsvFile(const std::string& path, const std::string& header);
  void row(const std::vector<double>& values);

private:
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// A `.series` index, by which ParaView knows the time of each file.
class SeriesIndex {
public:
  explicit SeriesIndex(std::string path) : path_(std::move(path)) {}
  void add(const std::string& name, double time_s);

private:
  std::string path_;
  std::vector<std::pair<std::string, double>> entries_;
};

}  // namespace hemomag::io
