#include "case/run_directory.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "case/cells_data.hpp"
#include "case/external_field.hpp"
#include "case/pack.hpp"
#include "case/packed_file.hpp"
#include "case/run_lock.hpp"
#include "io/files.hpp"

namespace hemomag::case_ {
namespace {

namespace fs = std::filesystem;

constexpr const char* accepted_by_force =
    "; accepted with --force: the directory of a run or a packing, or an empty one";

[[noreturn]] void exists_already(const std::string& out) {
  throw Error("hemomag: --out " + out +
              ": exists already; accepted: another directory, or --force to replace it");
}

/// Below a directory, and not the copy that a run keeps there.
bool would_be_lost(const std::string& path, const std::string& copy, const fs::path& directory) {
  const fs::path file = fs::weakly_canonical(path);
  const auto [end, other] =
      std::mismatch(directory.begin(), directory.end(), file.begin(), file.end());
  return end == directory.end() && file != directory / copy;
}

/// A directory is made with those above it, of which the last that is there must be one.
void require_parent(const std::string& out, const std::string& head) {
  fs::path above = fs::absolute(out).parent_path();
  while (!fs::exists(above)) above = above.parent_path();
  if (!fs::is_directory(above))
    throw Error(head + above.string() + " is no directory; accepted: a directory that can be made");
}

}  // namespace

std::vector<CaseFile> files_of(const Case& c) {
  std::vector<CaseFile> files;
  if (const std::string copy = geometry_copy(c); !copy.empty())
    files.push_back({"channel.geometry", c.channel.geometry, copy});
  if (!c.cells.empty() && c.cells[0].placement == Placement::file)
    files.push_back(
        {entry_path("cell", 0, c.cells.size()) + ".placement", c.cells[0].packed, packed_copy});
  for (std::size_t k = 0; k < c.cells.size(); ++k)
    if (const std::string copy = mesh_copy(c, k); !copy.empty())
      files.push_back({entry_path("cell", k, c.cells.size()) + ".mesh", c.cells[k].mesh, copy});
  for (const MagneticSource& source : c.magnetic.sources)
    if (source.table) files.push_back({"magnetic.file", source.file, table_copy(source)});
  return files;
}

std::string whole_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw Error(path + ": cannot be read");
  return content;
}

void add_copies(const Case& c, Files& files) {
  for (const auto& file : files_of(c)) files[file.copy] = whole_file(file.path);
}

void require_free(const Case& c, const RunOptions& options) {
  const std::string& out = options.out;
  const std::string head = "hemomag: --out " + out + ": ";
  std::error_code trouble;
  const auto found = fs::status(out, trouble);
  if (found.type() == fs::file_type::none)
    throw Error(head + trouble.message() + "; accepted: a directory that can be made");
  if (!fs::exists(found)) return require_parent(out, head);
  if (!options.force) exists_already(out);
  if (!fs::is_directory(out)) throw Error(head + "is no directory" + accepted_by_force);
  const fs::path directory = fs::canonical(out);
  const bool ours = RunLock::was_here(out) || fs::exists(directory / packing_report);
  if (!ours && !fs::is_empty(directory))
    throw Error(head + "holds other things than a run, which would be lost" + accepted_by_force);
  std::vector<CaseFile> files = files_of(c);
  files.push_back({"", c.file, "case.toml"});
  for (const auto& file : files)
    if (would_be_lost(file.path, file.copy, directory))
      throw Error(head + "holds " + file.path + " of the case, which would be lost" +
                  accepted_by_force + " without it");
}

void write_directory(const RunOptions& options, const Files& files) {
  for (const auto& entry : fs::directory_iterator(options.out)) {
    if (entry.path().filename() == RunLock::name) continue;
    if (!options.force) exists_already(options.out);
    fs::remove_all(entry.path());
  }
  for (const auto& [name, content] : files) io::replace_file(options.out + "/" + name, content);
}

}  // namespace hemomag::case_
