#pragma once

#include <string>
#include <vector>

namespace pintle {

/// From now on this process can read files in these folders and below them, and do no more with files; it can start
/// neither programs nor processes and open no connection: to try ends it (SIGSYS). There is no way back.
///
/// By Landlock (Linux 5.13 and later, if it is switched on) and a seccomp filter; needs no privileges.
/// @returns false  the system does not offer both; what it offers is in force
bool confine(const std::vector<std::string>& folders);

}  // namespace pintle
