#include "tests/fmi/importer.h"

#include <dlfcn.h>
#include <libxml/parser.h>
#include <minizip/unzip.h>

#include <fstream>
#include <stdexcept>

#include <unistd.h>

namespace fmu_importer {

namespace fs = std::filesystem;

namespace {

fs::path new_folder() {
  std::string name = (fs::temp_directory_path() / "fmu-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  return name;
}

std::string entry(unzFile zip, std::string& content) {
  unz_file_info64 info;
  std::string name(4096, '\0');
  unzGetCurrentFileInfo64(zip, &info, name.data(), name.size(), nullptr, 0, nullptr, 0);
  name.resize(info.size_filename);
  content.resize(info.uncompressed_size);
  if (unzOpenCurrentFile(zip) != UNZ_OK) throw std::runtime_error("zip: " + name);
  if (unzReadCurrentFile(zip, content.data(), static_cast<unsigned>(content.size())) != static_cast<int>(content.size()))
    throw std::runtime_error("zip: " + name + " is cut");
  if (unzCloseCurrentFile(zip) != UNZ_OK) throw std::runtime_error("zip: " + name + " has another checksum");
  return name;
}

void unpack(const fs::path& fmu, const fs::path& folder) {
  unzFile zip = unzOpen64(fmu.c_str());
  if (!zip) throw std::runtime_error(fmu.string() + " is no zip file");
  for (int found = unzGoToFirstFile(zip); found == UNZ_OK; found = unzGoToNextFile(zip)) {
    std::string content;
    const fs::path name = entry(zip, content);
    if (name.is_absolute() || name.lexically_normal() != name) throw std::runtime_error(name.string() + " leads elsewhere");
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << content;
  }
  unzClose(zip);
}

std::string text(const xmlChar* s) { return s ? reinterpret_cast<const char*>(s) : ""; }

Element element(const xmlNode* node) {
  Element out{text(node->name), {}, {}};
  for (const xmlAttr* a = node->properties; a; a = a->next)
    out.attributes[text(a->name)] = text(a->children ? a->children->content : nullptr);
  for (const xmlNode* child = node->children; child; child = child->next)
    if (child->type == XML_ELEMENT_NODE) out.children.push_back(element(child));
  return out;
}

Element read_xml(const fs::path& file) {
  xmlDoc* document = xmlReadFile(file.c_str(), nullptr, XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING);
  if (!document) throw std::runtime_error(file.string() + " is no XML");
  Element out = element(xmlDocGetRootElement(document));
  xmlFreeDoc(document);
  return out;
}

}  // namespace

std::string Variable::at(const std::string& name) const {
  const auto found = attributes.find(name);
  return found == attributes.end() ? "" : found->second;
}

const Element* Element::child(const std::string& wanted) const {
  for (const Element& e : children)
    if (e.name == wanted) return &e;
  return nullptr;
}

Unit::Unit(const fs::path& fmu) : folder_(new_folder()) {
  unpack(fmu, folder_);
  description_ = read_xml(folder_ / "modelDescription.xml");
  for (const Element& e : description_.child("ModelVariables")->children) variables_.push_back({e.name, e.attributes});
  library_ = dlopen(library().c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library_) throw std::runtime_error(dlerror());
}

Unit::~Unit() {
  dlclose(library_);
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path Unit::library() const {
  return folder_ / "binaries/x86_64-linux" / (description_.child("CoSimulation")->attributes.at("modelIdentifier") + ".so");
}

const Variable& Unit::variable(const std::string& name) const {
  for (const Variable& v : variables_)
    if (v.at("name") == name) return v;
  throw std::runtime_error("no variable " + name);
}

void* Unit::function(const std::string& name) const { return dlsym(library_, name.c_str()); }

void Instance::take_message(void* environment, int, const char*, const char* message) {
  static_cast<std::vector<std::string>*>(environment)->emplace_back(message);
}

Instance::Instance(const Unit& unit, const How& how) : unit_(unit), event_mode_(how.event_mode) {
  using Instantiate = void*(const char*, const char*, const char*, bool, bool, bool, bool, const std::uint32_t*, std::size_t, void*,
                            void (*)(void*, int, const char*, const char*), void*);
  const std::string token = how.token.empty() ? unit.token() : how.token,
                    resources = how.resources.empty() ? (unit.folder() / "resources").string() + "/" : how.resources;
  instance_ =
      unit.function_as<Instantiate>("fmi3InstantiateCoSimulation")("one", token.c_str(), resources.c_str(), false, false, how.event_mode,
                                                                   how.early_return, nullptr, 0, &messages_, &take_message, nullptr);
}

Instance::~Instance() { unit_.function_as<void(void*)>("fmi3FreeInstance")(instance_); }

const std::string& Instance::last_message() const {
  static const std::string none;
  return messages_.empty() ? none : messages_.back();
}

int Instance::enter_initialization(double stop, double tolerance, double start) {
  return unit_.function_as<int(void*, bool, double, double, bool, double)>("fmi3EnterInitializationMode")(instance_, tolerance > 0,
                                                                                                          tolerance, start, stop > 0, stop);
}

int Instance::call(const std::string& function) { return unit_.function_as<int(void*)>(function)(instance_); }

bool Instance::start(double stop) {
  if (enter_initialization(stop) > warning || call("fmi3ExitInitializationMode") > warning) return false;
  bool over = false;
  return !event_mode_ || (update(over) <= warning && !over && call("fmi3EnterStepMode") <= warning);
}

Step Instance::step(double from, double size) {
  Step out;
  out.status = unit_.function_as<int(void*, double, double, bool, bool*, bool*, bool*, double*)>("fmi3DoStep")(
      instance_, from, size, true, &out.event, &out.terminate, &out.early, &out.last);
  return out;
}

int Instance::update(bool& terminate) {
  bool again = true, nominals = true, values = true, next_defined = true;
  double next = 0;
  const int status = unit_.function_as<int(void*, bool*, bool*, bool*, bool*, bool*, double*)>("fmi3UpdateDiscreteStates")(
      instance_, &again, &terminate, &nominals, &values, &next_defined, &next);
  return again || next_defined ? error : status;
}

int Instance::get(const std::string& name, double& to) {
  const std::uint32_t reference = unit_.variable(name).reference();
  return unit_.function_as<int(void*, const std::uint32_t*, std::size_t, double*, std::size_t)>("fmi3GetFloat64")(instance_, &reference, 1,
                                                                                                                  &to, 1);
}

double Instance::operator[](const std::string& name) {
  double out = 0;
  if (get(name, out) > warning) throw std::runtime_error(name + ": " + last_message());
  return out;
}

int Instance::count(const std::string& name) {
  const std::uint32_t reference = unit_.variable(name).reference();
  std::int32_t out = -1;
  if (unit_.function_as<int(void*, const std::uint32_t*, std::size_t, std::int32_t*, std::size_t)>("fmi3GetInt32")(instance_, &reference, 1,
                                                                                                                   &out, 1) > warning)
    throw std::runtime_error(name + ": " + last_message());
  return out;
}

bool Instance::flag(const std::string& name) {
  const std::uint32_t reference = unit_.variable(name).reference();
  bool out = false;
  if (unit_.function_as<int(void*, const std::uint32_t*, std::size_t, bool*, std::size_t)>("fmi3GetBoolean")(instance_, &reference, 1, &out,
                                                                                                             1) > warning)
    throw std::runtime_error(name + ": " + last_message());
  return out;
}

int Instance::set(const std::string& name, double value) {
  const std::uint32_t reference = unit_.variable(name).reference();
  return unit_.function_as<int(void*, const std::uint32_t*, std::size_t, const double*, std::size_t)>("fmi3SetFloat64")(
      instance_, &reference, 1, &value, 1);
}

}  // namespace fmu_importer
