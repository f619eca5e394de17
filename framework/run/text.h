#pragma once

#include <filesystem>
#include <string>

namespace pintle {

/// A field of a CSV file, in quotes where it must be.
std::string csv_field(const std::string&);
/// The shortest decimal that reads back as x; nothing for NaN, which is an empty field.
void append_number(std::string& out, double x);
/// A file, whole or not at all: to a neighbour first, which then takes the name.
/// @throws std::runtime_error  naming the path that cannot be written, and why
void write_text(const std::filesystem::path&, const std::string&);

}  // namespace pintle
