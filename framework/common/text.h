#pragma once

#include <string>

#include "framework/common/file.h"

namespace pintle {

/// A field of a CSV file, in quotes where it must be.
std::string csv_field(const std::string&);
/// The shortest decimal that reads back as x; nothing for NaN, which is an empty field.
void append_number(std::string& out, double x);

}  // namespace pintle
