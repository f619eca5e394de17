// The C interface: the supported functions. Those not supported are in unsupported.cpp.
#include <algorithm>
#include <array>
#include <cmath>

#include "files/files.h"
#include "fmi/handle.h"

namespace {

using namespace pintle;
using namespace pintle::fmi;

constexpr std::array categories{"logStatusError", "logStatusWarning", "logEvents"};

/// Checks the arrays of a call that gets or sets n values.
void require_arrays(const fmi3ValueReference* references, std::size_t n, const void* values, std::size_t n_values) {
  if (n != n_values) throw FmuError(std::to_string(n) + " variables, all of them scalar, but " + std::to_string(n_values) + " values");
  if (n > 0 && (!references || !values)) throw FmuError("an array is NULL");
}

template <class Value, class Get>
fmi3Status get(fmi3Instance instance, const char* function, const fmi3ValueReference* references, std::size_t n, Value* values,
               std::size_t n_values, Get one) {
  return safely(instance, function, [&](FmuHandle& handle) {
    require_arrays(references, n, values, n_values);
    for (std::size_t i = 0; i < n; ++i) values[i] = one(*handle.instance, references[i]);
  });
}

template <class Value>
Value& written(Value* to) {
  if (!to) throw FmuError("a result has nowhere to go: its pointer is NULL");
  return *to;
}

std::unique_ptr<FmuInstance> made(FmuHandle& handle, const char* token, const char* resources, bool event_mode, bool early_return) {
  if (handle.name.empty()) throw FmuError("instanceName is empty");
  if (!resources) throw FmuError("resourcePath is NULL; name the folder resources of the unpacked unit");
  constexpr std::size_t most_bytes = std::size_t{100} << 20;
  std::filesystem::path folder = resources;
  FmuContents contents;
  try {
    contents = contents_of(read_file(folder / contents_file, most_bytes));
  } catch (const FileRejected& why) {
    throw FmuError((folder / contents_file).string() + " " + why.what() + "; resourcePath is the folder resources of the unpacked unit");
  }
  if (!token || contents.token != token) throw FmuError("instantiationToken is not that of modelDescription.xml");
  return std::make_unique<FmuInstance>(std::move(contents), folder, event_mode, early_return, [&handle](const std::string& warning) {
    handle.say(fmi3Warning, "logStatusWarning", handle.name + ": " + warning);
    handle.worst = fmi3Warning;
  });
}

FmuState& state_behind(fmi3FMUState state) {
  if (!state) throw FmuError("FMUState is NULL");
  return *static_cast<FmuState*>(state);
}

}  // namespace

FMI3_EXPORT const char* fmi3GetVersion() { return "3.0"; }

FMI3_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, std::size_t n, const fmi3String names[]) {
  return safely(instance, "fmi3SetDebugLogging", [&](FmuHandle& handle) {
    if (n > 0 && !names) throw FmuError("categories is NULL");
    for (std::size_t i = 0; i < n; ++i) {
      const auto is = [&](const char* known) { return names[i] && std::strcmp(known, names[i]) == 0; };
      if (std::ranges::none_of(categories, is)) throw FmuError("a category is none of logStatusError, logStatusWarning, logEvents");
      if (is("logEvents")) handle.logs_events = on;
    }
    if (n == 0) handle.logs_events = on;
  });
}

FMI3_EXPORT fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean,
                                                     fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                                     const fmi3ValueReference[], std::size_t n_intermediate,
                                                     fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                                     fmi3IntermediateUpdateCallback) {
  FmuHandle* handle = nullptr;
  try {
    handle = new FmuHandle{environment, log, logging, name ? name : ""};
  } catch (...) {
    return nullptr;
  }
  const fmi3Status status = safely(handle, "fmi3InstantiateCoSimulation", [&](FmuHandle& h) {
    if (n_intermediate > 0) throw FmuError("the unit gives no intermediate updates; requiredIntermediateVariables must be none");
    h.instance = made(h, token, resources, event_mode, early_return);
  });
  if (status < fmi3Discard) return handle;
  delete handle;
  return nullptr;
}

FMI3_EXPORT void fmi3FreeInstance(fmi3Instance instance) { delete static_cast<FmuHandle*>(instance); }

FMI3_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean tolerance_defined, fmi3Float64 tolerance,
                                                   fmi3Float64 start, fmi3Boolean stop_defined, fmi3Float64 stop) {
  return safely(instance, "fmi3EnterInitializationMode", [&](FmuHandle& h) {
    const auto given = [](bool defined, double x) { return defined ? std::optional<double>(x) : std::nullopt; };
    h.instance->enter_initialization(given(tolerance_defined, tolerance), start, given(stop_defined, stop));
  });
}
FMI3_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return safely(instance, "fmi3ExitInitializationMode", [](FmuHandle& h) { h.instance->exit_initialization(); });
}
FMI3_EXPORT fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
  return safely(instance, "fmi3EnterEventMode", [](FmuHandle& h) { h.instance->enter_event_mode(); });
}
FMI3_EXPORT fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
  return safely(instance, "fmi3EnterStepMode", [](FmuHandle& h) { h.instance->enter_step_mode(); });
}
FMI3_EXPORT fmi3Status fmi3Terminate(fmi3Instance instance) {
  return safely(instance, "fmi3Terminate", [](FmuHandle& h) { h.instance->terminate(); });
}
FMI3_EXPORT fmi3Status fmi3Reset(fmi3Instance instance) {
  return safely(instance, "fmi3Reset", [](FmuHandle& h) { h.instance->reset(); });
}

FMI3_EXPORT fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
  return safely(instance, "fmi3EvaluateDiscreteStates", [](FmuHandle&) {});
}

FMI3_EXPORT fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean* again, fmi3Boolean* terminate, fmi3Boolean* nominals,
                                                fmi3Boolean* values, fmi3Boolean* next_defined, fmi3Float64* next) {
  return safely(instance, "fmi3UpdateDiscreteStates", [&](FmuHandle& h) {
    for (fmi3Boolean* none : {again, nominals, values, next_defined}) written(none) = false;
    if (next) *next = 0;
    written(terminate) = h.instance->update_discrete();
  });
}

FMI3_EXPORT fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 from, fmi3Float64 size, fmi3Boolean, fmi3Boolean* event,
                                  fmi3Boolean* terminate, fmi3Boolean* early, fmi3Float64* last) {
  return safely(instance, "fmi3DoStep", [&](FmuHandle& h) {
    for (fmi3Boolean* result : {event, terminate, early}) written(result) = false;
    written(last) = from;
    const StepEnd end = h.instance->do_step(from, size);
    *event = end.event, *terminate = end.terminate, *early = end.early, *last = end.time;
    if (end.event && h.logs_events) h.say(fmi3OK, "logEvents", h.name + ": an event at t = " + std::to_string(end.time) + " s");
  });
}

FMI3_EXPORT fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[], std::size_t n, fmi3Float64 values[],
                                      std::size_t n_values) {
  return get(instance, "fmi3GetFloat64", references, n, values, n_values,
             [](FmuInstance& of, fmi3ValueReference v) { return of.number(v); });
}
FMI3_EXPORT fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference references[], std::size_t n, fmi3Int32 values[],
                                    std::size_t n_values) {
  return get(instance, "fmi3GetInt32", references, n, values, n_values, [](FmuInstance& of, fmi3ValueReference v) { return of.count(v); });
}
FMI3_EXPORT fmi3Status fmi3GetBoolean(fmi3Instance instance, const fmi3ValueReference references[], std::size_t n, fmi3Boolean values[],
                                      std::size_t n_values) {
  return get(instance, "fmi3GetBoolean", references, n, values, n_values, [](FmuInstance& of, fmi3ValueReference v) { return of.flag(v); });
}
FMI3_EXPORT fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[], std::size_t n,
                                      const fmi3Float64 values[], std::size_t n_values) {
  return safely(instance, "fmi3SetFloat64", [&](FmuHandle& h) {
    require_arrays(references, n, values, n_values);
    for (std::size_t i = 0; i < n; ++i) h.instance->set(references[i], values[i]);
  });
}

FMI3_EXPORT fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return safely(instance, "fmi3GetFMUState", [&](FmuHandle& h) {
    auto now = std::make_unique<FmuState>(h.instance->state());
    if (written(state))
      *static_cast<FmuState*>(*state) = std::move(*now);  // the importer passes an existing state to be overwritten
    else
      *state = now.release();
  });
}
FMI3_EXPORT fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return safely(instance, "fmi3SetFMUState", [&](FmuHandle& h) { h.instance->set_state(state_behind(state)); });
}
FMI3_EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return safely(instance, "fmi3FreeFMUState", [&](FmuHandle&) {
    if (!state) return;
    delete static_cast<FmuState*>(*state);
    *state = nullptr;
  });
}
FMI3_EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, std::size_t* size) {
  return safely(instance, "fmi3SerializedFMUStateSize",
                [&](FmuHandle& h) { written(size) = h.instance->text(state_behind(state)).size(); });
}
FMI3_EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[], std::size_t size) {
  return safely(instance, "fmi3SerializeFMUState", [&](FmuHandle& h) {
    const std::string text = h.instance->text(state_behind(state));
    if (!bytes || size < text.size()) throw FmuError("there is no room; ask fmi3SerializedFMUStateSize");
    std::ranges::copy(text, bytes);
  });
}
FMI3_EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], std::size_t size, fmi3FMUState* state) {
  return safely(instance, "fmi3DeserializeFMUState", [&](FmuHandle& h) {
    if (!bytes) throw FmuError("serializedState is NULL");
    auto read = std::make_unique<FmuState>(h.instance->state_of({reinterpret_cast<const char*>(bytes), size}));
    if (written(state))
      *static_cast<FmuState*>(*state) = std::move(*read);
    else
      *state = read.release();
  });
}
