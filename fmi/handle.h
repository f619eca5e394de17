#pragma once

#include <exception>
#include <string>

#include "fmi/fmi3.h"
#include "fmi/instance.h"
#include "framework/common/library_threads.h"

namespace pintle::fmi {

/// The object to which an importer's fmi3Instance points.
struct FmuHandle {
  fmi3InstanceEnvironment environment;
  fmi3LogMessageCallback log;
  bool logs_events;
  std::string name;
  std::unique_ptr<FmuInstance> instance = nullptr;
  fmi3Status worst = fmi3OK;  ///< of the current call

  void say(fmi3Status status, const char* category, const std::string& message) noexcept {
    if (log) log(environment, status, category, message.c_str());
  }
};

/// Calls act(handle) for a function of the C interface: catches all exceptions and logs their messages.
template <class Act>
fmi3Status safely(fmi3Instance instance, const char* function, Act act) noexcept {
  if (!instance) return fmi3Error;
  auto& handle = *static_cast<FmuHandle*>(instance);
  handle.worst = fmi3OK;
  hold_library_threads();  // of whichever thread the importer calls from
  try {
    try {
      act(handle);
      return handle.worst;
    } catch (const std::exception& error) {
      handle.say(fmi3Error, "logStatusError", handle.name + ": " + function + ": " + error.what());
    }
  } catch (...) {  // not enough memory for the message
    handle.say(fmi3Error, "logStatusError", "not enough memory");
  }
  return fmi3Error;
}

}  // namespace pintle::fmi
