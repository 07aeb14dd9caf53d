#include "io/input_file.hpp"

#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>

#include "base/error.hpp"

namespace hemomag::io {
namespace {

// Keeps what a file can count, a byte or more each, within an int.
constexpr std::uintmax_t largest_file = 2'000'000'000;

bool blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::string read_file(const std::string& path) {
  std::error_code error;
  const bool regular = std::filesystem::is_regular_file(path, error);
  if (error) throw Error(path + ": opening failed: " + error.message());
  if (!regular) throw Error(path + ": opening failed: it is not a file");
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw Error(path + ": opening failed: " + error.message());
  if (size == 0) throw Error(path + ": the file is empty");
  if (size > largest_file)
    throw Error(path + ": has " + std::to_string(size) + " bytes; accepted are up to 2 GB");
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw Error(path + ": opening failed: " + std::strerror(errno));
  std::string bytes(size, '\0');
  if (std::fread(bytes.data(), 1, size, file.get()) != size) throw Error(path + ": reading failed");
  return bytes;
}

}  // namespace

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  for (std::size_t at = 0; at < line.size();) {
    const auto start = at;
    while (at < line.size() && !blank(line[at])) ++at;
    if (at > start) found.push_back(line.substr(start, at - start));
    while (at < line.size() && blank(line[at])) ++at;
  }
  return found;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::string in_quotes(std::string_view word) {
  std::string shown = "'";
  for (char c : word.substr(0, 32)) shown += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
  return shown + (word.size() > 32 ? "...'" : "'");
}

InputFile::InputFile(const std::string& path) : path_(path), bytes_(read_file(path)) {}

void InputFile::fail(const std::string& what) const {
  if (content_ == Content::Binary) throw Error(path_ + ": " + what);
  throw Error(path_ + ": line " + std::to_string(line_number(left())) + ": " + what);
}

void InputFile::skip_byte_order_mark() {
  if (at_ == 0 && bytes_.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

std::size_t InputFile::line_number(std::size_t left) const {
  const auto end = bytes_.end() - static_cast<std::ptrdiff_t>(left);
  const auto ends = static_cast<std::size_t>(std::count(bytes_.begin(), end, '\n'));
  return ends + (end != bytes_.begin() && end[-1] == '\n' ? 0 : 1);
}

std::string_view InputFile::rest_of_line() {
  const auto end = std::min(bytes_.find('\n', at_), bytes_.size());
  const auto line = std::string_view(bytes_).substr(at_, end - at_);
  at_ = std::min(end + 1, bytes_.size());
  return line;
}

std::optional<std::string_view> InputFile::next_line(char comment) {
  while (left() > 0) {
    auto line = rest_of_line();
    line = line.substr(0, line.find(comment));
    if (!std::all_of(line.begin(), line.end(), blank)) return line;
  }
  return std::nullopt;
}

std::string_view InputFile::line(char comment, const char* what) {
  if (const auto line = next_line(comment)) return *line;
  fail(std::string("the file ends before ") + what);
}

std::string_view InputFile::word(const char* what) {
  skip_blanks();
  const auto start = at_;
  while (at_ < bytes_.size() && !blank(bytes_[at_])) ++at_;
  if (at_ == start) fail(std::string("the file ends before ") + what);
  return std::string_view(bytes_).substr(start, at_ - start);
}

void InputFile::expect(const char* wanted) {
  const auto found = word(wanted);
  if (lower_case(found) != wanted)
    fail(in_quotes(found) + " where " + in_quotes(wanted) + " must be");
}

void InputFile::skip_blanks() {
  while (at_ < bytes_.size() && blank(bytes_[at_])) ++at_;
}

double InputFile::number(std::string_view word) const {
  const auto digits = word.starts_with('+') ? word.substr(1) : word;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    fail(in_quotes(word) + " is not a number that double precision holds");
  return value;
}

std::size_t InputFile::whole(double value, const char* what) const {
  if (!(value >= 0 && value <= std::numeric_limits<int>::max() && value == std::floor(value)))
    fail(std::string(what) + " is not a whole number from 0 to 2147483647");
  return static_cast<std::size_t>(value);
}

std::size_t InputFile::end_of(std::size_t n, const char* what) const {
  if (n > left()) fail(std::string("the file ends before ") + what);
  return at_ + n;
}

}  // namespace hemomag::io
