#pragma once

#include <string>
#include <vector>

#include "framework/mechanism/model.h"
#include "framework/scene/yaml/reader.h"

/// A scene as an FMU for co-simulation, called "unit" in messages: the data that the exporter (app/fmu) writes and its shared library
/// reads.
namespace pintle::fmi {

/// A variable of the FMU. Its value reference is its index in the list.
struct FmuVariable {
  enum Kind {
    time,
    parameter,  ///< of the scene
    input,      ///< an own state of the scene whose rate is 0
    column,     ///< of the trajectory
    happened,   ///< how often an event of the scene has acted
    contacts,   ///< how often a contact has begun
    touching    ///< whether a contact has begun and not ended
  } kind = time;
  std::string name, unit = {};  ///< SI, as in headings of columns; empty: a pure number
  std::string of = {};          ///< for a column its heading; otherwise the name of the parameter, state, event or contact
  double start = 0;             ///< of parameters and inputs
  bool output = false;          ///< of columns
};

struct FmuContents {
  std::string title;
  std::string scene;  ///< its file, in resources/scene
  std::string token;  ///< identifies the data from which the FMU is made
  Overrides set;
  std::vector<FmuVariable> variables;
  double until = 0, tolerance = 0, every = 0;  ///< of the scene's run
};

inline constexpr const char* contents_file = "pintle.json";  ///< in resources

/// The variables that an importer may set and read.
/// @param inputs, outputs  names; if there are none: all possible inputs, and the scene's `outputs`, or all columns if it has none
/// @throws SceneError  one of the names is no input or output; suggests the nearest name
std::vector<FmuVariable> variables_of(const Scene&, const Model&, const std::vector<std::string>& inputs,
                                      const std::vector<std::string>& outputs);

std::string text_of(const FmuContents&);
/// @throws std::runtime_error  the text is not from text_of
FmuContents contents_of(const std::string& text);

}  // namespace pintle::fmi
