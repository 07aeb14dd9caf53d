#include "io/checkpoint_directory.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "io/checksum.hpp"
#include "io/files.hpp"

namespace hemomag::io {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* manifest = "manifest.json";
constexpr int format = 1;
constexpr int deepest = 4;  // a manifest nests less, and what is nested is written by recursion

std::string text(std::uint64_t sum) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016" PRIx64, sum);
  return digits;
}

/// Rank 0 works; a failure of it is thrown on every rank, as a file's.
void on_rank_0(MPI_Comm comm, const std::function<void()>& work) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::string said;
  if (rank == 0) {
    try {
      work();
    } catch (const std::exception& e) {
      said = e.what();
    }
  }
  said = told_by_rank_0(comm, said);
  if (!said.empty()) throw FileError(said);
}

/// Checksum over the manifest itself: one bit of the list changed is seen like one of a file.
std::string seal(json m) {
  m.erase("seal");
  const std::string all = m.dump();
  return text(checksum_of(all));
}

struct Candidate {
  std::string directory;
  json manifest;
};

/// The manifest of a directory. @throws FileError when it is not there or damaged
json read_manifest(const std::string& directory) {
  const std::string path = directory + "/" + manifest;
  std::ifstream file(path);
  if (!file) throw FileError(directory + ": has no " + manifest);
  json m;
  try {
    m = json::parse(file, [&](int depth, json::parse_event_t, const json&) {
      if (depth > deepest) throw FileError(path + ": is damaged");
      return true;
    });
    if (m.at("seal").get<std::string>() != seal(m)) throw FileError(path + ": is damaged");
    if (m.at("format") != format)
      throw FileError(path + ": is of another format than this version reads");
    for (const char* count : {"step", "ranks"})
      if (!m.at(count).is_number_integer()) throw FileError(path + ": is damaged");
    static_cast<void>(m.at("wall_s").get<double>());
    for (const auto& f : m.at("files"))
      static_cast<void>(f.at("name").get<std::string>() + f.at("xxh3").get<std::string>());
  } catch (const json::exception&) {
    throw FileError(path + ": is damaged");
  }
  return m;
}

/// Compare every file with its checksum. Collective. @throws FileError on every rank
void verify(MPI_Comm comm, const Candidate& c) {
  for (const auto& f : c.manifest.at("files")) {
    const std::string path = c.directory + "/" + f.at("name").get<std::string>();
    if (text(checksum(comm, path)) != f.at("xxh3").get<std::string>())
      throw FileError(path + ": differs from its checksum");
  }
}

/// Give a whole checkpoint its name, and the one that bears it the name of the previous one. A
/// process that ends on the way leaves all that is needed to do the same again.
void put_in_place(const std::string& directory) {
  const std::string previous = directory + ".previous";
  if (fs::exists(directory)) {
    fs::remove_all(previous);
    fs::rename(directory, previous);
  }
  fs::rename(unfinished(directory), directory);
  sync_file(fs::absolute(directory).parent_path().string());
}

/// Every rank's part of a file is on the disk, whichever machine the rank is on.
void sync_on_all(MPI_Comm comm, const std::string& path) {
  std::string said;
  try {
    sync_file(path);
  } catch (const FileError& e) {
    said = e.what();
  }
  int mine = said.empty(), all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, comm);
  if (!all) throw FileError(said.empty() ? path + ": syncing failed on another rank" : said);
}

}  // namespace

std::string unfinished(const std::string& directory) { return directory + ".new"; }

void begin_checkpoint(MPI_Comm comm, const std::string& directory, double bytes) {
  on_rank_0(comm, [&] {
    // One that is whole may bear this name: the run stopped just before the last rename.
    if (fs::exists(unfinished(directory) + "/" + manifest)) put_in_place(directory);
    fs::remove_all(unfinished(directory));
    make_directory(unfinished(directory));
    const double room = static_cast<double>(fs::space(unfinished(directory)).available);
    if (room >= bytes) return;
    fs::remove_all(unfinished(directory));
    char numbers[100];
    std::snprintf(numbers, sizeof numbers, "%.1f MB are needed, the disk has room for %.1f MB",
                  bytes / 1e6, room / 1e6);
    throw FileError(unfinished(directory) + ": " + numbers);
  });
}

void give_up_checkpoint(MPI_Comm comm, const std::string& directory) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::error_code ignored;
  if (rank == 0) fs::remove_all(unfinished(directory), ignored);
}

void finish_checkpoint(MPI_Comm comm, const std::string& directory,
                       const std::vector<std::string>& files, const CheckpointRecord& record) {
  const std::string fresh = unfinished(directory);
  for (const auto& name : files) sync_on_all(comm, fresh + "/" + name);
  json m{{"format", format},
         {"step", record.step},
         {"wall_s", record.wall_s},
         {"ranks", record.ranks},
         {"files", json::array()}};
  for (const auto& name : files)
    m["files"].push_back({{"name", name}, {"xxh3", text(checksum(comm, fresh + "/" + name))}});
  m["seal"] = seal(m);
  on_rank_0(comm, [&] {
    replace_file(fresh + "/" + manifest, m.dump(1) + "\n");
    put_in_place(directory);
  });
}

WholeCheckpoint find_checkpoint(MPI_Comm comm, const std::string& directory) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  // Rank 0 reads what there is; all get it as text.
  json found{{"candidates", json::array()}, {"refused", json::array()}};
  const std::vector<std::string> names{directory, unfinished(directory), directory + ".previous"};
  if (rank == 0)
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (!fs::exists(names[k])) continue;
      try {
        found["candidates"].push_back({{"name", k}, {"manifest", read_manifest(names[k])}});
      } catch (const FileError& e) {
        found["refused"].push_back(e.what());
      }
    }
  found =
      json::parse(told_by_rank_0(comm, found.dump(-1, ' ', false, json::error_handler_t::replace)));

  std::vector<Candidate> candidates;
  for (const auto& c : found["candidates"])
    candidates.push_back({names[c.at("name").get<std::size_t>()], c.at("manifest")});
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.manifest.at("step").template get<long>() > b.manifest.at("step").template get<long>();
  });
  WholeCheckpoint result;
  for (const auto& line : found["refused"]) result.refused.push_back(line);
  for (const auto& c : candidates) {
    try {
      verify(comm, c);
    } catch (const FileError& e) {
      result.refused.push_back(e.what());
      continue;
    }
    result.directory = c.directory;
    result.record = {c.manifest.at("step"), c.manifest.at("wall_s"), c.manifest.at("ranks")};
    return result;
  }
  return result;
}

}  // namespace hemomag::io
