#pragma once

#include <string>
#include <string_view>

#include "meshes/mesher.h"

/// Tasks and meshes as bytes, exact to the bit, between the library and the mesher's process; both are from the same build.
namespace pintle {

std::string packed(const MesherTask&);
std::string packed(const Mesh&);
/// @throws std::runtime_error  the bytes end too early
MesherTask unpacked_task(std::string_view);
/// @throws std::runtime_error  the bytes end too early, or cells and groups name nodes that do not exist
Mesh unpacked_mesh(std::string_view);

/// Sends a message over a socket: its length and its bytes. @returns false: the other end is closed
bool send_message(int socket, const std::string&);

}  // namespace pintle
