#include "case/units.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <udunits2.h>

namespace hemomag::case_ {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};

/// The unit database, read once; UDUNITS's own messages are silenced.
ut_system* units() {
  static const std::unique_ptr<ut_system, void (*)(ut_system*)> system(
      [] {
        ut_set_error_message_handler(ut_ignore);
        return ut_read_xml(nullptr);
      }(),
      ut_free_system);
  if (!system)
    throw Error("the unit database of UDUNITS-2 cannot be read (package libudunits2-data)");
  return system.get();
}

std::string_view trim(std::string_view s) {
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.front()))) s.remove_prefix(1);
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.back()))) s.remove_suffix(1);
  return s;
}

/// UDUNITS takes much that is no plain unit: a second number ("2-3 um"), an origin ("um since
/// 2000", "um @ 3"), an angle in a rate (rpm is 2 pi/60 to it). A plain unit is words with
/// exponents between '.', '*', '/', '^' and spaces.
bool plain_unit(std::string_view unit) {
  if (unit.empty() ||
      !(std::isalpha(static_cast<unsigned char>(unit.front())) || (unit.front() & 0x80)))
    return false;
  std::string lower(unit);  // UDUNITS takes words in capitals as well
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* word : {"since", "after", "from", "ref", "rpm", "rad", "deg", "turn", "rev",
                           "arc", "cycle", "lg", "ln", "lb"})
    if (lower.find(word) != std::string::npos) return false;
  char before = ' ';
  for (const char c : unit) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isdigit(u)) {
      if (!(std::isalnum(static_cast<unsigned char>(before)) || before == '-' || before == '^' ||
            before == '+'))
        return false;
    } else if (!(std::isalpha(u) || (u & 0x80) || c == '.' || c == '*' || c == '/' || c == '^' ||
                 c == '-' || c == ' ')) {
      return false;
    }
    before = c;
  }
  return true;
}

Unit parse_unit(std::string_view text) {
  // Symbols of the field that UDUNITS reads otherwise or not at all.
  std::string spelled(text);
  for (const auto& [symbol, name] :
       {std::pair{"G", "gauss"}, {"mG", "milligauss"}, {"P", "poise"}, {"cP", "centipoise"}})
    if (text == symbol) spelled = name;
  return Unit(ut_parse(units(), spelled.c_str(), UT_UTF8));
}

}  // namespace

double quantity(std::string_view text, const Dimension& dimension) {
  const std::string expected =
      std::string(dimension.noun) + " is expected, e.g. \"" + dimension.example + "\"";
  const std::string given = '"' + std::string(text) + '"';
  const std::string_view body = trim(text);
  double number = 0;
  const char* first = body.data() + (!body.empty() && body.front() == '+' ? 1 : 0);
  const auto [rest, status] = std::from_chars(first, body.data() + body.size(), number);
  if (status != std::errc{} || !std::isfinite(number))
    throw Error(given + " does not begin with a number; " + expected);
  const std::string_view unit =
      trim({rest, static_cast<std::size_t>(body.data() + body.size() - rest)});
  if (unit.empty()) throw Error(given + " has no unit; " + expected);
  const Unit from = plain_unit(unit) ? parse_unit(unit) : nullptr;
  if (!from) throw Error("\"" + std::string(unit) + "\" is not a unit; " + expected);
  const Unit to = parse_unit(dimension.unit);
  // UDUNITS also converts to the reciprocal: "200 s" would be a rate of 0.005 s-1.
  const Unit ratio(ut_divide(from.get(), to.get()));
  if (!ratio || !ut_is_dimensionless(ratio.get()))
    throw Error(given + " is not " + dimension.noun + "; " + expected);
  const std::unique_ptr<cv_converter, FreeConverter> convert(
      ut_get_converter(from.get(), to.get()));
  if (!convert) throw Error("\"" + std::string(unit) + "\" cannot be converted; " + expected);
  return cv_convert_double(convert.get(), number);
}

}  // namespace hemomag::case_
