#include "io/surface_file.hpp"

#include <cctype>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "base/error.hpp"
#include "io/input_file.hpp"
#include "lattice/closed_surface.hpp"

namespace hemomag::io {
namespace {

using lattice::Surface;

void add_point(Surface& surface, const Vec3& x) { surface.points.push_back(x); }

/// Cuts a polygon into a fan about its first corner. That the corners are points is for `closed` to
/// see, since a file may list its faces first.
void add_polygon(Surface& surface, const std::vector<int>& corners, const InputFile& file) {
  if (corners.size() < 3)
    file.fail("a face has " + std::to_string(corners.size()) + " corners; accepted are 3 or more");
  for (std::size_t k = 2; k < corners.size(); ++k)
    surface.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

/// Refuses a count of things that take at least `least` bytes each in what is left of the file.
void require_room(const InputFile& file, std::size_t count, std::size_t least, const char* what) {
  if (count > file.left() / least)
    file.fail("counts " + std::to_string(count) + " " + what + ", but only " +
              std::to_string(file.left()) + " bytes follow");
}

// STL: the corners of each triangle, without an index.

constexpr std::size_t stl_header = 80, stl_head = 84, stl_triangle = 50;

std::uint64_t stl_count(const std::string& bytes) {
  std::uint64_t n = 0;
  for (std::size_t k = 0; k < 4; ++k)
    n |= std::uint64_t{static_cast<unsigned char>(bytes[stl_header + k])} << (8 * k);
  return n;
}

/// A file whose size fits its count is binary whatever it begins with: read as a count, four
/// characters of a text ask for a file of 7 GB. Any other file is a text if it begins with "solid"
/// and has no control characters where a binary file has its header and count.
bool is_stl_text(const std::string& bytes) {
  if (bytes.size() >= stl_head && bytes.size() == stl_head + stl_triangle * stl_count(bytes))
    return false;
  const auto head = std::string_view(bytes).substr(0, stl_head);
  const auto first = words(head);
  if (first.empty() || lower_case(first[0]) != "solid") return false;
  for (unsigned char c : head)
    if (std::iscntrl(c) && !std::isspace(c)) return false;
  return true;
}

Surface read_stl_text(InputFile& file) {
  constexpr const char* facet_end = "the end of a facet";
  Surface surface;
  do {
    file.expect("solid");
    file.rest_of_line();  // the name, which may hold anything
    for (;;) {
      const auto next = file.word("'endsolid'");
      if (lower_case(next) == "endsolid") break;
      if (lower_case(next) != "facet")
        file.fail(in_quotes(next) + " where 'facet' or 'endsolid' must be");
      file.expect("normal");
      for (int d = 0; d < 3; ++d) file.word(facet_end);
      file.expect("outer");
      file.expect("loop");
      const int first = static_cast<int>(surface.points.size());
      for (int k = 0; k < 3; ++k) {
        file.expect("vertex");
        Vec3 x;
        for (std::size_t d = 0; d < 3; ++d) x[d] = file.number(file.word(facet_end));
        add_point(surface, x);
      }
      file.expect("endloop");
      file.expect("endfacet");
      surface.triangles.push_back({first, first + 1, first + 2});
    }
    file.rest_of_line();
    file.skip_blanks();
  } while (file.left() > 0);
  return surface;
}

Surface read_stl_binary(InputFile& file) {
  file.content_is(InputFile::Content::Binary);
  const auto size = file.bytes().size();
  if (size < stl_head)
    file.fail("has " + std::to_string(size) +
              " bytes; accepted are STL texts, which begin with 'solid', and binary STL, which has "
              "84 or more");
  const auto n = stl_count(file.bytes());
  if (size != stl_head + stl_triangle * n)
    file.fail("counts " + std::to_string(n) + " triangles, for which binary STL has " +
              std::to_string(stl_head + stl_triangle * n) + " bytes, but it has " +
              std::to_string(size));
  constexpr const char* end = "the end of a triangle";
  Surface surface;
  file.skip(stl_head, end);
  for (std::uint64_t t = 0; t < n; ++t) {
    file.skip(3 * sizeof(float), end);  // the normal
    const int first = static_cast<int>(surface.points.size());
    for (int k = 0; k < 3; ++k) {
      Vec3 x;
      for (std::size_t d = 0; d < 3; ++d) x[d] = file.raw<float>(std::endian::little, end);
      add_point(surface, x);
    }
    file.skip(2, end);  // the attribute count
    surface.triangles.push_back({first, first + 1, first + 2});
  }
  return surface;
}

Surface read_stl(InputFile& file) {
  Surface surface = is_stl_text(file.bytes()) ? read_stl_text(file) : read_stl_binary(file);
  lattice::weld(surface, file.path());
  return surface;
}

// OFF: counts, points, and polygons of indices; a line each, colours and the like behind.

bool is_off_keyword(std::string_view word) {
  for (const std::string_view extra : {"ST", "C", "N"})
    if (word.starts_with(extra)) word.remove_prefix(extra.size());
  return word == "OFF";
}

Surface read_off(InputFile& file) {
  constexpr char comment = '#';
  auto head = words(file.line(comment, "'OFF'"));
  if (!is_off_keyword(head[0])) file.fail(in_quotes(head[0]) + " where 'OFF' must be");
  head.erase(head.begin());
  if (head.empty()) head = words(file.line(comment, "the counts"));
  if (head.size() < 2) file.fail("accepted are the counts of points, faces and edges");
  const auto n_points = file.whole(file.number(head[0]), "the count of points");
  const auto n_faces = file.whole(file.number(head[1]), "the count of faces");
  require_room(file, n_points, std::string_view("0 0 0").size(), "points");
  require_room(file, n_faces, std::string_view("3 0 1 2").size(), "faces");

  Surface surface;
  for (std::size_t i = 0; i < n_points; ++i) {
    const auto row = words(file.line(comment, "the last point"));
    if (row.size() < 3) file.fail("a point has three coordinates");
    add_point(surface, {file.number(row[0]), file.number(row[1]), file.number(row[2])});
  }
  std::vector<int> corners;
  for (std::size_t f = 0; f < n_faces; ++f) {
    const auto row = words(file.line(comment, "the last face"));
    const auto n = file.whole(file.number(row[0]), "the count of corners");
    if (n > row.size() - 1)
      file.fail("a face of " + std::to_string(n) + " corners names " +
                std::to_string(row.size() - 1));
    corners.clear();
    for (std::size_t k = 1; k <= n; ++k)
      corners.push_back(static_cast<int>(file.whole(file.number(row[k]), "a corner")));
    add_polygon(surface, corners, file);
  }
  return surface;
}

// PLY: a header that names elements and their properties, then the elements, in text or binary.

enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

struct PlyProperty {
  std::string name;
  PlyType type;                  ///< of the value, or of each value of a list
  std::optional<PlyType> count;  ///< of a list: the type of its length
};

struct PlyElement {
  std::string name;
  std::size_t count;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::optional<std::endian> order;  ///< none for a text
  std::vector<PlyElement> elements;
};

PlyType ply_type(const InputFile& file, std::string_view word) {
  constexpr std::array<std::array<std::string_view, 2>, 8> names{{{"char", "int8"},
                                                                  {"uchar", "uint8"},
                                                                  {"short", "int16"},
                                                                  {"ushort", "uint16"},
                                                                  {"int", "int32"},
                                                                  {"uint", "uint32"},
                                                                  {"float", "float32"},
                                                                  {"double", "float64"}}};
  for (std::size_t k = 0; k < names.size(); ++k)
    if (word == names[k][0] || word == names[k][1]) return static_cast<PlyType>(k);
  file.fail(in_quotes(word) + " is not a type of PLY");
}

std::optional<std::endian> ply_order(const InputFile& file, std::string_view word) {
  if (word == "ascii") return std::nullopt;
  if (word == "binary_little_endian") return std::endian::little;
  if (word == "binary_big_endian") return std::endian::big;
  file.fail(in_quotes(word) +
            " is not accepted; ascii, binary_little_endian and binary_big_endian are");
}

PlyProperty ply_property(const InputFile& file, const std::vector<std::string_view>& row) {
  if (row.size() == 3) return {std::string(row[2]), ply_type(file, row[1]), std::nullopt};
  if (row.size() == 5 && row[1] == "list")
    return {std::string(row[4]), ply_type(file, row[3]), ply_type(file, row[2])};
  file.fail("accepted are 'property TYPE NAME' and 'property list TYPE TYPE NAME'");
}

PlyHeader read_ply_header(InputFile& file) {
  file.expect("ply");
  file.rest_of_line();
  PlyHeader header;
  bool has_format = false;
  for (;;) {
    const auto row = words(file.line('\0', "'end_header'"));
    if (row[0] == "end_header") break;
    if (row[0] == "comment" || row[0] == "obj_info") continue;
    if (row[0] == "format" && row.size() == 3) {
      header.order = ply_order(file, row[1]);
      has_format = true;
    } else if (row[0] == "element" && row.size() == 3) {
      header.elements.push_back(
          {std::string(row[1]), file.whole(file.number(row[2]), "the count of an element"), {}});
    } else if (row[0] == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(ply_property(file, row));
    } else {
      file.fail(in_quotes(row[0]) + " is not accepted here in a PLY header");
    }
  }
  if (!has_format) file.fail("the PLY header has no 'format'");
  return header;
}

double ply_value(InputFile& file, std::optional<std::endian> order, PlyType type) {
  constexpr const char* end = "the last value";
  if (!order) return file.number(file.word(end));
  switch (type) {
  case PlyType::Int8:
    return file.raw<std::int8_t>(*order, end);
  case PlyType::UInt8:
    return file.raw<std::uint8_t>(*order, end);
  case PlyType::Int16:
    return file.raw<std::int16_t>(*order, end);
  case PlyType::UInt16:
    return file.raw<std::uint16_t>(*order, end);
  case PlyType::Int32:
    return file.raw<std::int32_t>(*order, end);
  case PlyType::UInt32:
    return file.raw<std::uint32_t>(*order, end);
  case PlyType::Float:
    return file.raw<float>(*order, end);
  case PlyType::Double:
    return file.raw<double>(*order, end);
  }
  file.fail("a type of PLY without a size");
}

/// Reads one vertex, face or other element; what is of no use is passed over.
void read_ply_row(InputFile& file, std::optional<std::endian> order, const PlyElement& element,
                  Surface& surface) {
  Vec3 x;
  std::vector<int> corners;
  for (const PlyProperty& property : element.properties) {
    if (!property.count) {
      const double value = ply_value(file, order, property.type);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
        x[static_cast<std::size_t>(property.name[0] - 'x')] = value;
      continue;
    }
    const bool names_corners = element.name == "face" && property.name.starts_with("vertex_ind");
    const auto n = file.whole(ply_value(file, order, *property.count), "the length of a list");
    require_room(file, n, 1, "values of a list");
    for (std::size_t k = 0; k < n; ++k) {
      const double value = ply_value(file, order, property.type);
      if (names_corners) corners.push_back(static_cast<int>(file.whole(value, "a corner")));
    }
  }
  if (element.name == "vertex") add_point(surface, x);
  if (element.name == "face") add_polygon(surface, corners, file);
}

void require_ply_property(const InputFile& file, const PlyElement& element, const std::string& name,
                          bool is_list) {
  for (const PlyProperty& p : element.properties)
    if ((p.name == name || (is_list && p.name == "vertex_index")) && p.count.has_value() == is_list)
      return;
  file.fail("element '" + element.name + "' has no property " + name);
}

Surface read_ply(InputFile& file) {
  const PlyHeader header = read_ply_header(file);
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex")
      for (const char* name : {"x", "y", "z"}) require_ply_property(file, element, name, false);
    if (element.name == "face") require_ply_property(file, element, "vertex_indices", true);
  }
  if (header.order) file.content_is(InputFile::Content::Binary);
  Surface surface;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;
    // Each property takes a byte at least, in a text or not.
    require_room(file, element.count, element.properties.size(), "elements");
    for (std::size_t i = 0; i < element.count; ++i)
      read_ply_row(file, header.order, element, surface);
  }
  return surface;
}

}  // namespace

lattice::Surface read_surface(const std::string& path) {
  const auto ending = lower_case(std::filesystem::path(path).extension().string());
  const auto read = ending == ".stl"   ? read_stl
                    : ending == ".off" ? read_off
                    : ending == ".ply" ? read_ply
                                       : nullptr;
  if (!read)
    throw Error(path + ": " + (ending.empty() ? "no ending" : "the ending " + in_quotes(ending)) +
                "; accepted are surfaces in .stl, .off and .ply files");
  InputFile file(path);
  return lattice::closed(read(file), path);
}

}  // namespace hemomag::io
