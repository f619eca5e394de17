#include "tests/paper/plot.h"

#include <cctype>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace paper {

std::string anchor(const std::string& title) {
  std::string out;
  for (const char c : title)
    if (std::isalnum(static_cast<unsigned char>(c)))
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ' || c == '-')
      out += '-';
  return out;
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
