#pragma once

#include <string_view>

/// What is fuzzed: each reads some bytes as a file of its kind. To refuse them is right; to crash, hang or report nonsense is not.
namespace pintle {

void fuzz_scene(std::string_view);
void fuzz_study(std::string_view);
void fuzz_table(std::string_view);
void fuzz_inp(std::string_view);
void fuzz_wire(std::string_view);  ///< what the mesher's process says
void fuzz_msh(std::string_view);
void fuzz_state(std::string_view);    ///< of --restart: as it is, and with identity and checksum made right
void fuzz_journal(std::string_view);  ///< of a sweep: as it is, and with the lines' checksums made right

}  // namespace pintle
