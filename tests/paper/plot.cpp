#include "tests/paper/plot.h"

#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace paper {

std::string f(const char* format, ...) {
  std::array<char, 2000> text;
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  return text.data();
}

void write(const std::filesystem::path& file, const std::string& content) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file);
  out << content;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
  std::cerr << "  " << file.string() << "\n";
}

void figure(const std::string& name, const std::vector<Panel>& panels, std::size_t columns) {
  write(source / "docs/paper" / (name + ".svg"), pintle::svg(panels, columns));
}

}  // namespace paper
