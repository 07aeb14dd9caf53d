#include "case/packed_file.hpp"

#include <cmath>
#include <cstdio>
#include <numeric>

#include "base/error.hpp"
#include "case/cells_data.hpp"
#include "io/input_file.hpp"

namespace hemomag::case_ {
namespace {

constexpr double same_length = 1e-6;  // relative; files carry 17 digits
constexpr double same_area = 1e-5;    // relative, of a triangle at rest

/// The file's numbers in the order in which packed_data wrote them.
class PackedFile {
public:
  PackedFile(const Case& c, const std::vector<CellModel>& models)
      : c_(c), models_(models), file_(c.cells[0].packed) {}

  std::vector<System::PlacedCell> read() {
    title();
    counts();
    box();
    section("bond", "coeffs");
    pass_over(bond_types_);
    triangle_areas();
    section("dihedral", "coeffs");
    pass_over(dihedral_types_);
    auto cells = atoms();
    section("bonds");
    pass_over(bonds_);
    triangles(cells);
    return cells;
  }

private:
  std::size_t whole(const char* what) { return file_.whole(file_.number(file_.word(what)), what); }
  double number(const char* what) { return file_.number(file_.word(what)); }

  std::size_t count_of(std::initializer_list<const char*> what) {
    const std::size_t n = whole("a count");
    for (const char* word : what) file_.expect(word);
    return n;
  }

  void section(const char* first, const char* second = nullptr) {
    file_.expect(first);
    if (second) file_.expect(second);
    file_.rest_of_line();
    file_.skip_blanks();
  }

  /// Lines that the case knows itself.
  void pass_over(std::size_t lines) {
    for (std::size_t k = 0; k < lines; ++k) {
      if (file_.left() == 0) file_.fail("the file ends before " + std::to_string(lines) + " lines");
      file_.rest_of_line();
    }
  }

  void title() {
    file_.expect("hemomag:");
    for (const char* word : {"packed", "cells", "dx_m"}) file_.expect(word);
    dx_ = number("the node spacing");
    if (!(dx_ > 0)) file_.fail("the node spacing is not above 0");
    file_.expect("seed");
    seed_ = number("the seed");
  }

  void counts() {
    const std::size_t atoms = count_of({"atoms"});
    bonds_ = count_of({"bonds"});
    angles_ = count_of({"angles"});
    count_of({"dihedrals"});
    count_of({"atom", "types"});
    bond_types_ = count_of({"bond", "types"});
    angle_types_ = count_of({"angle", "types"});
    dihedral_types_ = count_of({"dihedral", "types"});
    std::size_t asked = 0, cells = 0, triangles = 0, kinds = 0;
    for (std::size_t m = 0; m < models_.size(); ++m) {
      const auto n = static_cast<std::size_t>(cell_count(c_, c_.cells[m], models_[m]));
      count_.push_back(n);
      cells += n;
      asked += n * models_[m].mesh.x.size();
      triangles += n * models_[m].mesh.triangles.size();
      kinds += models_[m].mesh.triangles.size();
    }
    if (atoms != asked || angles_ != triangles || angle_types_ != kinds)
      file_.fail("holds " + std::to_string(atoms) + " vertices with meshes of " +
                 std::to_string(angle_types_) + " triangles, and the case has " +
                 std::to_string(cells) + " cells with " + std::to_string(asked) +
                 " vertices and meshes of " + std::to_string(kinds));
  }

  void box() {
    for (std::size_t d = 0; d < 3; ++d) {
      const double low = number("the box"), high = number("the box");
      size_[d] = high - low;
      const std::string axis(1, "xyz"[d]);
      file_.expect((axis + "lo").c_str());
      file_.expect((axis + "hi").c_str());
      const double length = (high - low) * dx_;
      if (low == 0 && std::fabs(length / c_.channel.size[d] - 1) < same_length) continue;
      char text[160];
      std::snprintf(text, sizeof text, "is %.6g um long along %c, and the case %.6g um",
                    length * 1e6, "xyz"[d], c_.channel.size[d] * 1e6);
      file_.fail(text);
    }
  }

  /// Rest areas tell whether the mesh is the case's own.
  void triangle_areas() {
    section("angle", "coeffs");
    for (const CellModel& m : models_)
      for (const auto& t : m.mesh.triangles) {
        const auto words = io::words(file_.rest_of_line());
        if (words.size() != 9) file_.fail("is not a coefficient line of hemo/membrane");
        const auto x = [&](int v) { return m.mesh.x[static_cast<std::size_t>(v)]; };
        const double own = 0.5 * norm(cross(x(t[1]) - x(t[0]), x(t[2]) - x(t[0])));
        if (std::fabs(file_.number(words.back()) * dx_ * dx_ / own - 1) < same_area) continue;
        char text[160];
        std::snprintf(
            text, sizeof text,
            "its mesh is not the case's (it was packed with seed %.0f, the case has %.0f)", seed_,
            static_cast<double>(c_.seed));
        file_.fail(text);
      }
  }

  std::vector<System::PlacedCell> atoms() {
    std::vector<System::PlacedCell> cells;
    section("atoms");
    std::size_t id = 0;
    std::vector<std::size_t> left = count_;
    const auto total = std::accumulate(left.begin(), left.end(), std::size_t{0});
    while (cells.size() < total) {
      System::PlacedCell cell{0, {}};
      for (std::size_t v = 0; v == 0 || v < models_[cell.model].mesh.x.size(); ++v) {
        if (whole("an atom") != ++id) file_.fail("atoms are not numbered in order");
        if (whole("a molecule") != cells.size() + 1) file_.fail("is not of the next cell");
        const std::size_t type = whole("an atom type");
        if (v == 0) {
          if (type < 1 || type > models_.size() || left[type - 1]-- == 0)
            file_.fail("one cell more of type " + std::to_string(type) + " than the case has");
          cell.model = type - 1;
        }
        Vec3 x;
        for (std::size_t d = 0; d < 3; ++d) x[d] = number("a position");
        for (std::size_t d = 0; d < 3; ++d) x[d] += number("an image") * size_[d];
        cell.x.push_back(dx_ * x);
        if (!(norm2(cell.x.back()) < 1)) file_.fail("a position is out of bounds");
      }
      cells.push_back(std::move(cell));
    }
    return cells;
  }

  void triangles(const std::vector<System::PlacedCell>& cells) {
    section("angles");
    std::size_t row = 0, first = 1;
    for (const auto& cell : cells) {
      for (const auto& t : models_[cell.model].mesh.triangles) {
        if (whole("an angle") != ++row) file_.fail("angles are not numbered in order");
        whole("an angle type");
        for (const int v : t)
          if (whole("a vertex") != first + static_cast<std::size_t>(v))
            file_.fail("its mesh is not the case's");
      }
      first += cell.x.size();
    }
  }

  const Case& c_;
  const std::vector<CellModel>& models_;
  io::InputFile file_;
  double dx_ = 0, seed_ = 0;
  std::array<double, 3> size_{};
  std::vector<std::size_t> count_;  // cells of each entry in the case
  std::size_t bonds_ = 0, angles_ = 0, bond_types_ = 0, angle_types_ = 0, dihedral_types_ = 0;
};

}  // namespace

std::string packed_data(const Case& c, const System& system) {
  Case cells_alone = c;
  cells_alone.carriers.clear();
  char title[96];
  std::snprintf(title, sizeof title, "packed cells dx_m %.17g seed %llu", c.numerics.dx,
                static_cast<unsigned long long>(c.seed));
  cells_alone.title = title;
  return cells_data(cells_alone, {system.models, system.cells, {}, {}});
}

std::vector<System::PlacedCell> read_packed(const Case& c, const std::vector<CellModel>& models) {
  try {
    return PackedFile(c, models).read();
  } catch (const Error& e) {
    throw Error(position(c, entry_path("cell", 0, c.cells.size()) + ".placement") + ": " +
                e.what() +
                "; accepted: a state that hemomag pack wrote for this box, these cells "
                "and this seed");
  }
}

}  // namespace hemomag::case_
