#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/common/printed.h"
#include "framework/plots/plot.h"

/// The page on Ebrahimi, Salahshoor and Moradi (2017): see page.cpp.
namespace paper {

using Vector = std::vector<double>;
const std::filesystem::path source = PINTLE_SOURCE_DIR;
const double pi = std::acos(-1.0);

using pintle::Curve;
using pintle::Panel;
using pintle::printed;

/// Of a heading, as a link names it.
std::string anchor(const std::string& title);
void write(const std::filesystem::path& file, const std::string& content);
void figure(const std::string& name, const std::vector<Panel>& panels, std::size_t columns = 2);

}  // namespace paper
