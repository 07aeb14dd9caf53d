// LAMMPS's public headers include its private copy of the fmt library, which Debian's package does not ship.
// These declarations are the few that the headers mention, in the namespace the library was built with, so that
// they compile. Nothing here formats: call Error and utils with a finished std::string.
#pragma once
#include <cstddef>
#include <string>

namespace fmt {
inline namespace v7_lmp {

template <typename Char>
class basic_string_view {
 public:
  basic_string_view(const Char* text) : data_(text), size_(std::char_traits<Char>::length(text)) {}
  basic_string_view(const std::basic_string<Char>& text) : data_(text.data()), size_(text.size()) {}

 private:
  const Char* data_;
  std::size_t size_;
};
using string_view = basic_string_view<char>;

struct format_args {};

template <typename... Args, typename Format>
format_args make_args_checked(const Format&, const Args&...) {
  static_assert(sizeof(Format) == 0, "format the text first and pass one std::string");
  return {};
}

}  // namespace v7_lmp
}  // namespace fmt
