// Files of B on a grid: what is read, and what is refused with its line.
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/error.hpp"
#include "io/field_table_file.hpp"

namespace {

using namespace hemomag;

const std::string header = "x_m,y_m,z_m,Bx_T,By_T,Bz_T\n";

class FieldTables : public testing::Test {
protected:
  void TearDown() override { std::filesystem::remove(path_); }

  lattice::FieldTable read(const std::string& text) {
    std::ofstream(path_) << text;
    return io::read_field_table(path_);
  }

  void refused(const std::string& text, const std::string& place, const std::string& says) {
    try {
      read(text);
      FAIL() << "read without a word; expected: " << says;
    } catch (const Error& e) {
      const std::string message = e.what();
      EXPECT_EQ(message.rfind(path_ + ": " + place, 0), 0u) << message;
      EXPECT_NE(message.find(says), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }

  std::string path_ = (std::filesystem::temp_directory_path() /
                       ("hemomag_field_table_" + std::to_string(getpid()) + ".csv"))
                          .string();
};

/// A grid of 4 x 5 x 6 points, 1, 2 and 3 um apart, from (-1, 0, 5) um.
std::string rows() {
  std::string text;
  char row[160];
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 4; ++i) {
        std::snprintf(row, sizeof row, "%d.0e-6, %de-6, %de-6, %g,%g,%g\n", i - 1, 2 * j, 3 * k + 5,
                      0.1 * i, 0.2 * j, 0.3 * k);
        text += row;
      }
  return text;
}

/// Of the file of all rows, with row `at` replaced. Row 0 is on line 2.
std::string with(std::size_t at, const std::string& row) {
  std::string text = header + rows();
  std::size_t start = 0;
  for (std::size_t k = 0; k <= at; ++k) start = text.find('\n', start) + 1;
  return text.replace(start, text.find('\n', start) - start, row);
}

TEST_F(FieldTables, AreReadWithCommentsBlanksAndAnyLineEnd) {
  std::string text = "# B of a magnet\n\n x_m, y_m ,z_m,Bx_T,By_T,Bz_T\r\n" + rows() + "\n# end";
  const auto table = read(text);
  EXPECT_EQ(table.n, (std::array<std::size_t, 3>{4, 5, 6}));
  EXPECT_LT(norm(table.first - Vec3{-1e-6, 0, 5e-6}), 1e-18);
  EXPECT_LT(norm(table.spacing - Vec3{1e-6, 2e-6, 3e-6}), 1e-18);
  ASSERT_EQ(table.B.size(), 120u);
  EXPECT_LT(norm(table.B[3 + 4 * (2 + 5 * 5)] - Vec3{0.3, 0.4, 1.5}), 1e-15);
}

TEST_F(FieldTables, OfAnotherShapeAreRefused) {
  EXPECT_THROW(io::read_field_table("absent.csv"), Error);
  refused("", "the file is empty", "");
  refused("# nothing\n", "line 1: the file ends before its header", "");
  refused("x,y,z,Bx,By,Bz\n" + rows(), "line 1: the header is 'x,y,z,Bx,By,Bz'",
          header.substr(0, 26));
  refused("x_mm,y_mm,z_mm,Bx_T,By_T,Bz_T\n" + rows(), "line 1: the header", "accepted: x_m,");
  refused(header, "line 1: the file ends before the first row", "accepted");
  refused(with(7, "1,2,3,4,5"), "line 9: the row has 5 columns", "accepted: six");
  refused(with(7, "1,2,3,4,5,6,7"), "line 9: the row has 7 columns", "accepted: six");
  refused(with(7, "2e-6,2e-6,5e-6,0,tesla,0"), "line 9: 'tesla' is not a number", "");
  refused(with(7, "2e-6,2e-6,5e-6,0,,0"), "line 9: '' is not a number", "");
  refused(with(7, "2e-6,2e-6,5e-6,0,1 2,0"), "line 9: '1 2' is not a number", "");
  refused(with(7, "2e-6,2e-6,5e-6,0,nan,0"), "line 9: 'nan' is not finite", "accepted");
  refused(with(7, "2e-6,2e-6,5e-6,0,inf,0"), "line 9: 'inf' is not finite", "accepted");
}

TEST_F(FieldTables, OffTheirGridAreRefused) {
  refused(with(7, "2.1e-6,2e-6,5e-6,0,0,0"), "line 9: x is 2.1e-06 m", "accepted: 2e-06 m");
  refused(with(50, "1e-6,4e-6,11.01e-6,0,0,0"), "line 52: z is", "accepted: 1.1e-05 m");
  std::string text = header + rows();
  refused(text.substr(0, text.rfind('\n', text.size() - 2) + 1), "has 119 rows", "needs 100");
  refused(header + rows() + rows(), "", "accepted");
  refused(header + rows().substr(0, rows().find('\n', 60) + 1), "has ", "accepted: a whole grid of at least 4");
  // Three planes along z.
  std::size_t end = 0;
  for (int k = 0; k < 60; ++k) end = rows().find('\n', end) + 1;
  refused(header + rows().substr(0, end), "has 3 points along z", "at least 4");
  // z fastest: each row is at the first x and y of the next.
  std::string turned = header;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k)
        turned +=
            std::to_string(i) + "," + std::to_string(j) + "," + std::to_string(k) + ",0,0,0\n";
  refused(turned, "", "x running fastest");
  std::string falling = header;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 4; i > 0; --i)
        falling +=
            std::to_string(i) + "," + std::to_string(j) + "," + std::to_string(k) + ",0,0,0\n";
  refused(falling, "x does not rise", "accepted");
}

}  // namespace
