#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// An importer of FMI 3.0 units for co-simulation of the tests' own: it knows what the standard says and nothing of Pintle.
namespace fmu_importer {

/// A variable as modelDescription.xml has it; attributes by their names.
struct Variable {
  std::string type;
  std::map<std::string, std::string> attributes;
  std::string at(const std::string& name) const;  ///< empty: it is not there
  std::uint32_t reference() const { return static_cast<std::uint32_t>(std::stoul(at("valueReference"))); }
};

/// An element with its attributes and children, of the same file.
struct Element {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;
  const Element* child(const std::string& name) const;
};

/// A .fmu file unpacked into a folder of its own, and its shared library loaded.
class Unit {
 public:
  explicit Unit(const std::filesystem::path& fmu);
  ~Unit();
  Unit(const Unit&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path library() const;
  const Element& description() const { return description_; }
  const std::vector<Variable>& variables() const { return variables_; }
  const Variable& variable(const std::string& name) const;
  std::string token() const { return description_.attributes.at("instantiationToken"); }
  /// @returns nullptr if the library has no such function
  void* function(const std::string& name) const;
  template <class Function>
  Function* function_as(const std::string& name) const {
    return reinterpret_cast<Function*>(function(name));
  }

 private:
  std::filesystem::path folder_;
  Element description_;
  std::vector<Variable> variables_;
  void* library_ = nullptr;
};

enum Status { ok, warning, discard, error, fatal };

struct Step {
  int status = error;
  bool event = false, terminate = false, early = false;
  double last = 0;
};

/// An instance; each call returns the status of the function of its name.
class Instance {
 public:
  struct How {
    bool event_mode = true, early_return = true;
    std::string token = {}, resources = {};  ///< empty: the unit's own
  };
  Instance(const Unit&, const How&);
  explicit Instance(const Unit& unit) : Instance(unit, How{}) {}
  ~Instance();
  Instance(const Instance&) = delete;

  explicit operator bool() const { return instance_ != nullptr; }
  void* handle() const { return instance_; }
  const std::vector<std::string>& messages() const { return messages_; }
  const std::string& last_message() const;

  /// fmi3EnterInitializationMode with a stop time, if it is above 0.
  int enter_initialization(double stop = 0, double tolerance = 0, double start = 0);
  int call(const std::string& function);  ///< one that takes the instance alone
  /// Up to Step Mode, with event iteration where there is event mode.
  bool start(double stop = 0);
  Step step(double from, double size);
  /// fmi3UpdateDiscreteStates. @param terminate ← the result
  int update(bool& terminate);

  int get(const std::string& name, double& to);
  double operator[](const std::string& name);
  int count(const std::string& name);
  bool flag(const std::string& name);
  int set(const std::string& name, double value);

 private:
  static void take_message(void* environment, int status, const char* category, const char* message);

  const Unit& unit_;
  bool event_mode_;
  std::vector<std::string> messages_;
  void* instance_ = nullptr;
};

}  // namespace fmu_importer
