// Functions of the standard that the FMU does not support: each logs this and returns an error.
#include "fmi/handle.h"

namespace {

using namespace pintle::fmi;

fmi3Status unsupported(fmi3Instance instance, const char* function, const char* why) {
  return safely(instance, function, [&](FmuHandle&) { throw FmuError(why); });
}
void unsupported(fmi3LogMessageCallback log, fmi3InstanceEnvironment environment, const char* why) {
  if (log) log(environment, fmi3Error, "logStatusError", why);
}

constexpr const char *no_type = "the unit has no variables of this type", *no_clocks = "the unit has no clocks",
                     *no_exchange = "the unit is for co-simulation, not for model exchange",
                     *no_derivatives = "the unit gives no derivatives; modelDescription.xml says so",
                     *no_configuration = "the unit has no structural parameters";

}  // namespace

#define NO_VALUES(TYPE)                                                                                                            \
  FMI3_EXPORT fmi3Status fmi3Get##TYPE(fmi3Instance i, const fmi3ValueReference[], std::size_t, fmi3##TYPE[], std::size_t) {       \
    return unsupported(i, "fmi3Get" #TYPE, no_type);                                                                               \
  }                                                                                                                                \
  FMI3_EXPORT fmi3Status fmi3Set##TYPE(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3##TYPE[], std::size_t) { \
    return unsupported(i, "fmi3Set" #TYPE, no_type);                                                                               \
  }
NO_VALUES(Float32)
NO_VALUES(Int8)
NO_VALUES(UInt8)
NO_VALUES(Int16)
NO_VALUES(UInt16)
NO_VALUES(UInt32)
NO_VALUES(Int64)
NO_VALUES(UInt64)
NO_VALUES(String)
#undef NO_VALUES

FMI3_EXPORT fmi3Status fmi3SetInt32(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3Int32[], std::size_t) {
  return unsupported(i, "fmi3SetInt32", "variables of this type count, and follow from the motion");
}
FMI3_EXPORT fmi3Status fmi3SetBoolean(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3Boolean[], std::size_t) {
  return unsupported(i, "fmi3SetBoolean", "variables of this type follow from the motion");
}
FMI3_EXPORT fmi3Status fmi3GetBinary(fmi3Instance i, const fmi3ValueReference[], std::size_t, std::size_t[], fmi3Binary[], std::size_t) {
  return unsupported(i, "fmi3GetBinary", no_type);
}
FMI3_EXPORT fmi3Status fmi3SetBinary(fmi3Instance i, const fmi3ValueReference[], std::size_t, const std::size_t[], const fmi3Binary[],
                                     std::size_t) {
  return unsupported(i, "fmi3SetBinary", no_type);
}

FMI3_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                                      fmi3InstanceEnvironment environment, fmi3LogMessageCallback log) {
  unsupported(log, environment, no_exchange);
  return nullptr;
}
FMI3_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                                           fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                                           fmi3ClockUpdateCallback, fmi3LockPreemptionCallback,
                                                           fmi3UnlockPreemptionCallback) {
  unsupported(log, environment, "the unit is for co-simulation, not for scheduled execution");
  return nullptr;
}

FMI3_EXPORT fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance i, fmi3ValueReference, std::size_t*) {
  return unsupported(i, "fmi3GetNumberOfVariableDependencies", no_derivatives);
}
FMI3_EXPORT fmi3Status fmi3GetVariableDependencies(fmi3Instance i, fmi3ValueReference, std::size_t[], fmi3ValueReference[], std::size_t[],
                                                   fmi3DependencyKind[], std::size_t) {
  return unsupported(i, "fmi3GetVariableDependencies", no_derivatives);
}
FMI3_EXPORT fmi3Status fmi3GetDirectionalDerivative(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3ValueReference[],
                                                    std::size_t, const fmi3Float64[], std::size_t, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetDirectionalDerivative", no_derivatives);
}
FMI3_EXPORT fmi3Status fmi3GetAdjointDerivative(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3ValueReference[],
                                                std::size_t, const fmi3Float64[], std::size_t, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetAdjointDerivative", no_derivatives);
}
FMI3_EXPORT fmi3Status fmi3GetOutputDerivatives(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3Int32[], fmi3Float64[],
                                                std::size_t) {
  return unsupported(i, "fmi3GetOutputDerivatives", no_derivatives);
}
FMI3_EXPORT fmi3Status fmi3EnterConfigurationMode(fmi3Instance i) { return unsupported(i, "fmi3EnterConfigurationMode", no_configuration); }
FMI3_EXPORT fmi3Status fmi3ExitConfigurationMode(fmi3Instance i) { return unsupported(i, "fmi3ExitConfigurationMode", no_configuration); }

FMI3_EXPORT fmi3Status fmi3GetClock(fmi3Instance i, const fmi3ValueReference[], std::size_t, fmi3Clock[]) {
  return unsupported(i, "fmi3GetClock", no_clocks);
}
FMI3_EXPORT fmi3Status fmi3SetClock(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3Clock[]) {
  return unsupported(i, "fmi3SetClock", no_clocks);
}
FMI3_EXPORT fmi3Status fmi3GetIntervalDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t, fmi3Float64[],
                                              fmi3IntervalQualifier[]) {
  return unsupported(i, "fmi3GetIntervalDecimal", no_clocks);
}
FMI3_EXPORT fmi3Status fmi3GetIntervalFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t, fmi3UInt64[], fmi3UInt64[],
                                               fmi3IntervalQualifier[]) {
  return unsupported(i, "fmi3GetIntervalFraction", no_clocks);
}
FMI3_EXPORT fmi3Status fmi3GetShiftDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t, fmi3Float64[]) {
  return unsupported(i, "fmi3GetShiftDecimal", no_clocks);
}
FMI3_EXPORT fmi3Status fmi3GetShiftFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t, fmi3UInt64[], fmi3UInt64[]) {
  return unsupported(i, "fmi3GetShiftFraction", no_clocks);
}
FMI3_EXPORT fmi3Status fmi3SetIntervalDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3Float64[]) {
  return unsupported(i, "fmi3SetIntervalDecimal", no_clocks);
}
FMI3_EXPORT fmi3Status fmi3SetIntervalFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3UInt64[],
                                               const fmi3UInt64[]) {
  return unsupported(i, "fmi3SetIntervalFraction", no_clocks);
}
FMI3_EXPORT fmi3Status fmi3SetShiftDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3Float64[]) {
  return unsupported(i, "fmi3SetShiftDecimal", no_clocks);
}
FMI3_EXPORT fmi3Status fmi3SetShiftFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t, const fmi3UInt64[],
                                            const fmi3UInt64[]) {
  return unsupported(i, "fmi3SetShiftFraction", no_clocks);
}
FMI3_EXPORT fmi3Status fmi3ActivateModelPartition(fmi3Instance i, fmi3ValueReference, fmi3Float64) {
  return unsupported(i, "fmi3ActivateModelPartition", no_clocks);
}

FMI3_EXPORT fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance i) { return unsupported(i, "fmi3EnterContinuousTimeMode", no_exchange); }
FMI3_EXPORT fmi3Status fmi3CompletedIntegratorStep(fmi3Instance i, fmi3Boolean, fmi3Boolean*, fmi3Boolean*) {
  return unsupported(i, "fmi3CompletedIntegratorStep", no_exchange);
}
FMI3_EXPORT fmi3Status fmi3SetTime(fmi3Instance i, fmi3Float64) { return unsupported(i, "fmi3SetTime", no_exchange); }
FMI3_EXPORT fmi3Status fmi3SetContinuousStates(fmi3Instance i, const fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3SetContinuousStates", no_exchange);
}
FMI3_EXPORT fmi3Status fmi3GetContinuousStates(fmi3Instance i, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetContinuousStates", no_exchange);
}
FMI3_EXPORT fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance i, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetContinuousStateDerivatives", no_exchange);
}
FMI3_EXPORT fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance i, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetNominalsOfContinuousStates", no_exchange);
}
FMI3_EXPORT fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance i, std::size_t*) {
  return unsupported(i, "fmi3GetNumberOfContinuousStates", no_exchange);
}
FMI3_EXPORT fmi3Status fmi3GetEventIndicators(fmi3Instance i, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetEventIndicators", no_exchange);
}
FMI3_EXPORT fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance i, std::size_t*) {
  return unsupported(i, "fmi3GetNumberOfEventIndicators", no_exchange);
}
