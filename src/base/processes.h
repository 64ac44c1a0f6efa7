// One program run as several processes, on one machine or many: mpirun -n 4 tendril study.lua.
//
// Every process runs the whole script; what can be divided is, and all of them get the whole answer. Only the first one
// prints and writes files. MPI lies in a module that is loaded in a process that mpirun started, and in no other.
#pragma once

#include <string>
#include <vector>

namespace tendril {

/// Which process this is, and of how many. 0 of 1 without mpirun.
int process_rank();
int process_count();

/// True in the one process that prints and writes files.
inline bool is_first_process() { return process_rank() == 0; }

/// The bytes of every process, by rank. All processes must call it, in the same order of calls. Throws UsageError where the module
/// of MPI cannot be loaded.
std::vector<std::string> gathered(const std::string& mine);

}  // namespace tendril
