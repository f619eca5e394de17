// Units as the program exports them: what is in one, what it says of itself, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/fmi/exported.h"
#include "tests/refusal.h"

namespace {

using namespace pintle_test;
using fmu_importer::Instance;
using fmu_importer::Unit;
namespace fs = std::filesystem;

bool is_identifier(const std::string& s) {
  return !s.empty() && !std::isdigit(static_cast<unsigned char>(s[0])) &&
         std::ranges::all_of(s, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; });
}

// What section 2.4 of the standard asks of modelDescription.xml, as far as a unit of this kind uses it.
TEST(Fmu, DescribesItselfAsTheStandardAsks) {
  Exported made("arm.yaml", led_arm);
  ASSERT_EQ(made.end().code, 0) << made.end().complained;
  const Unit& unit = made.unit();
  const fmu_importer::Element& root = unit.description();
  EXPECT_EQ(root.name, "fmiModelDescription");
  EXPECT_EQ(root.attributes.at("fmiVersion"), "3.0");
  EXPECT_EQ(root.attributes.at("modelName"), "Arm & <torque>");
  EXPECT_FALSE(unit.token().empty());
  const std::vector<std::string> order{"CoSimulation",      "UnitDefinitions", "LogCategories",
                                       "DefaultExperiment", "ModelVariables",  "ModelStructure"};
  ASSERT_EQ(root.children.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(root.children[i].name, order[i]);
  const auto& kind = root.child("CoSimulation")->attributes;
  EXPECT_TRUE(is_identifier(kind.at("modelIdentifier")));
  EXPECT_EQ(kind.at("hasEventMode"), "true");
  EXPECT_EQ(kind.at("mightReturnEarlyFromDoStep"), "true");  // at an event
  EXPECT_EQ(kind.at("canHandleVariableCommunicationStepSize"), "true");

  std::map<std::string, std::map<std::string, std::string>> units;
  for (const auto& u : root.child("UnitDefinitions")->children)
    EXPECT_TRUE(units.emplace(u.attributes.at("name"), u.children.empty() ? std::map<std::string, std::string>{} : u.children[0].attributes)
                    .second);
  EXPECT_EQ(units.at("N m"), (std::map<std::string, std::string>{{"kg", "1"}, {"m", "2"}, {"s", "-2"}}));
  EXPECT_EQ(units.at("rad/s"), (std::map<std::string, std::string>{{"rad", "1"}, {"s", "-1"}}));

  std::vector<std::string> names, references, outputs;
  int independent = 0;
  for (const auto& v : unit.variables()) {
    names.push_back(v.at("name")), references.push_back(v.at("valueReference"));
    const std::string causality = v.at("causality"), variability = v.at("variability"), initial = v.at("initial");
    EXPECT_TRUE(v.at("unit").empty() || units.contains(v.at("unit"))) << v.at("name");
    const bool starts = causality == "parameter" || causality == "input";
    EXPECT_EQ(!v.at("start").empty(), starts) << v.at("name")
                                              << ": a start value where initial is exact or the variable an input, and only there";
    if (causality == "independent") ++independent;
    EXPECT_EQ(initial.empty(), causality == "independent" || causality == "input") << v.at("name");
    EXPECT_TRUE(causality != "parameter" || (variability == "fixed" && initial == "exact")) << v.at("name");
    EXPECT_TRUE(v.type == "Float64" || variability == "discrete") << v.at("name");
    if (causality == "output") outputs.push_back(v.at("valueReference"));
  }
  EXPECT_EQ(independent, 1);
  for (auto* list : {&names, &references}) {
    std::ranges::sort(*list);
    EXPECT_TRUE(std::ranges::adjacent_find(*list) == list->end());
  }
  for (const char* list : {"Output", "InitialUnknown"}) {
    std::vector<std::string> said;
    for (const auto& e : root.child("ModelStructure")->children)
      if (e.name == list) said.push_back(e.attributes.at("valueReference"));
    EXPECT_EQ(said, outputs) << list << ": all outputs, here calculated at the start";
  }
  EXPECT_EQ(unit.variable("torque").at("causality"), "input");
  EXPECT_EQ(unit.variable("brake").at("causality"), "local") << "the scene's own event sets it";
  EXPECT_EQ(unit.variable("power").at("causality"), "output");
  EXPECT_EQ(unit.variable("arm.angle").at("causality"), "local");
  EXPECT_EQ(unit.variable("mass").at("start"), "2");
  EXPECT_EQ(unit.variable("passed.happened").type, "Int32");
  EXPECT_TRUE(fs::exists(unit.folder() / "resources/scene/arm.yaml"));
  EXPECT_TRUE(fs::exists(unit.folder() / "documentation/index.html"));
}

// A controller by name is no choice of outputs; a parameter that an event sets is a column, and its start a parameter.
TEST(Fmu, WithoutOutputsOfTheSceneAllColumnsAreOutputs) {
  Exported made("arm.yaml", R"(
gravity: [0, -9.81 m/s^2]
parameters: {load: 0 N m}
bodies: {arm: {rigid: {mass: 2 kg, inertia: 0.06 kg m^2, center: [0.3 m, 0]}, points: {O: [0, 0]}}}
joints: {pivot: {revolute: [ground, arm.O]}}
states: {u: {pid: 0.5 rad - arm.angle, gains: [40 N m, 15 N m/s, 4 N m s], filter: 2 ms, limits: [-9 N m, 9 N m]}}
forces: {servo: {torque: u + load, on: arm}}
events: {loaded: {when: arm.angle > 0 rad, do: {set: {load: -1 N m}}}}
run: {until: 1 s}
)");
  ASSERT_EQ(made.end().code, 0) << made.end().complained;
  for (const char* column : {"u", "u integral", "arm.angle", "pivot.fx on arm", "load"})
    EXPECT_EQ(made.unit().variable(column).at("causality"), "output") << column;
  EXPECT_EQ(made.unit().variable("parameters.load").at("causality"), "parameter");
}

// Every function of the standard's table is there to be loaded.
TEST(Fmu, HasEveryFunctionOfTheStandard) {
  Exported made("arm.yaml", led_arm);
  std::istringstream names(
      "GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation InstantiateScheduledExecution FreeInstance "
      "EnterInitializationMode ExitInitializationMode EnterEventMode Terminate Reset GetFloat32 GetFloat64 GetInt8 GetUInt8 "
      "GetInt16 GetUInt16 GetInt32 GetUInt32 GetInt64 GetUInt64 GetBoolean GetString GetBinary GetClock SetFloat32 SetFloat64 "
      "SetInt8 SetUInt8 SetInt16 SetUInt16 SetInt32 SetUInt32 SetInt64 SetUInt64 SetBoolean SetString SetBinary SetClock "
      "GetNumberOfVariableDependencies GetVariableDependencies GetFMUState SetFMUState FreeFMUState SerializedFMUStateSize "
      "SerializeFMUState DeserializeFMUState GetDirectionalDerivative GetAdjointDerivative EnterConfigurationMode "
      "ExitConfigurationMode GetIntervalDecimal GetIntervalFraction GetShiftDecimal GetShiftFraction SetIntervalDecimal "
      "SetIntervalFraction SetShiftDecimal SetShiftFraction EvaluateDiscreteStates UpdateDiscreteStates EnterContinuousTimeMode "
      "CompletedIntegratorStep SetTime SetContinuousStates GetContinuousStateDerivatives GetEventIndicators GetContinuousStates "
      "GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates EnterStepMode GetOutputDerivatives "
      "DoStep ActivateModelPartition");
  int seen = 0;
  for (std::string name; names >> name; ++seen) EXPECT_NE(made.unit().function("fmi3" + name), nullptr) << name;
  EXPECT_EQ(seen, 75);
  EXPECT_STREQ(made.unit().function_as<const char*()>("fmi3GetVersion")(), "3.0");
}

TEST(Fmu, WrongCallsAreErrorsWithTheirReasons) {
  Exported made("arm.yaml", led_arm);
  const Unit& unit = made.unit();
  Instance stranger(unit, {.token = "another"}), lost(unit, {.resources = "/nowhere"});
  EXPECT_FALSE(stranger);
  EXPECT_TRUE(says(stranger.last_message(), "instantiationToken"));
  EXPECT_FALSE(lost);
  EXPECT_TRUE(says(lost.last_message(), "/nowhere")) << lost.last_message();

  Instance i(unit);
  const auto refused = [&](int status, const std::string& why) {
    EXPECT_EQ(status, fmu_importer::error) << why;
    EXPECT_TRUE(says(i.last_message(), why)) << i.last_message();
  };
  double x = 0;
  refused(i.get("arm.angle", x), "from Initialization Mode on");
  refused(i.step(0, 0.1).status, "in Step Mode");
  refused(i.call("fmi3ExitInitializationMode"), "in Initialization Mode");
  refused(i.call("fmi3Terminate"), "instantiated");
  refused(i.set("arm.angle", 1), "follows from the motion");
  refused(i.set("torque", std::nan("")), "finite");
  refused(i.set("time", 1), "follows from the motion");
  refused(i.enter_initialization(0, 0, 1), "starts at 0 s");
  refused(i.enter_initialization(0, 2), "tolerance");
  ASSERT_TRUE(i.start()) << i.last_message();
  refused(i.step(0, -0.1).status, "above 0");
  refused(i.step(0, INFINITY).status, "above 0");
  refused(i.step(0.5, 0.1).status, "but the instance is at 0 s");
  refused(i.step(0, 2.5).status, "stopTime");
  const std::uint32_t none = 100000, angle = unit.variable("arm.angle").reference();
  const auto get = unit.function_as<int(void*, const std::uint32_t*, std::size_t, double*, std::size_t)>("fmi3GetFloat64");
  refused(get(i.handle(), &none, 1, &x, 1), "value reference 100000");
  refused(get(i.handle(), &angle, 1, &x, 2), "2 values");
  refused(get(i.handle(), nullptr, 1, &x, 1), "NULL");
  EXPECT_EQ(get(i.handle(), nullptr, 0, nullptr, 0), 0);
  EXPECT_EQ(get(nullptr, &angle, 1, &x, 1), fmu_importer::error);
  refused(i.get("passed.happened", x), "no Float64");
  refused(unit.function_as<int(void*, const std::uint32_t*, std::size_t, std::int32_t*, std::size_t)>("fmi3GetInt32")(
              i.handle(), &angle, 1, reinterpret_cast<std::int32_t*>(&x), 1),
          "no Int32");
  refused(unit.function_as<int(void*, double)>("fmi3SetTime")(i.handle(), 1), "co-simulation");
  refused(unit.function_as<int(void*, void*)>("fmi3SetFMUState")(i.handle(), nullptr), "NULL");
  EXPECT_EQ(unit.function_as<int(void*, double, double, bool, bool*, bool*, bool*, double*)>("fmi3DoStep")(
                i.handle(), 0, 0.1, true, nullptr, nullptr, nullptr, nullptr),
            fmu_importer::error);
  const char* category = "noise";
  refused(unit.function_as<int(void*, bool, std::size_t, const char**)>("fmi3SetDebugLogging")(i.handle(), true, 1, &category), "category");
  EXPECT_EQ(i.step(0, 0.1).status, 0) << "and goes on: " << i.last_message();

  Instance plain(unit, {.event_mode = false});
  ASSERT_TRUE(plain.start());
  EXPECT_EQ(plain.call("fmi3EnterEventMode"), fmu_importer::error);
  EXPECT_TRUE(says(plain.last_message(), "eventModeUsed"));
  unit.function_as<void(void*)>("fmi3FreeInstance")(nullptr);

  Instance odd(unit);  // a parameter with which the scene cannot be: the reason, and it can be set again
  ASSERT_EQ(odd.set("mass", -1), 0);
  EXPECT_FALSE(odd.start());
  EXPECT_TRUE(says(odd.last_message(), "mass")) << odd.last_message();
  ASSERT_EQ(odd.call("fmi3Reset"), 0);
  EXPECT_TRUE(odd.start()) << odd.last_message();
}

TEST(Fmu, HoldsTheFilesOfItsSceneAndNoOthers) {
  const Folder folder;
  fs::create_directory(folder.path() / "scenes");
  fs::create_directory(folder.path() / "scenes/tables");
  folder.write("scenes/tables/push.csv", "0, 0\n1, 2\n2, 0\n");
  folder.write("scenes/other.csv", "0, 0\n1, 1\n");
  folder.write("outside.csv", "0, 0\n2, 2\n");
  folder.write("scenes/parts.yaml", "bodies: {block: {rigid: {mass: 1 kg, inertia: 1}, points: {O: [0, 0]}}}\n");
  const std::string scene =
      "include: [parts.yaml]\njoints: {guide: {prismatic: [ground, block.O]}}\nforces: {push: {force: [{table: FILE, interpolation: "
      "linear}, 0], at: block.O}}\n"
      "run: {until: 1 s}\n";
  const auto with = [&](const std::string& file) {
    std::string text = scene;
    text.replace(text.find("FILE"), 4, file);
    return folder.write("scenes/block.yaml", text).string();
  };
  const std::string file = (folder.path() / "block.fmu").string(), log = (folder.path() / "log").string();
  const Ended made = run(log, {PINTLE_PROGRAM, "fmu", with("tables/push.csv"), "-o", file});
  ASSERT_EQ(made.code, 0) << made.complained;
  const std::string bits = contents(file);
  ASSERT_EQ(run(log, {PINTLE_PROGRAM, "fmu", with("tables/push.csv"), "-o", file}).code, 0);
  EXPECT_TRUE(contents(file) == bits) << "the same scene is the same file";
  {
    const Unit unit(file);
    fs::remove_all(folder.path() / "scenes");  // it stands alone
    EXPECT_TRUE(fs::exists(unit.folder() / "resources/scene/tables/push.csv"));
    EXPECT_TRUE(fs::exists(unit.folder() / "resources/scene/parts.yaml"));
    EXPECT_FALSE(fs::exists(unit.folder() / "resources/scene/other.csv"));
    Instance instance(unit);
    ASSERT_TRUE(instance.start()) << instance.last_message();
    ASSERT_EQ(instance.step(0, 1).status, 0) << instance.last_message();
    EXPECT_NEAR(instance["block.x"], 1.0 / 3, 1e-7) << "x'' = 2 t, for 1 s";
  }
  fs::create_directory(folder.path() / "scenes");
  folder.write("scenes/parts.yaml", "bodies: {block: {rigid: {mass: 1 kg, inertia: 1}, points: {O: [0, 0]}}}\n");
  const Ended refused = run(log, {PINTLE_PROGRAM, "fmu", with("../outside.csv"), "-o", file});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(says(refused.complained, "outside.csv")) << refused.complained;
}

TEST(Fmu, TheCommandSaysWhatItMadeAndWhatIsWrong) {
  const Exported made("arm.yaml", led_arm);
  ASSERT_EQ(made.end().code, 0) << made.end().complained;
  expect_says(made.end().said, {"Arm & <torque>", "1: torque [N m]", "1: power [W]", "2: passed.happened, ended.happened",
                                "3: mass [kg], half [m], reach [m]", "arm.yaml", "out.fmu"});
  const Exported no_input("arm.yaml", led_arm, {"--input", "torqe"}), set_input("arm.yaml", led_arm, {"--input", "brake"}),
      no_output("arm.yaml", led_arm, {"--output", "arm.angel"}), no_scene("arm.yaml", "bodies: 3");
  EXPECT_EQ(no_input.end().code, 2);
  expect_says(no_input.end().complained, {"--input torqe", "Did you mean \"torque\"?"});
  expect_says(set_input.end().complained, {"--input brake", "an event of the scene sets this state"});
  expect_says(no_output.end().complained, {"--output arm.angel", "Did you mean \"arm.angle\"?"});
  EXPECT_EQ(no_scene.end().code, 2);
  EXPECT_FALSE(fs::exists(no_scene.file()));
  Exported chosen("arm.yaml", led_arm, {"--output", "arm.angle", "--output", "pivot.fx", "--set", "mass=3kg"});
  ASSERT_EQ(chosen.end().code, 0) << chosen.end().complained;
  EXPECT_EQ(chosen.unit().variable("arm.angle").at("causality"), "output");
  EXPECT_EQ(chosen.unit().variable("power").at("causality"), "local");
  EXPECT_EQ(chosen.unit().variable("mass").at("start"), "3");
  Instance instance(chosen.unit());
  EXPECT_TRUE(instance.start()) << instance.last_message();

  std::string named_time = led_arm;  // a name that the unit has already
  named_time.replace(named_time.find("torque: {rate"), 6, "time");
  named_time.replace(named_time.find("torque: torque"), 14, "torque: time");
  Exported other("arm.yaml", named_time);
  ASSERT_EQ(other.end().code, 0) << other.end().complained;
  Instance pushed(other.unit());
  ASSERT_EQ(pushed.set("time'", 20), 0);
  ASSERT_TRUE(pushed.start()) << pushed.last_message();
  ASSERT_LE(pushed.step(0, 0.01).status, fmu_importer::warning) << pushed.last_message();
  EXPECT_EQ(pushed["time"], 0.01);
  EXPECT_GT(pushed["arm.speed"], 0);
}

}  // namespace
