#include "app/fmu/model_description.h"

#include <libxml/xmlwriter.h>

#include <cmath>
#include <memory>
#include <new>
#include <set>

#include "framework/common/text.h"
#include "framework/scene/units/expression.h"

namespace pintle::app {

namespace {

using fmi::FmuContents;
using fmi::FmuVariable;

/// XML or HTML as text, by libxml2, which escapes characters where necessary.
class Markup {
 public:
  explicit Markup(const char* doctype = nullptr)
      : buffer_(xmlBufferCreate(), &xmlBufferFree), to_(xmlNewTextWriterMemory(buffer_.get(), 0), &xmlFreeTextWriter) {
    if (!buffer_ || !to_) throw std::bad_alloc();
    xmlTextWriterSetIndent(to_.get(), 1);
    if (doctype)
      xmlTextWriterWriteRaw(to_.get(), as(doctype));
    else
      xmlTextWriterStartDocument(to_.get(), nullptr, "UTF-8", nullptr);
  }
  using Attributes = std::vector<std::pair<const char*, std::string>>;
  void open(const char* name, const Attributes& attributes = {}) {
    xmlTextWriterStartElement(to_.get(), as(name));
    for (const auto& [key, value] : attributes) xmlTextWriterWriteAttribute(to_.get(), as(key), as(value.c_str()));
  }
  void close() { xmlTextWriterEndElement(to_.get()); }
  void element(const char* name, const Attributes& attributes) { open(name, attributes), close(); }
  void element(const char* name, const std::string& text) {
    open(name);
    xmlTextWriterWriteString(to_.get(), as(text.c_str()));
    close();
  }
  std::string text() {
    xmlTextWriterEndDocument(to_.get());
    xmlTextWriterFlush(to_.get());
    return reinterpret_cast<const char*>(xmlBufferContent(buffer_.get()));
  }

 private:
  static const xmlChar* as(const char* text) { return reinterpret_cast<const xmlChar*>(text); }
  std::unique_ptr<xmlBuffer, decltype(&xmlBufferFree)> buffer_;
  std::unique_ptr<xmlTextWriter, decltype(&xmlFreeTextWriter)> to_;
};

/// Exponents of the base units; nothing if one is not an integer, as in m kg^0.5.
Markup::Attributes base_units(const std::string& unit) {
  const Quantity one = read_quantity("1 " + unit);
  const Dimension& d = one.dimension;
  Markup::Attributes out;
  for (const auto& [name, exponent] : {std::pair{"kg", d.mass}, {"m", d.length}, {"s", d.time}, {"A", d.current}, {"rad", d.angle}}) {
    if (exponent != std::round(exponent)) return {};
    if (exponent != 0) out.emplace_back(name, std::to_string(static_cast<int>(exponent)));
  }
  return out;
}

void write_units(const FmuContents& contents, Markup& to) {
  std::set<std::string> units;
  for (const FmuVariable& v : contents.variables) units.insert(v.unit);
  units.erase("");
  to.open("UnitDefinitions");
  for (const std::string& unit : units) {
    to.open("Unit", {{"name", unit}});
    if (const Markup::Attributes base = base_units(unit); !base.empty()) to.element("BaseUnit", base);
    to.close();
  }
  to.close();
}

struct Typed {
  const char* type;
  Markup::Attributes attributes;
};

Typed typed(const FmuVariable& v, std::size_t reference) {
  Typed out{"Float64", {{"name", v.name}, {"valueReference", std::to_string(reference)}}};
  const auto say = [&](const char* causality, const char* variability, const char* initial, const std::string& description) {
    out.attributes.insert(out.attributes.end(), {{"causality", causality}, {"variability", variability}});
    if (initial) out.attributes.emplace_back("initial", initial);
    if (!description.empty()) out.attributes.emplace_back("description", description);
  };
  switch (v.kind) {
    case FmuVariable::time: say("independent", "continuous", nullptr, "time"); break;
    case FmuVariable::parameter: say("parameter", "fixed", "exact", "parameter of the scene"); break;
    case FmuVariable::input: say("input", "continuous", nullptr, "state of the scene that the importer sets"); break;
    case FmuVariable::column: say(v.output ? "output" : "local", "continuous", "calculated", ""); break;
    case FmuVariable::happened: say("output", "discrete", "calculated", "how often the event \"" + v.of + "\" has acted"); break;
    case FmuVariable::contacts: say("output", "discrete", "calculated", "how often \"" + v.of + "\" has come into contact"); break;
    case FmuVariable::touching: say("output", "discrete", "calculated", "whether \"" + v.of + "\" touches"); break;
  }
  if (v.kind == FmuVariable::happened || v.kind == FmuVariable::contacts) out.type = "Int32";
  if (v.kind == FmuVariable::touching) out.type = "Boolean";
  if (!v.unit.empty()) out.attributes.emplace_back("unit", v.unit);
  if (v.kind == FmuVariable::parameter || v.kind == FmuVariable::input) out.attributes.emplace_back("start", number_exactly(v.start));
  return out;
}

bool is_output(const FmuVariable& v) { return v.output || v.kind >= FmuVariable::happened; }

void write_structure(const FmuContents& contents, Markup& to) {
  to.open("ModelStructure");
  for (const char* kind : {"Output", "InitialUnknown"})
    for (std::size_t i = 0; i < contents.variables.size(); ++i)
      if (is_output(contents.variables[i])) to.element(kind, {{"valueReference", std::to_string(i)}});
  to.close();
}

}  // namespace

std::string model_description(const FmuContents& contents, const std::string& identifier) {
  Markup to;
  to.open("fmiModelDescription", {{"fmiVersion", "3.0"},
                                  {"modelName", contents.title},
                                  {"instantiationToken", contents.token},
                                  {"license", "GPL-3.0-or-later, of the program in it"},
                                  {"generationTool", "Pintle " PINTLE_VERSION},
                                  {"variableNamingConvention", "flat"}});
  to.element("CoSimulation", {{"modelIdentifier", identifier},
                              {"canGetAndSetFMUState", "true"},
                              {"canSerializeFMUState", "true"},
                              {"canHandleVariableCommunicationStepSize", "true"},
                              {"mightReturnEarlyFromDoStep", "true"},
                              {"hasEventMode", "true"}});
  write_units(contents, to);
  to.open("LogCategories");
  to.element("Category", {{"name", "logStatusError"}, {"description", "why a call failed"}});
  to.element("Category", {{"name", "logStatusWarning"}, {"description", "what makes the numbers doubtful"}});
  to.element("Category", {{"name", "logEvents"}, {"description", "times of events"}});
  to.close();
  to.element("DefaultExperiment", {{"startTime", "0"},
                                   {"stopTime", number_exactly(contents.until)},
                                   {"tolerance", number_exactly(contents.tolerance)},
                                   {"stepSize", number_exactly(contents.every)}});
  to.open("ModelVariables");
  for (std::size_t i = 0; i < contents.variables.size(); ++i) {
    const Typed v = typed(contents.variables[i], i);
    to.element(v.type, v.attributes);
  }
  to.close();
  write_structure(contents, to);
  return to.text();
}

std::string variables_page(const FmuContents& contents) {
  Markup to("<!DOCTYPE html>\n");
  to.open("html", {{"lang", "en"}});
  to.open("head");
  to.element("meta", {{"charset", "utf-8"}});
  to.element("title", contents.title);
  to.close();
  to.open("body");
  to.element("h1", contents.title);
  to.element("p", "A mechanism for co-simulation by FMI 3.0, made by Pintle " PINTLE_VERSION ". Its scene is in resources/scene.");
  to.open("table");
  to.open("tr");
  for (const char* heading : {"variable", "unit", "causality", "start"}) to.element("th", heading);
  to.close();
  for (std::size_t i = 0; i < contents.variables.size(); ++i) {
    const FmuVariable& v = contents.variables[i];
    const auto of = typed(v, i).attributes;
    to.open("tr");
    for (const std::string& cell : {v.name, v.unit, of[2].second, of.back().first == std::string("start") ? of.back().second : ""})
      to.element("td", cell);
    to.close();
  }
  return to.text();
}

}  // namespace pintle::app
