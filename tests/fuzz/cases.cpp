// Case files with the files they name, up to the card: all that is checked before anything is
// written. An input is the text of a case; a line "#set KEY=VALUE" in it is an override, and a line
// "#file NAME" begins the file of that name, up to the next such line.
#include <array>
#include <sstream>
#include <vector>

#include "case/card.hpp"
#include "case/case_file.hpp"
#include "case/cell_model.hpp"
#include "case/packed_file.hpp"
#include "case/same_case.hpp"
#include "contract.hpp"

namespace {

using namespace hemomag;

constexpr std::array<const char*, 4> names = {"case.toml", "cell.off", "B.csv", "packed.data"};

/// Writes the files of an input, and removes those of the one before that it does not have.
/// @return the overrides
std::vector<std::string> write_files(std::string_view input) {
  std::array<std::string, names.size()> files;
  std::vector<std::string> overrides;
  std::string* file = &files[0];
  std::istringstream lines{std::string(input)};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#set ")) {
      overrides.push_back(line.substr(5));
    } else if (line.starts_with("#file ")) {
      for (std::size_t k = 1; k < names.size(); ++k)
        if (line.substr(6) == names[k]) file = &files[k];
    } else {
      *file += line + (lines.eof() ? "" : "\n");
    }
  }
  for (std::size_t k = 0; k < names.size(); ++k)
    if (k == 0 || !files[k].empty())
      fuzz::directory().write(names[k], files[k]);
    else
      std::filesystem::remove(fuzz::directory().path() / names[k]);
  return overrides;
}

/// Meshes of the program's own, and looking at many fields at many instants, take seconds: too long
/// to try thousands.
bool quickly_made(const case_::Case& c) {
  for (const auto& cell : c.cells)
    if (!cell.surface) return false;
  for (const auto& source : c.magnetic.sources)
    if (source.time != case_::TimeCourse::constant || source.field == case_::FieldKind::rotating)
      return false;
  return c.cells.size() <= 4 && c.magnetic.sources.size() <= 1;
}

void read(const std::vector<std::string>& overrides) {
  const auto path = (fuzz::directory().path() / names[0]).string();
  const case_::Case c = case_::read_case(path, overrides);
  case_::require_same_case(c, c.text);
  if (!quickly_made(c)) return;
  const auto models = case_::cell_models(c);
  case_::make_card(c, models);
  if (!c.cells.empty() && c.cells[0].placement == case_::Placement::file)
    case_::read_packed(c, models);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input = fuzz::bytes(data, size);
  auto overrides = write_files(input);
  // A vessel's nodes are looked at one by one. All get the same box, lest one that is large counts
  // as a hang.
  if (input.find("voxels") != std::string_view::npos) {
    overrides.emplace_back(R"(channel.size=["8 um", "8 um", "8 um"])");
    overrides.emplace_back("numerics.dx=0.5 um");
  }
  fuzz::value_or_error([&] { read(overrides); });
  return 0;
}
