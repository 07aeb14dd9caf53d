#include "io/field_table_file.hpp"

#include <cctype>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "io/input_file.hpp"

namespace hemomag::io {
namespace {

constexpr std::string_view header = "x_m,y_m,z_m,Bx_T,By_T,Bz_T";
constexpr std::size_t least_points = 4;      // along an axis, of a cubic
constexpr double position_tolerance = 1e-6;  // of the spacing

struct Row {
  Vec3 x, B;
  std::size_t left;  // bytes of the file behind the row, from which its line follows
};

std::vector<std::string_view> fields(std::string_view line) {
  std::vector<std::string_view> found;
  for (;;) {
    const auto comma = line.find(',');
    const auto parts = words(line.substr(0, comma));
    found.push_back(parts.size() == 1 ? parts[0] : line.substr(0, comma));
    if (comma == std::string_view::npos) return found;
    line.remove_prefix(comma + 1);
  }
}

Row read_row(const InputFile& file, std::string_view line) {
  const auto texts = fields(line);
  if (texts.size() != 6)
    file.fail("the row has " + std::to_string(texts.size()) + " columns; accepted: six, " +
              std::string(header));
  double value[6];
  for (std::size_t k = 0; k < 6; ++k) {
    value[k] = file.number(texts[k]);
    if (!std::isfinite(value[k]))
      file.fail(in_quotes(texts[k]) + " is not finite; accepted: finite numbers");
  }
  return {{value[0], value[1], value[2]}, {value[3], value[4], value[5]}, file.left()};
}

std::vector<Row> read_rows(InputFile& file) {
  file.skip_byte_order_mark();
  std::string names;
  for (const char c : file.line('#', "its header"))
    if (!std::isspace(static_cast<unsigned char>(c))) names += c;
  if (names != header)
    file.fail("the header is " + in_quotes(names) + "; accepted: " + std::string(header));
  std::vector<Row> rows;
  while (const auto line = file.next_line('#')) rows.push_back(read_row(file, *line));
  return rows;
}

/// Points along each axis, from where the first coordinates of a row return to the start.
std::array<std::size_t, 3> points(const std::vector<Row>& rows, const InputFile& file) {
  const Vec3 first = rows[0].x;
  std::size_t in_row = 1, in_sheet = 1;
  while (in_row < rows.size() && rows[in_row].x.x != first.x) ++in_row;
  while (in_sheet < rows.size() && rows[in_sheet].x.z == first.z) ++in_sheet;
  const std::array<std::size_t, 3> n{in_row, in_sheet / in_row, rows.size() / in_sheet};
  for (std::size_t a = 0; a < 3; ++a)
    if (n[a] < least_points)
      throw Error(file.path() + ": has " + std::to_string(n[a]) + " points along " + "xyz"[a] +
                  "; accepted: a whole grid of at least 4 along each axis, x running fastest, z "
                  "slowest");
  if (n[0] * n[1] * n[2] != rows.size())
    throw Error(file.path() + ": has " + std::to_string(rows.size()) + " rows, a grid of " +
                std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]) +
                " needs " + std::to_string(n[0] * n[1] * n[2]) + "; accepted: a whole grid");
  return n;
}

void check_places(const lattice::FieldTable& t, const std::vector<Row>& rows,
                  const InputFile& file) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::array<std::size_t, 3> index{k % t.n[0], k / t.n[0] % t.n[1], k / t.n[0] / t.n[1]};
    for (std::size_t a = 0; a < 3; ++a) {
      const double expected = t.first[a] + static_cast<double>(index[a]) * t.spacing[a];
      if (std::fabs(rows[k].x[a] - expected) <= position_tolerance * t.spacing[a]) continue;
      char text[160];
      std::snprintf(text, sizeof text,
                    ": line %zu: %c is %.9g m; accepted: %.9g m, the next point of the grid, x "
                    "running fastest",
                    file.line_number(rows[k].left), "xyz"[a], rows[k].x[a], expected);
      throw Error(file.path() + text);
    }
  }
}

}  // namespace

lattice::FieldTable read_field_table(const std::string& path) {
  InputFile file(path);
  const std::vector<Row> rows = read_rows(file);
  if (rows.empty())
    file.fail("the file ends before the first row; accepted: " + std::string(header));
  lattice::FieldTable table;
  table.n = points(rows, file);
  table.first = rows[0].x;
  const Vec3 last = rows.back().x;
  for (std::size_t a = 0; a < 3; ++a) {
    table.spacing[a] = (last[a] - table.first[a]) / static_cast<double>(table.n[a] - 1);
    if (!(table.spacing[a] > 0))
      throw Error(path + ": " + "xyz"[a] +
                  " does not rise from the first row to the last; accepted: "
                  "a grid that rises along each axis");
  }
  check_places(table, rows, file);
  for (const Row& row : rows) table.B.push_back(row.B);
  return table;
}

}  // namespace hemomag::io
