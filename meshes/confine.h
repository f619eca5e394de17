#pragma once

#include <string>
#include <vector>

namespace pintle {

/// From now on this process can read files in these folders and below, and has no other access to files; it can start neither programs nor
/// processes and open no connection: an attempt kills it (SIGSYS). This is permanent.
///
/// Uses Landlock (Linux 5.13 and later, if enabled) and a seccomp filter; needs no privileges.
/// @returns false  the system does not offer both; what it offers is in force
bool confine(const std::vector<std::string>& folders);

}  // namespace pintle
