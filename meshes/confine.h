#pragma once

#include <string>
#include <vector>

namespace pintle {

/// Permanently restricts this process: it can read files in these folders and below, and has no other access to files. It cannot start
/// programs or processes or open connections: an attempt kills it (SIGSYS).
///
/// Uses Landlock (Linux 5.13 and later, if enabled) and a seccomp filter; needs no privileges.
/// @returns false  the system does not provide both; what it provides is active
bool confine(const std::vector<std::string>& folders);

}  // namespace pintle
