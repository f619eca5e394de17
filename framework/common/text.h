#pragma once

#include <cstddef>
#include <string>

namespace pintle {

/// A field of a CSV file, in quotes if necessary.
std::string csv_field(const std::string&);
/// A number for messages, with this many significant digits: "0.1".
std::string number_text(double, int digits = 4);
/// "1 number", "2 numbers".
std::string counted(std::size_t n, const std::string& what);
/// In double quotes.
std::string quoted(const std::string&);
/// The shortest decimal that reads back as x; an empty field for NaN.
void append_number(std::string& out, double x);
std::string number_exactly(double x);  ///< the same as a text of its own

}  // namespace pintle
