#pragma once

#include <string>

#include "fmi/contents.h"

namespace pintle::app {

/// modelDescription.xml of an FMU. @param identifier  name of its shared library
std::string model_description(const fmi::FmuContents&, const std::string& identifier);

/// documentation/index.html: the variables as a table.
std::string variables_page(const fmi::FmuContents&);

}  // namespace pintle::app
