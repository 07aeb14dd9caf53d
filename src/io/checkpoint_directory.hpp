#pragma once
#include <string>
#include <vector>

#include <mpi.h>

namespace hemomag::io {

/// What a checkpoint says of itself.
struct CheckpointRecord {
  long step = 0;
  double wall_s = 0;  ///< that the run had taken until then
  int ranks = 1;
};

/// A checkpoint on disk is a directory of files with a manifest: their names, sizes and checksums,
/// written last. It is made under the name DIR.new and takes the name DIR once everything is on the
/// disk; the one before it becomes DIR.previous. Whenever the machine stops, one of the three is
/// whole if there ever was one:
///
///     write DIR.new, sync | remove DIR.previous | DIR -> DIR.previous | DIR.new -> DIR | sync
///
/// All functions are collective and throw FileError on every rank.

/// Name under which a checkpoint is made.
std::string unfinished(const std::string& directory);

/// Make an empty DIR.new.
/// @param bytes  that will be written: with less room on the disk nothing is begun
void begin_checkpoint(MPI_Comm comm, const std::string& directory, double bytes);

/// Remove what there is of DIR.new: half a checkpoint must not keep a full disk full.
void give_up_checkpoint(MPI_Comm comm, const std::string& directory);

/// Seal DIR.new, of which `files` are all the files, and let it take its place.
void finish_checkpoint(MPI_Comm comm, const std::string& directory,
                       const std::vector<std::string>& files, const CheckpointRecord& record);

struct WholeCheckpoint {
  std::string directory;  ///< DIR, DIR.new or DIR.previous
  CheckpointRecord record;
  std::vector<std::string> refused;  ///< later ones that are not whole: one line each, with reason
};

/// The latest whole checkpoint, every byte of it read and compared with its checksum; with none,
/// the reasons alone and an empty directory.
WholeCheckpoint find_checkpoint(MPI_Comm comm, const std::string& directory);

}  // namespace hemomag::io
