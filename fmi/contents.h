#pragma once

#include <string>
#include <vector>

#include "framework/mechanism/model.h"
#include "framework/scene/yaml/reader.h"

/// A scene as a unit for co-simulation (FMU): what the exporter (app/fmu) puts into it and its shared library reads out of it.
namespace pintle::fmi {

/// A variable of the unit. Its value reference is its place in the list.
struct FmuVariable {
  enum Kind {
    time,
    parameter,  ///< of the scene
    input,      ///< an own state of the scene whose rate is 0
    column,     ///< of the trajectory
    happened,   ///< how often an event of the scene has acted
    contacts,   ///< how often a contact has begun
    touching    ///< it has begun and not ended
  } kind = time;
  std::string name, unit = {};  ///< SI, as columns write it; empty: a number
  std::string of = {};          ///< of a column its heading; of others the parameter, state, event or contact
  double start = 0;             ///< of parameters and inputs
  bool output = false;          ///< of columns
};

struct FmuContents {
  std::string title;
  std::string scene;  ///< its file, in resources/scene
  std::string token;  ///< of what the unit is made of
  Overrides set;
  std::vector<FmuVariable> variables;
  double until = 0, tolerance = 0, every = 0;  ///< of the scene's run
};

inline constexpr const char* contents_file = "pintle.json";  ///< in resources

/// What the importer of a model may set and see.
/// @param inputs, outputs  by name; none: all that can be one, and the scene's `outputs`, or all columns where it has none
/// @throws SceneError  one of them is none, with the nearest name
std::vector<FmuVariable> variables_of(const Scene&, const Model&, const std::vector<std::string>& inputs,
                                      const std::vector<std::string>& outputs);

std::string text_of(const FmuContents&);
/// @throws std::runtime_error  it is no such text
FmuContents contents_of(const std::string& text);

}  // namespace pintle::fmi
