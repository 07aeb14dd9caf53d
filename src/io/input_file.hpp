#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemomag::io {

/// The words of a line. Blanks are the six of C.
std::vector<std::string_view> words(std::string_view line);

std::string lower_case(std::string_view text);

/// A word of a file as a message can show it: short, printable and on one line.
std::string in_quotes(std::string_view word);

/// A file read as a whole, and how far it has been taken in. Nothing is taken beyond its end, so
/// that a wrong count costs an error and neither memory nor time.
/// @throws Error of one line with the path and, for a text, the line
class InputFile {
public:
  enum class Content { Text, Binary };

  /// @throws Error also for an empty file, one above 2 GB, and what is not a file
  explicit InputFile(const std::string& path);

  const std::string& path() const { return path_; }
  const std::string& bytes() const { return bytes_; }
  std::size_t left() const { return bytes_.size() - at_; }

  /// From here on: messages name lines of a text only. A file is a text at first.
  void content_is(Content content) { content_ = content; }
  [[noreturn]] void fail(const std::string& what) const;

  /// The rest of the line, without its end; empty at the end of the file.
  std::string_view rest_of_line();
  /// The number of the line that was taken last when `left` bytes were left.
  std::size_t line_number(std::size_t left) const;
  /// The next line that is not blank once everything from `comment` on is removed, or nothing.
  std::optional<std::string_view> next_line(char comment);
  /// The first line from here that is not blank once everything from `comment` on is removed.
  std::string_view line(char comment, const char* what);
  /// The next word, over any number of line ends.
  std::string_view word(const char* what);
  /// Takes the next word, which must be `wanted`, in capitals or not.
  void expect(const char* wanted);
  void skip_blanks();
  /// Spreadsheets begin a text with one.
  void skip_byte_order_mark();
  void skip(std::size_t n, const char* what) { at_ = end_of(n, what); }

  /// The next bytes as a number.
  template <class T> T raw(std::endian order, const char* what) {
    const auto end = end_of(sizeof(T), what);
    std::array<char, sizeof(T)> taken;
    std::copy_n(bytes_.data() + at_, sizeof(T), taken.begin());
    if (order != std::endian::native) std::reverse(taken.begin(), taken.end());
    at_ = end;
    return std::bit_cast<T>(taken);
  }

  double number(std::string_view word) const;
  /// A value that counts things or points at one.
  std::size_t whole(double value, const char* what) const;

private:
  std::size_t end_of(std::size_t n, const char* what) const;

  std::string path_, bytes_;
  std::size_t at_ = 0;
  Content content_ = Content::Text;
};

}  // namespace hemomag::io
